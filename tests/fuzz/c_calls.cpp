// Calls of the C API in any order, with arguments of any kind. Whatever is not a status is a crash.
// Pointers are NULL or lead to as much as the header asks for, which is all that C can promise.
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include <geodisk/geodisk.h>

namespace {

/// Reads what libFuzzer gives; zeros once that is used up.
class Bytes {
  public:
    Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

    bool is_empty() const { return left_ == 0; }
    template <class Value>
    Value next() {
        Value value{};
        const std::size_t size = left_ < sizeof value ? left_ : sizeof value;
        std::memcpy(&value, data_, size);
        data_ += size;
        left_ -= size;
        return value;
    }
    /// Below `end`.
    std::size_t below(std::size_t end) { return next<std::uint8_t>() % end; }
    /// Often one that makes sense.
    double number() {
        static constexpr double kLikely[] = {0, 0.1, 0.3, 1, 20, 1000, -1, 1e-300, 1e300};
        const std::size_t which = below(12);
        return which < std::size(kLikely) ? kLikely[which] : next<double>();
    }
    /// A struct of any content, of the right size or another one.
    template <class Struct>
    Struct any_struct() {
        auto value = below(2) == 0 ? next<Struct>() : Struct{};
        value.struct_size = below(8) == 0 ? below(sizeof(Struct) + 1) : sizeof(Struct);
        return value;
    }

  private:
    const std::uint8_t* data_;
    std::size_t left_;
};

/// Objects of a kind; the first is NULL.
template <class Object, void (*kRelease)(Object*)>
class Objects {
  public:
    ~Objects() {
        for (Object* const object : all_) {
            kRelease(object);
        }
    }
    Object* any(Bytes& bytes) { return all_[bytes.below(all_.size())]; }
    void add(Object* object) {
        if (object != nullptr) {
            all_.push_back(object);
        }
    }
    void release_one(Bytes& bytes) {
        const std::size_t i = bytes.below(all_.size());
        kRelease(all_[i]);
        if (i > 0) {
            all_.erase(all_.begin() + static_cast<std::ptrdiff_t>(i));
        }
    }

  private:
    std::vector<Object*> all_{nullptr};
};

constexpr std::size_t kVertices = 8, kFaces = 12;

class Program {
  public:
    explicit Program(Bytes bytes) : bytes_(bytes) {}

    void run(geodisk_device* device, geodisk_sampler* sampler) {
        device_ = device;
        sampler_ = sampler;
        for (int calls = 0; calls < 64 && !bytes_.is_empty(); ++calls) {
            call();
        }
        geodisk_cancel(sampler_); // It is used again.
        geodisk_samples* rest = nullptr;
        while (rest == nullptr && geodisk_poll(sampler_, 1000, &rest, nullptr) == GEODISK_OK) {
        }
        geodisk_samples_release(rest);
    }

  private:
    void call() {
        geodisk_error error{};
        error.struct_size = bytes_.below(4) == 0 ? bytes_.below(sizeof error) : sizeof error;
        geodisk_error* const e = bytes_.below(4) == 0 ? nullptr : &error;
        switch (bytes_.below(17)) {
        case 0:
        case 1:
            return make_mesh(e);
        case 2:
        case 3:
            return make_surface(e);
        case 4:
            return make_surfaces(e);
        case 5:
            return make_box(e);
        case 6:
            return make_radii(e);
        case 7:
        case 8:
            return sample(e);
        case 9:
            geodisk_start(sampler_, domains_.any(bytes_), e);
            return;
        case 10: {
            geodisk_samples* samples = nullptr;
            geodisk_poll(sampler_, 5, &samples, e);
            samples_.add(samples);
            return;
        }
        case 11:
            return copy(e);
        case 12: {
            auto report = bytes_.any_struct<geodisk_report>();
            geodisk_samples_report(samples_.any(bytes_), &report, e);
            auto info = bytes_.any_struct<geodisk_mesh_info>();
            geodisk_mesh_describe(meshes_.any(bytes_), &info, e);
            return;
        }
        case 13:
            return find_distance(e);
        case 14:
            return save_and_load(e);
        case 15:
            return plan_job(e);
        default:
            meshes_.release_one(bytes_);
            radii_.release_one(bytes_);
            domains_.release_one(bytes_);
            samples_.release_one(bytes_);
        }
    }

    void make_mesh(geodisk_error* e) {
        static constexpr std::array<double, 3 * kVertices> kPositions = {
            0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
        static constexpr std::array<std::uint32_t, 3 * kFaces> kIndices = {
            0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
            2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
        std::array<double, 3 * kVertices> positions = kPositions;
        std::array<std::uint32_t, 3 * kFaces> indices = kIndices;
        std::array<double, 3 * kFaces> lengths{};
        lengths.fill(1);
        auto params = bytes_.any_struct<geodisk_mesh_params>();
        params.dimension = static_cast<std::uint32_t>(bytes_.below(4));
        params.vertex_count = bytes_.below(4) == 0 ? bytes_.below(kVertices + 1) : kVertices;
        params.face_count = bytes_.below(4) == 0 ? bytes_.below(kFaces + 1) : kFaces;
        params.positions = bytes_.below(8) == 0 ? nullptr : positions.data();
        params.indices = bytes_.below(8) == 0 ? nullptr : indices.data();
        params.edge_lengths = bytes_.below(8) == 0 ? lengths.data() : nullptr;
        params.position_type = static_cast<geodisk_type>(bytes_.below(3)) - 1;
        params.index_type = static_cast<geodisk_type>(bytes_.below(5)) - 1;
        params.position_stride = bytes_.below(4) == 0 ? bytes_.below(25) : 0;
        params.index_stride = bytes_.below(4) == 0 ? bytes_.below(5) : 0;
        params.weld = bytes_.below(4) == 0 ? 1 : 0;
        params.weld_distance = bytes_.number();
        params.keep_seams = bytes_.below(4) == 0 ? 1 : 0;
        params.max_threads %= 4;
        if (bytes_.below(2) == 0) { // Not quite the cube.
            positions[bytes_.below(positions.size())] = bytes_.number();
            indices[bytes_.below(indices.size())] = bytes_.next<std::uint8_t>();
            lengths[bytes_.below(lengths.size())] = bytes_.number();
        }
        geodisk_mesh* mesh = nullptr;
        geodisk_mesh_create(&params, &mesh, e);
        meshes_.add(mesh);
    }

    geodisk_surface_params surface_params() {
        auto params = bytes_.any_struct<geodisk_surface_params>();
        params.min_distance = bytes_.number();
        params.pool_ratio = bytes_.number();
        params.darts %= 1000;
        params.radii = bytes_.below(2) == 0 ? radii_.any(bytes_) : nullptr;
        static std::array<std::uint32_t, kFaces> keys;
        for (std::size_t i = 0; i < keys.size(); ++i) {
            keys[i] = static_cast<std::uint32_t>(i * 77);
        }
        params.face_keys = bytes_.below(4) == 0 ? keys.data() : nullptr;
        static const std::vector<std::uint8_t> mask = [&] {
            std::vector<std::uint8_t> values(keys.size());
            for (std::size_t i = 0; i < values.size(); ++i) {
                values[i] = i % 3 == 0 ? 1 : 0;
            }
            return values;
        }();
        params.face_mask = bytes_.below(4) == 0 ? mask.data() : nullptr;
        params.metric = static_cast<geodisk_metric>(bytes_.below(5)) - 1;
        return params;
    }

    void make_surface(geodisk_error* e) {
        const geodisk_surface_params params = surface_params();
        geodisk_domain* domain = nullptr;
        geodisk_domain_surface(meshes_.any(bytes_), &params, &domain, e);
        domains_.add(domain);
    }

    void make_surfaces(geodisk_error* e) {
        std::array<geodisk_surface_params, 3> params{};
        std::array<geodisk_surface_part, 3> parts{};
        for (std::size_t i = 0; i < parts.size(); ++i) {
            params[i] = surface_params();
            parts[i] = {sizeof parts[i], meshes_.any(bytes_),
                        bytes_.below(8) == 0 ? nullptr : &params[i], bytes_.number()};
        }
        geodisk_domain* domain = nullptr;
        geodisk_domain_surfaces(parts.data(), bytes_.below(parts.size() + 1), &domain, e);
        domains_.add(domain);
    }

    geodisk_box_params box_params(const std::array<double, 8>& sides) {
        auto params = bytes_.any_struct<geodisk_box_params>();
        params.extents = bytes_.below(8) == 0 ? nullptr : sides.data();
        params.dimension = static_cast<std::uint32_t>(bytes_.below(9));
        params.min_distance = bytes_.number();
        params.pool_ratio = bytes_.number();
        params.darts %= 1000;
        return params;
    }

    void make_box(geodisk_error* e) {
        std::array<double, 8> sides{};
        for (double& side : sides) {
            side = bytes_.number();
        }
        const geodisk_box_params params = box_params(sides);
        geodisk_domain* domain = nullptr;
        geodisk_domain_box(&params, &domain, e);
        domains_.add(domain);
        double distance = 0;
        geodisk_box_distance_for_count(&params, bytes_.number(), &distance, e);
    }

    void make_radii(geodisk_error* e) {
        std::array<double, kVertices> factors{};
        for (double& factor : factors) {
            factor = 0.5 + static_cast<double>(bytes_.below(8)) / 16;
        }
        factors[0] = bytes_.below(4) == 0 ? bytes_.number() : 1;
        geodisk_radii* radii = nullptr;
        const geodisk_type type = bytes_.below(4) == 0 ? GEODISK_FLOAT32 : GEODISK_FLOAT64;
        const auto create = bytes_.below(2) == 0 ? geodisk_radii_create : geodisk_density_create;
        create(meshes_.any(bytes_), factors.data(), type, bytes_.below(kVertices + 1), &radii, e);
        geodisk_radii_min_factor(radii);
        radii_.add(radii);
    }

    void sample(geodisk_error* e) {
        int left = 3; // Whole runs may take long.
        const auto told = [](void* user, const geodisk_progress* progress) -> std::int32_t {
            return --*static_cast<int*>(user) < 0 || progress->candidates > 100000 ? 1 : 0;
        };
        geodisk_samples* samples = nullptr;
        geodisk_sample(bytes_.below(16) == 0 ? nullptr : sampler_, domains_.any(bytes_), told,
                       &left, &samples, e);
        samples_.add(samples);
    }

    void copy(geodisk_error* e) {
        const geodisk_samples* const samples = samples_.any(bytes_);
        const std::size_t count = geodisk_samples_count(samples);
        const std::size_t stride = bytes_.below(100);
        std::vector<unsigned char> data(count * (stride < 64 ? 64 : stride) + 64);
        geodisk_samples_copy(samples, static_cast<geodisk_attribute>(bytes_.below(8)) - 1,
                             static_cast<geodisk_type>(bytes_.below(6)) - 1, data.data(), stride,
                             bytes_.below(4) == 0 ? bytes_.below(100) : count, e);
    }

    void find_distance(geodisk_error* e) {
        double distance = 0;
        geodisk_distance_for_count(meshes_.any(bytes_), radii_.any(bytes_), nullptr,
                                   bytes_.number(), &distance, e);
    }

    void save_and_load(geodisk_error* e) {
        std::size_t size = 0;
        const geodisk_mesh* const mesh = meshes_.any(bytes_);
        if (geodisk_mesh_save(mesh, nullptr, 0, &size, e) != GEODISK_OK) {
            return;
        }
        std::vector<unsigned char> saved(size);
        geodisk_mesh_save(mesh, saved.data(), size, &size, e);
        if (bytes_.below(2) == 0) {
            saved[bytes_.next<std::uint16_t>() % size] ^= bytes_.next<std::uint8_t>();
        }
        geodisk_mesh* loaded = nullptr;
        geodisk_mesh_load(saved.data(), size, &loaded, e);
        meshes_.add(loaded);
    }

    /// All that a job does without buffers: a range must be one of a VkBuffer.
    void plan_job(geodisk_error* e) {
        auto options = bytes_.any_struct<geodisk_job_options>();
        geodisk_job* job = nullptr;
        geodisk_job_create(device_, domains_.any(bytes_), bytes_.below(2) == 0 ? nullptr : &options,
                           &job, e);
        const std::uint32_t buffer = bytes_.next<std::uint8_t>();
        auto need = bytes_.any_struct<geodisk_buffer_need>();
        if (geodisk_job_need(job, buffer, &need, e) == GEODISK_OK &&
            need.struct_size == sizeof need && need.upload_bytes < (1u << 24)) {
            std::vector<unsigned char> data(need.upload_bytes + 8);
            geodisk_job_upload(job, buffer, data.data(), need.upload_bytes + bytes_.below(2), e);
        }
        const std::array<geodisk_buffer_range, GEODISK_BUFFERS> no_ranges{};
        geodisk_job_bind(job, no_ranges.data(), e);
        const std::array<unsigned char, 4096> control{};
        auto advice = bytes_.any_struct<geodisk_advice>();
        geodisk_job_advance(job, control.data(), bytes_.next<std::uint16_t>() % control.size(),
                            &advice, e);
        geodisk_job_set_seed(job, bytes_.next<std::uint64_t>(), e);
        geodisk_job_set_end_order(job, bytes_.next<std::uint64_t>(), e);
        const geodisk_sample_record given[] = {bytes_.next<geodisk_sample_record>()};
        geodisk_job_set_existing(job, given, bytes_.below(2), e);
        geodisk_job_renew(job, domains_.any(bytes_), e);
        auto params = bytes_.any_struct<geodisk_placement_params>();
        geodisk_placement* placement = nullptr;
        geodisk_placement_create(job, &params, &placement, e);
        geodisk_placement_release(placement);
        geodisk_job_release(job);
    }

    Bytes bytes_;
    geodisk_device* device_ = nullptr;
    geodisk_sampler* sampler_ = nullptr;
    Objects<geodisk_mesh, geodisk_mesh_release> meshes_;
    Objects<geodisk_radii, geodisk_radii_release> radii_;
    Objects<geodisk_domain, geodisk_domain_release> domains_;
    Objects<geodisk_samples, geodisk_samples_release> samples_;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static geodisk_device* const device = [] {
        geodisk_device* opened = nullptr;
        geodisk_device_open(nullptr, &opened, nullptr);
        return opened;
    }();
    static geodisk_sampler* const sampler = [] {
        geodisk_sampler* made = nullptr;
        geodisk_sampler_options options{};
        options.struct_size = sizeof options;
        options.device_bytes = std::uint64_t{64} << 20;
        geodisk_sampler_create(device, &options, &made, nullptr);
        return made;
    }();
    if (sampler == nullptr) {
        __builtin_trap(); // Fuzzing nothing finds nothing.
    }
    Program(Bytes(data, size)).run(device, sampler);
    return 0;
}
