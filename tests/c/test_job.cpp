// Runs that a program in C records into its own command buffers, in its own memory.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "c/api.hpp"
#include "c/c_job.hpp"
#include "c/lent.hpp"
#include "device_run.hpp"
#include "embed/workshop.hpp"

namespace geodisk::test {
namespace {

geodisk_buffer_range given_range(const BufferRange& range) {
    return {number_of(range.buffer), range.offset, range.size};
}

/// A device that is lent, a job on it, and an engine that records it.
class Recording {
  public:
    Recording(const geodisk_domain* domain, const geodisk_job_options& options)
        : device_(borrowed(lent_device(shared_context().device(), shared_context().queue()))),
          job_(owned<geodisk_job>([&](auto** made, geodisk_error* error) {
              return geodisk_job_create(device_.get(), domain, &options, made, error);
          })),
          workshop_(shared_context()) {}

    geodisk_job* job() const { return job_.get(); }
    Workshop& workshop() { return workshop_; }
    std::uint64_t candidates() const { return candidates_; }
    std::uint32_t times(geodisk_next next) const {
        return static_cast<std::uint32_t>(std::count(seen_.begin(), seen_.end(), next));
    }

    geodisk_buffer_need need(std::uint32_t buffer) const {
        auto need = sized<geodisk_buffer_need>();
        REQUIRE(geodisk_job_need(job(), buffer, &need, nullptr) == GEODISK_OK);
        return need;
    }

    void bind_all(bool uploads = true) {
        WorkspaceNeeds needs;
        for (std::uint32_t i = 0; i < GEODISK_BUFFERS; ++i) {
            needs.bytes[i] = need(i).bytes;
        }
        workspace_ = workshop_.cut(needs);
        bind();
        if (uploads) {
            upload();
        }
    }

    /// Frames until the samples are there, or another step comes; as many as are returned.
    std::uint32_t run(std::size_t lag = 0, geodisk_next until = GEODISK_COMPLETE) {
        std::vector<std::vector<std::byte>> reports(lag + 1,
                                                    std::vector<std::byte>(control_bytes()));
        for (std::size_t frame = 0; frame < 10'000; ++frame) {
            auto advice = sized<geodisk_advice>();
            auto error = sized<geodisk_error>();
            const geodisk_status status = geodisk_job_advance(
                job(), reports[frame].data(), reports[frame].size(), &advice, &error);
            INFO(error.message);
            REQUIRE(status == GEODISK_OK);
            seen_.push_back(advice.next);
            if (advice.next == until) {
                candidates_ = advice.candidates;
                return advice.ready;
            }
            if (advice.next == GEODISK_LARGER_POOL || advice.next == GEODISK_LARGER_SAMPLES) {
                replace_small();
            } else if (advice.next == GEODISK_START_OVER) {
                workshop_.start_over();
                bind_all();
            }
            record(advice.next, advice.next == GEODISK_BEGIN ? 3 : 2);
            reports.push_back(control_);
        }
        FAIL("the rounds lead nowhere");
        return 0;
    }

    /// Makes the job one of another domain, in the buffers it has if they are large enough.
    bool renew(const geodisk_domain* domain) {
        REQUIRE(geodisk_job_renew(job(), domain, nullptr) == GEODISK_OK);
        bool is_enough = true;
        for (std::uint32_t i = 0; i < GEODISK_BUFFERS; ++i) {
            is_enough &= need(i).bytes <= workspace_[i].size;
        }
        if (is_enough) {
            bind();
            upload();
        } else {
            workshop_.start_over();
            bind_all();
        }
        return is_enough;
    }

    void record(geodisk_next what, std::uint32_t amount) {
        workshop_.frame(0, [&](VkCommandBuffer commands) {
            auto error = sized<geodisk_error>();
            const geodisk_status status =
                geodisk_job_record(job(), commands, what, amount, nullptr, &error);
            INFO(error.message);
            REQUIRE(status == GEODISK_OK);
            workshop_.barrier(commands, Sampler::kLastUse, Workshop::kCopied);
            workshop_.record_download(commands, workspace_[GEODISK_CONTROL_BUFFER],
                                      control_bytes());
            workshop_.barrier(commands, Workshop::kCopied, Sampler::kFirstUse);
        });
        control_.assign(workshop_.download_bytes().begin(),
                        workshop_.download_bytes().begin() +
                            static_cast<std::ptrdiff_t>(control_bytes()));
    }

    /// Returns what a buffer of the device holds.
    template <class Value>
    std::vector<Value> read(const BufferRange& range, std::size_t count) {
        workshop_.frame(0, [&](VkCommandBuffer commands) {
            workshop_.barrier(commands, Sampler::kLastUse, Workshop::kCopied);
            workshop_.record_download(commands, range, count * sizeof(Value));
        });
        std::vector<Value> values(count);
        std::memcpy(values.data(), workshop_.download_bytes().data(), count * sizeof(Value));
        return values;
    }
    const BufferRange& buffer(std::uint32_t which) const { return workspace_[which]; }

    Placed placed(std::uint32_t count) {
        Placed result;
        for (const auto& sample :
             read<geodisk_sample_record>(buffer(GEODISK_SAMPLES_BUFFER), count)) {
            result.faces.push_back(sample.face);
            const float first = 1.0f - sample.weight1 - sample.weight2;
            result.weights.insert(result.weights.end(), {first, sample.weight1, sample.weight2});
        }
        return result;
    }

    void write(const BufferRange& range, const void* data, std::size_t bytes) {
        std::memcpy(workshop_.upload_bytes().data(), data, bytes);
        workshop_.frame(0, [&](VkCommandBuffer commands) {
            workshop_.record_upload(commands, range, 0, bytes);
            workshop_.barrier(commands, Workshop::kUploaded, Sampler::kFirstUse);
        });
    }

  private:
    std::size_t control_bytes() const { return need(GEODISK_CONTROL_BUFFER).read_bytes; }

    void bind() {
        std::vector<geodisk_buffer_range> ranges(GEODISK_BUFFERS);
        std::transform(workspace_.begin(), workspace_.end(), ranges.begin(), given_range);
        auto error = sized<geodisk_error>();
        const geodisk_status status = geodisk_job_bind(job(), ranges.data(), &error);
        INFO(error.message);
        REQUIRE(status == GEODISK_OK);
    }

    void upload() {
        for (std::uint32_t i = 0; i < GEODISK_BUFFERS; ++i) {
            std::vector<std::byte> bytes(need(i).upload_bytes);
            if (!bytes.empty()) {
                REQUIRE(geodisk_job_upload(job(), i, bytes.data(), bytes.size(), nullptr) ==
                        GEODISK_OK);
                write(workspace_[i], bytes.data(), bytes.size());
            }
        }
    }

    /// Buffers that are too small by now, with what they held.
    void replace_small() {
        WorkspaceNeeds needs;
        for (std::uint32_t i = 0; i < GEODISK_BUFFERS; ++i) {
            const std::uint64_t bytes = need(i).bytes;
            needs.bytes[i] = bytes > workspace_[i].size ? bytes : 0;
        }
        const Workspace larger = workshop_.cut(needs);
        for (std::uint32_t i = 0; i < GEODISK_BUFFERS; ++i) {
            if (needs.bytes[i] != 0) {
                const auto held = read<std::byte>(workspace_[i], workspace_[i].size);
                workspace_[i] = larger[i];
                write(workspace_[i], held.data(), held.size());
            }
        }
        bind();
    }

    Owned<geodisk_device> device_;
    Owned<geodisk_job> job_;
    Workshop workshop_;
    Workspace workspace_;
    std::vector<std::byte> control_;
    std::vector<geodisk_next> seen_;
    std::uint64_t candidates_ = 0;
};

geodisk_job_options small_options() {
    auto options = sized<geodisk_job_options>();
    options.pool_bytes = Workshop::kPoolBytes;
    return options;
}

const TestMesh& knot() {
    static const TestMesh kMesh = builtin("torus-knot", 8);
    return kMesh;
}

Owned<geodisk_domain> knot_domain(std::uint64_t seed = 1) {
    const auto mesh = mesh_of(knot());
    double distance = 0;
    REQUIRE(geodisk_distance_for_count(mesh.get(), nullptr, nullptr, 200, &distance, nullptr) ==
            GEODISK_OK);
    return surface_of(mesh.get(), distance, seed);
}

Owned<geodisk_domain> cube_domain() {
    const double extents[] = {1, 1, 1};
    auto params = sized<geodisk_box_params>();
    params.extents = extents;
    params.dimension = 3;
    params.is_periodic = 1;
    params.min_distance = 0.2;
    return owned<geodisk_domain>([&](auto** made, geodisk_error* error) {
        return geodisk_domain_box(&params, made, error);
    });
}

Placed wanted(const geodisk_domain* domain) {
    return placed(sample(shared_sampler(), domain).get());
}

} // namespace

TEST_CASE("a job that is recorded has the samples of one that is run") {
    const auto domain = knot_domain();
    Recording recording(domain.get(), small_options());
    recording.bind_all();
    CHECK(recording.placed(recording.run()) == wanted(domain.get()));
    CHECK(recording.workshop().damage() == 0);

    // Another seed in the same buffers, with the host two frames behind.
    REQUIRE(geodisk_job_set_seed(recording.job(), 7, nullptr) == GEODISK_OK);
    CHECK(recording.placed(recording.run(2)) == wanted(knot_domain(7).get()));
    CHECK(recording.workshop().damage() == 0);
}

TEST_CASE("a job becomes one of another domain, in the same buffers or larger ones") {
    const auto domain = knot_domain();
    Recording recording(domain.get(), small_options());
    recording.bind_all();
    REQUIRE(geodisk_job_set_seed(recording.job(), 7, nullptr) == GEODISK_OK);
    recording.run();

    const auto again = knot_domain(3);
    CHECK(recording.renew(again.get()));
    CHECK(recording.placed(recording.run()) == wanted(again.get()));

    // In the middle of a run, before anything of it is decided.
    const auto mesh = mesh_of(builtin("icosphere", 2));
    double distance = 0;
    REQUIRE(geodisk_distance_for_count(mesh.get(), nullptr, nullptr, 100, &distance, nullptr) ==
            GEODISK_OK);
    const auto sphere = surface_of(mesh.get(), distance, 9);
    REQUIRE(geodisk_job_set_seed(recording.job(), 8, nullptr) == GEODISK_OK);
    recording.record(GEODISK_BEGIN, 1);
    recording.renew(sphere.get());
    CHECK(recording.placed(recording.run()) == wanted(sphere.get()));

    // With other kernels.
    const auto cube = cube_domain();
    recording.renew(cube.get());
    CHECK(recording.run() == geodisk_samples_count(sample(shared_sampler(), cube.get()).get()));

    REQUIRE(geodisk_distance_for_count(mesh.get(), nullptr, nullptr, 3000, &distance, nullptr) ==
            GEODISK_OK);
    const auto many = surface_of(mesh.get(), distance, 9);
    CHECK_FALSE(recording.renew(many.get()));
    CHECK(recording.placed(recording.run()) == wanted(many.get()));
    CHECK(recording.workshop().damage() == 0);

    CHECK(geodisk_job_renew(recording.job(), nullptr, nullptr) == GEODISK_INVALID_ARGUMENT);
    CHECK(geodisk_job_renew(nullptr, domain.get(), nullptr) == GEODISK_INVALID_ARGUMENT);
    CHECK(recording.placed(recording.run()) == wanted(many.get())); // As it was.
}

TEST_CASE("a job in one buffer by its layout; what is not uploaded is an error, not no samples") {
    const auto domain = knot_domain();
    Recording recording(domain.get(), small_options());
    std::vector<geodisk_buffer_range> ranges(GEODISK_BUFFERS);
    std::uint64_t bytes = 0, same = 0;
    const auto lay_out = [&](std::uint64_t offset, std::uint64_t* size) {
        return geodisk_job_lay_out(recording.job(), 7, offset, ranges.data(), size, nullptr);
    };
    REQUIRE(lay_out(0, &bytes) == GEODISK_OK);
    std::uint64_t end = 0;
    for (std::uint32_t i = 0; i < GEODISK_BUFFERS; ++i) {
        CHECK(ranges[i].bytes == recording.need(i).bytes);
        CHECK((ranges[i].bytes == 0 || (ranges[i].buffer == 7 && ranges[i].offset >= end)));
        end = ranges[i].bytes == 0 ? end : ranges[i].offset + ranges[i].bytes;
    }
    CHECK(end <= bytes);
    REQUIRE(lay_out(1 << 20, &same) == GEODISK_OK);
    CHECK(same == bytes);
    CHECK(ranges[0].offset == 1 << 20);
    CHECK(lay_out(1, &same) == GEODISK_INVALID_ARGUMENT);
    CHECK(lay_out(0, nullptr) == GEODISK_INVALID_ARGUMENT);

    recording.bind_all(false);
    auto error = sized<geodisk_error>();
    recording.workshop().frame(0, [&](VkCommandBuffer commands) {
        CHECK(geodisk_job_record(recording.job(), commands, GEODISK_BEGIN, 0, nullptr, &error) ==
              GEODISK_INVALID_ARGUMENT);
    });
    CHECK(std::string(error.message).find("geodisk_job_upload") != std::string::npos);
}

TEST_CASE("a job in a box leaves its order on the device") {
    const auto domain = cube_domain();
    Recording recording(domain.get(), small_options());
    recording.bind_all();
    const std::uint32_t count = recording.run();
    CHECK(count == geodisk_samples_count(sample(shared_sampler(), domain.get()).get()));
    const auto records =
        recording.read<geodisk_sample_record>(recording.buffer(GEODISK_SAMPLES_BUFFER), count);
    CHECK(std::ranges::is_sorted(records, {}, &geodisk_sample_record::order));
}

TEST_CASE("a job throws an exact number of darts, and stops at orders") {
    const auto mesh = mesh_of(knot());
    auto params = sized<geodisk_surface_params>();
    REQUIRE(geodisk_distance_for_count(mesh.get(), nullptr, nullptr, 200, &params.min_distance,
                                       nullptr) == GEODISK_OK);
    params.darts = 3'000;
    const auto domain = owned<geodisk_domain>([&](auto** made, geodisk_error* error) {
        return geodisk_domain_surface(mesh.get(), &params, made, error);
    });
    Recording recording(domain.get(), small_options());
    recording.bind_all();
    const Placed set = wanted(domain.get());
    CHECK(recording.placed(recording.run()) == set);
    CHECK(recording.times(GEODISK_COUNT) > 0);
    CHECK(recording.candidates() == 3'000);

    REQUIRE(geodisk_job_set_seed(recording.job(), params.seed, nullptr) == GEODISK_OK);
    std::uint32_t before = 0;
    for (const std::uint64_t order : {std::uint64_t{1} << 24, std::uint64_t{3} << 27}) {
        REQUIRE(geodisk_job_set_end_order(recording.job(), order, nullptr) == GEODISK_OK);
        const std::uint32_t ready = recording.run(0, GEODISK_PAUSED);
        CHECK(ready > before);
        CHECK(ready < set.faces.size());
        before = ready;
    }
    REQUIRE(geodisk_job_set_end_order(recording.job(), GEODISK_ALL_ORDERS, nullptr) == GEODISK_OK);
    CHECK(recording.placed(recording.run()) == set);
    CHECK(geodisk_job_set_end_order(nullptr, 0, nullptr) == GEODISK_INVALID_ARGUMENT);
}

TEST_CASE("rounds of a job are recorded in parts") {
    const auto domain = knot_domain();
    Recording recording(domain.get(), small_options());
    recording.bind_all();
    recording.record(GEODISK_BEGIN, 0);
    for (int round = 0; round < 150; ++round) {
        for (const geodisk_next part : {GEODISK_SELECT, GEODISK_DETECT, GEODISK_RESOLVE}) {
            recording.record(part, 0);
        }
    }
    CHECK(recording.placed(recording.run()) == wanted(domain.get()));
    CHECK(recording.times(GEODISK_GO_ON) <= 1); // Before the first record is there.
}

TEST_CASE("a job begins with samples that are given") {
    const auto domain = knot_domain();
    Recording recording(domain.get(), small_options());
    recording.bind_all();
    const Placed set = wanted(domain.get());
    const std::uint32_t count = recording.run();
    auto given =
        recording.read<geodisk_sample_record>(recording.buffer(GEODISK_SAMPLES_BUFFER), count / 2);
    const auto set_existing = [&](std::size_t size) {
        REQUIRE(geodisk_job_set_existing(recording.job(), given.data(), size, nullptr) ==
                GEODISK_OK);
        CHECK(recording.need(GEODISK_SAMPLES_BUFFER).upload_bytes ==
              size * sizeof(geodisk_sample_record));
        recording.workshop().start_over();
    };
    set_existing(given.size());
    recording.bind_all();
    CHECK(recording.placed(recording.run()) == set);
    set_existing(0);
    recording.bind_all();
    CHECK(recording.placed(recording.run()) == set);

    CHECK(geodisk_job_set_existing(recording.job(), nullptr, 1, nullptr) ==
          GEODISK_INVALID_ARGUMENT);
    given[1].face = 1'000'000;
    set_existing(2);
    std::vector<geodisk_buffer_range> ranges(GEODISK_BUFFERS);
    WorkspaceNeeds needs;
    for (std::uint32_t i = 0; i < GEODISK_BUFFERS; ++i) {
        needs.bytes[i] = recording.need(i).bytes;
    }
    const Workspace workspace = recording.workshop().cut(needs);
    std::transform(workspace.begin(), workspace.end(), ranges.begin(), given_range);
    auto error = sized<geodisk_error>();
    CHECK(geodisk_job_bind(recording.job(), ranges.data(), &error) == GEODISK_INVALID_ARGUMENT);
    CHECK(std::string(error.message).find("existing sample 1 is in face") != std::string::npos);
}

TEST_CASE("buffers of a job that become too small are replaced") {
    const auto domain = knot_domain();
    const Placed set = wanted(domain.get());

    Recording pool(domain.get(), small_options());
    pool.job()->plan = tightened(pool.job()->plan);
    pool.job()->needed[GEODISK_POOL_BUFFER] = pool.job()->plan.pool_bytes();
    pool.bind_all();
    CHECK(pool.placed(pool.run()) == set);
    CHECK(pool.times(GEODISK_LARGER_POOL) > 1);

    Recording samples(domain.get(), small_options());
    RunPlan& plan = samples.job()->plan;
    plan.slots = 16;
    plan.lanes = std::min(plan.lanes, plan.slots);
    plan.sample_capacity = 40;
    const auto bytes =
        samples.job()->sampler->workspace_needs(*samples.job()->domain->domain, plan, 0);
    samples.job()->needed = expect(bytes).bytes;
    samples.bind_all();
    CHECK(samples.placed(samples.run()) == set);
    CHECK(samples.times(GEODISK_LARGER_SAMPLES) > 1);
}

TEST_CASE("a job samples with a seed of its own") {
    const auto domain = knot_domain(3);
    Recording recording(domain.get(), small_options());
    REQUIRE(geodisk_job_set_seed(recording.job(), 5, nullptr) == GEODISK_OK);
    recording.bind_all();
    CHECK(recording.placed(recording.run()) == wanted(knot_domain(5).get()));
}

TEST_CASE("samples of a job are placed on the device, where they are drawn") {
    const auto domain = knot_domain();
    const auto set = sample(shared_sampler(), domain.get());
    const std::size_t count = geodisk_samples_count(set.get());
    Recording recording(domain.get(), small_options());
    recording.bind_all();
    const std::uint32_t ready = recording.run();
    REQUIRE(ready == count);

    const std::vector<float> positions(knot().positions.begin(), knot().positions.end());
    const std::size_t capacity =
        recording.need(GEODISK_SAMPLES_BUFFER).bytes / sizeof(geodisk_sample_record);
    WorkspaceNeeds needs;
    needs.bytes[0] = positions.size() * sizeof positions[0];
    needs.bytes[1] = knot().triangles.size() * sizeof knot().triangles[0];
    needs.bytes[2] = capacity * sizeof(geodisk_placed_record);
    needs.bytes[3] = 16;
    const Workspace drawn = recording.workshop().cut(needs);
    recording.write(drawn[0], positions.data(), needs.bytes[0]);
    recording.write(drawn[1], knot().triangles.data(), needs.bytes[1]);

    auto params = sized<geodisk_placement_params>();
    params.vertices = given_range(drawn[0]);
    params.indices = given_range(drawn[1]);
    params.placed = given_range(drawn[2]);
    params.arguments = given_range(drawn[3]);
    params.vertices_each = 4;
    const auto placement = owned<geodisk_placement>([&](auto** made, geodisk_error* error) {
        return geodisk_placement_create(recording.job(), &params, made, error);
    });
    recording.workshop().frame(0, [&](VkCommandBuffer commands) {
        REQUIRE(geodisk_placement_record(placement.get(), recording.job(), commands, nullptr) ==
                GEODISK_OK);
    });
    CHECK(recording.read<std::uint32_t>(drawn[3], 4) == std::vector<std::uint32_t>{4, ready, 0, 0});

    std::vector<double> points(3 * count), normals(3 * count), radii(count);
    const auto copy = [&](geodisk_attribute attribute, std::vector<double>& to) {
        REQUIRE(geodisk_samples_copy(set.get(), attribute, GEODISK_FLOAT64, to.data(), 0, count,
                                     nullptr) == GEODISK_OK);
    };
    copy(GEODISK_POSITION, points);
    copy(GEODISK_NORMAL, normals);
    copy(GEODISK_RADIUS, radii);
    const auto records = recording.read<geodisk_placed_record>(drawn[2], count);
    const std::vector<std::uint32_t> faces = placed(set.get()).faces;
    for (std::size_t i = 0; i < count; ++i) {
        CHECK(records[i].face == faces[i]);
        CHECK(records[i].part == 0);
        CHECK(records[i].radius == doctest::Approx(radii[i]));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            CHECK(records[i].position[axis] == doctest::Approx(points[3 * i + axis]).epsilon(1e-5));
            CHECK(records[i].normal[axis] == doctest::Approx(normals[3 * i + axis]).epsilon(1e-4));
        }
    }

    params.index_type = GEODISK_FLOAT32;
    geodisk_placement* none = nullptr;
    REQUIRE(geodisk_job_renew(recording.job(), domain.get(), nullptr) == GEODISK_OK);
    CHECK(geodisk_placement_create(recording.job(), &params, &none, nullptr) ==
          GEODISK_INVALID_ARGUMENT); // Until it has buffers.
    CHECK(recording.renew(knot_domain(2).get()));
    recording.run();
    recording.workshop().frame(0, [&](VkCommandBuffer commands) {
        CHECK(geodisk_placement_record(placement.get(), recording.job(), commands, nullptr) ==
              GEODISK_INVALID_ARGUMENT);
    });

    CHECK(geodisk_placement_create(recording.job(), &params, &none, nullptr) ==
          GEODISK_INVALID_ARGUMENT);
    params.index_type = GEODISK_UINT32;
    params.vertex_stride = 6;
    CHECK(geodisk_placement_create(recording.job(), &params, &none, nullptr) ==
          GEODISK_INVALID_ARGUMENT);
    CHECK(none == nullptr);
}

TEST_CASE("calls of a job that come too early, or make no sense, are refused") {
    const auto domain = knot_domain();
    Recording recording(domain.get(), small_options());
    geodisk_job* const job = recording.job();
    const auto is_wrong = [](const std::string& part,
                             const std::function<geodisk_status(geodisk_error*)>& call) {
        auto error = sized<geodisk_error>();
        CHECK(call(&error) == GEODISK_INVALID_ARGUMENT);
        INFO(error.message);
        CHECK(std::string(error.message).find(part) != std::string::npos);
    };
    geodisk_job* none = nullptr;
    is_wrong("NULL",
             [&](auto* e) { return geodisk_job_create(nullptr, domain.get(), nullptr, &none, e); });
    is_wrong("NULL", [&](auto* e) {
        return geodisk_job_create(shared_device(), nullptr, nullptr, &none, e);
    });
    is_wrong("job is NULL", [&](auto* e) { return geodisk_job_set_seed(nullptr, 1, e); });

    auto need = sized<geodisk_buffer_need>();
    is_wrong("there are 14", [&](auto* e) { return geodisk_job_need(job, 14, &need, e); });
    is_wrong("need is NULL", [&](auto* e) { return geodisk_job_need(job, 0, nullptr, e); });
    std::vector<std::byte> bytes(8);
    is_wrong("data is NULL", [&](auto* e) { return geodisk_job_upload(job, 0, nullptr, 0, e); });
    is_wrong("", [&](auto* e) { return geodisk_job_upload(job, 0, bytes.data(), 8, e); });
    is_wrong("", [&](auto* e) {
        return geodisk_job_upload(job, GEODISK_POOL_BUFFER, bytes.data(), 8, e);
    });

    auto advice = sized<geodisk_advice>();
    std::vector<std::byte> control(recording.need(GEODISK_CONTROL_BUFFER).read_bytes);
    const auto advance = [&](std::size_t size, auto* e) {
        return geodisk_job_advance(job, control.data(), size, &advice, e);
    };
    is_wrong("needs buffers", [&](auto* e) { return advance(control.size(), e); });
    is_wrong("bytes is not", [&](auto* e) { return advance(control.size() - 4, e); });
    is_wrong("ranges is NULL", [&](auto* e) { return geodisk_job_bind(job, nullptr, e); });
    const std::vector<geodisk_buffer_range> no_ranges(GEODISK_BUFFERS);
    is_wrong("", [&](auto* e) { return geodisk_job_bind(job, no_ranges.data(), e); });

    recording.workshop().frame(0, [&](VkCommandBuffer commands) {
        const auto record = [&](geodisk_next what, auto* e) {
            return geodisk_job_record(job, commands, what, 0, nullptr, e);
        };
        is_wrong("needs buffers", [&](auto* e) { return record(GEODISK_BEGIN, e); });
    });
    recording.bind_all();
    is_wrong("no other buffers",
             [&](auto* e) { return geodisk_job_bind(job, no_ranges.data(), e); });
    is_wrong("command_buffer is NULL", [&](auto* e) {
        return geodisk_job_record(job, nullptr, GEODISK_BEGIN, 0, nullptr, e);
    });
    recording.workshop().frame(0, [&](VkCommandBuffer commands) {
        const auto record = [&](geodisk_next what, auto* e) {
            return geodisk_job_record(job, commands, what, 0, nullptr, e);
        };
        for (const geodisk_next early : {GEODISK_GO_ON, GEODISK_FINISH, GEODISK_LARGER_POOL}) {
            is_wrong("GEODISK_BEGIN comes first", [&](auto* e) { return record(early, e); });
        }
        std::int32_t is_last = 1;
        CHECK(geodisk_job_record(job, commands, GEODISK_BEGIN, 1, &is_last, nullptr) == GEODISK_OK);
        CHECK(is_last == 0);
        is_wrong("no larger buffers", [&](auto* e) { return record(GEODISK_LARGER_POOL, e); });
        is_wrong("none of geodisk_next", [&](auto* e) { return record(99, e); });
        CHECK(geodisk_job_record(job, commands, GEODISK_GO_ON, 0, &is_last, nullptr) == GEODISK_OK);
        CHECK(is_last == 1);
        job->is_held = true;
        CHECK(record(GEODISK_GO_ON, static_cast<geodisk_error*>(nullptr)) == GEODISK_BUSY);
        job->is_held = false;
    });
}

} // namespace geodisk::test
