#include "c/api.hpp"

#include <stdexcept>

namespace geodisk::test {

geodisk_mesh_params params_of(const TestMesh& mesh) {
    auto params = sized<geodisk_mesh_params>();
    params.positions = mesh.positions.data();
    params.vertex_count = mesh.positions.size() / 3;
    params.indices = mesh.triangles.data();
    params.face_count = mesh.triangles.size() / 3;
    return params;
}

Owned<geodisk_mesh> mesh_of(const TestMesh& mesh) {
    const geodisk_mesh_params params = params_of(mesh);
    return owned<geodisk_mesh>([&](auto** made, geodisk_error* error) {
        return geodisk_mesh_create(&params, made, error);
    });
}

Owned<geodisk_domain> surface_of(const geodisk_mesh* mesh, double min_distance,
                                 std::uint64_t seed) {
    auto params = sized<geodisk_surface_params>();
    params.min_distance = min_distance;
    params.seed = seed;
    return owned<geodisk_domain>([&](auto** made, geodisk_error* error) {
        return geodisk_domain_surface(mesh, &params, made, error);
    });
}

geodisk_device* shared_device() {
    static const auto kDevice = owned<geodisk_device>([](auto** made, geodisk_error* error) {
        return geodisk_device_open(nullptr, made, error);
    });
    return kDevice.get();
}

geodisk_sampler* shared_sampler() {
    static const auto kSampler = owned<geodisk_sampler>([](auto** made, geodisk_error* error) {
        return geodisk_sampler_create(shared_device(), nullptr, made, error);
    });
    return kSampler.get();
}

Owned<geodisk_samples> sample(geodisk_sampler* sampler, const geodisk_domain* domain) {
    return owned<geodisk_samples>([&](auto** made, geodisk_error* error) {
        return geodisk_sample(sampler, domain, nullptr, nullptr, made, error);
    });
}

namespace {

void copy(const geodisk_samples* samples, geodisk_attribute attribute, geodisk_type type,
          void* data) {
    auto error = sized<geodisk_error>();
    if (geodisk_samples_copy(samples, attribute, type, data, 0, geodisk_samples_count(samples),
                             &error) != GEODISK_OK) {
        throw std::runtime_error(error.message);
    }
}

} // namespace

Placed placed(const geodisk_samples* samples) {
    const std::size_t count = geodisk_samples_count(samples);
    Placed result{std::vector<std::uint32_t>(count), std::vector<float>(3 * count)};
    copy(samples, GEODISK_FACE, GEODISK_UINT32, result.faces.data());
    copy(samples, GEODISK_BARYCENTRIC, GEODISK_FLOAT32, result.weights.data());
    return result;
}

std::vector<double> positions(const geodisk_samples* samples) {
    std::vector<double> result(geodisk_samples_count(samples) *
                               geodisk_samples_width(samples, GEODISK_POSITION));
    copy(samples, GEODISK_POSITION, GEODISK_FLOAT64, result.data());
    return result;
}

} // namespace geodisk::test
