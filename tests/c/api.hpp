// Short ways to the C API, for its tests.
#pragma once

#include <memory>
#include <vector>

#include <geodisk/geodisk.h>

#include "support/meshes.hpp"

namespace geodisk::test {

/// A struct of the C API, empty but for its size.
template <class Struct>
Struct sized() {
    Struct value{};
    value.struct_size = sizeof value;
    return value;
}

struct Release {
    void operator()(geodisk_device* object) const { geodisk_device_release(object); }
    void operator()(geodisk_mesh* object) const { geodisk_mesh_release(object); }
    void operator()(geodisk_radii* object) const { geodisk_radii_release(object); }
    void operator()(geodisk_domain* object) const { geodisk_domain_release(object); }
    void operator()(geodisk_sampler* object) const { geodisk_sampler_release(object); }
    void operator()(geodisk_samples* object) const { geodisk_samples_release(object); }
    void operator()(geodisk_job* object) const { geodisk_job_release(object); }
    void operator()(geodisk_frame_sampler* object) const { geodisk_frame_sampler_release(object); }
    void operator()(geodisk_frame_neighbours* object) const {
        geodisk_frame_neighbours_release(object);
    }
    void operator()(geodisk_placement* object) const { geodisk_placement_release(object); }
    void operator()(geodisk_updater* object) const { geodisk_updater_release(object); }
};
template <class Object>
using Owned = std::unique_ptr<Object, Release>;

/// Runs `make(object, error)`; throws std::runtime_error with its message.
template <class Object, class Make>
Owned<Object> owned(const Make& make) {
    Object* object = nullptr;
    auto error = sized<geodisk_error>();
    if (make(&object, &error) != GEODISK_OK) {
        throw std::runtime_error(error.message);
    }
    return Owned<Object>(object);
}

/// Returns the parameters of the mesh, which must outlive them.
geodisk_mesh_params params_of(const TestMesh& mesh);
Owned<geodisk_mesh> mesh_of(const TestMesh& mesh);
Owned<geodisk_domain> surface_of(const geodisk_mesh* mesh, double min_distance,
                                 std::uint64_t seed = 1);

/// One device and sampler for all tests.
geodisk_device* shared_device();
geodisk_sampler* shared_sampler();

Owned<geodisk_samples> sample(geodisk_sampler* sampler, const geodisk_domain* domain);

/// Faces and weights of all samples.
struct Placed {
    std::vector<std::uint32_t> faces;
    std::vector<float> weights;
    friend bool operator==(const Placed&, const Placed&) = default;
};
Placed placed(const geodisk_samples* samples);
std::vector<double> positions(const geodisk_samples* samples);

} // namespace geodisk::test
