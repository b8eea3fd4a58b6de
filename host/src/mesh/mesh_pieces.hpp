// Meshes that stand for a surface of which no process holds the whole.
#pragma once

#include "geodisk/mesh.hpp"
#include "geodisk/status.hpp"

namespace geodisk {

struct MeshPieces {
    /// Returns a mesh without faces that has the statistics of the whole.
    static PreparedMesh outline(const MeshStatistics& whole);

    /// Returns PreparedMesh::part() of the whole for these faces, whose vertices are in the order
    /// of the whole, to the bit. The faces may have no area. They must have passed the checks of
    /// PreparedMesh::prepare(). Throws std::bad_alloc.
    static PreparedMesh piece(const MeshView& faces, const MeshStatistics& whole);
};

} // namespace geodisk
