// Meshes that stand for a surface of which no process holds the whole.
#pragma once

#include <cstdint>
#include <span>

#include "geodisk/mesh.hpp"
#include "geodisk/status.hpp"

namespace geodisk {

struct MeshPieces {
    /// Returns a mesh without faces that has the statistics of the whole.
    static PreparedMesh outline(const MeshStatistics& whole);

    /// Returns PreparedMesh::part() of these faces, which must ascend. They may have no area.
    /// Throws std::bad_alloc.
    static PreparedMesh part(const PreparedMesh& whole, std::span<const std::uint32_t> faces);

    /// Returns PreparedMesh::part() of the whole for these faces, whose vertices are in the order
    /// of the whole, to the bit. The faces may have no area. They must have passed the checks of
    /// PreparedMesh::prepare(). Throws std::bad_alloc.
    static PreparedMesh piece(const MeshView& faces, const MeshStatistics& whole);
};

} // namespace geodisk
