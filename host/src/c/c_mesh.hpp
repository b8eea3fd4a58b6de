// Meshes and radii of the C API.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <geodisk/geodisk.h>
#include <geodisk/mesh.hpp>
#include <geodisk/radius_field.hpp>
#include <geodisk/sample.hpp>

namespace geodisk::c {

/// A mesh with the data that places samples.
struct Mesh {
    PreparedMesh prepared;
    std::uint32_t dimension = 0;            ///< Coordinates per vertex; 0 without positions.
    std::vector<double> positions{};        ///< `dimension` coordinates per vertex.
    std::vector<std::uint32_t> triangles{}; ///< Three indices per face; empty without positions.
    std::vector<std::uint32_t> joined{}; ///< WeldedMesh::vertices; empty if no vertices are joined.
    std::uint64_t merged_vertices = 0;
    std::uint64_t joined_edges = 0;

    MeshView view() const { return {positions, triangles, dimension, true}; }
};

inline Sample sample_of(const geodisk_surface_point& point) {
    return {point.face, {point.weights[0], point.weights[1], point.weights[2]}};
}

inline std::vector<Sample> samples_of(const geodisk_surface_point* points, std::size_t count) {
    std::vector<Sample> samples(count);
    std::transform(points, points + count, samples.begin(), sample_of);
    return samples;
}

struct Radii {
    RadiusField field;
    std::uint64_t mesh; ///< PreparedMesh::identity() of their mesh.
};

} // namespace geodisk::c

struct geodisk_mesh {
    std::shared_ptr<const geodisk::c::Mesh> shared;
};

struct geodisk_radii {
    std::shared_ptr<const geodisk::c::Radii> shared;
};
