// The meshes and radii of the C API.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <geodisk/geodisk.h>
#include <geodisk/mesh.hpp>
#include <geodisk/radius_field.hpp>

namespace geodisk::c {

/// A mesh, and what its samples are placed by.
struct Mesh {
    PreparedMesh prepared;
    std::uint32_t dimension = 0;            ///< Of the positions; 0 without any.
    std::vector<double> positions{};        ///< `dimension` for each vertex.
    std::vector<std::uint32_t> triangles{}; ///< Empty without positions.
    std::vector<std::uint32_t> joined{};    ///< WeldedMesh::vertices; empty where none are joined.
    std::uint64_t merged_vertices = 0;
    std::uint64_t joined_edges = 0;

    MeshView view() const { return {positions, triangles, dimension}; }
};

struct Radii {
    RadiusField field;
    std::uint64_t mesh; ///< PreparedMesh::identity() of theirs.
};

} // namespace geodisk::c

struct geodisk_mesh {
    std::shared_ptr<const geodisk::c::Mesh> shared;
};

struct geodisk_radii {
    std::shared_ptr<const geodisk::c::Radii> shared;
};
