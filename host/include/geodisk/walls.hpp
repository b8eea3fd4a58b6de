// Cuts a mesh along walls, which no path crosses.
// Experimental.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geodisk/export.hpp"
#include "geodisk/mesh_view.hpp"
#include "geodisk/status.hpp"

namespace geodisk {

/// Faces and edges that no path crosses, for example the medial wall of a cortex, or the walls of
/// rooms.
struct Walls {
    /// A byte per face, other than 0 for a wall. Empty for none.
    std::span<const std::uint8_t> faces{};
    /// Edges, each by its two vertices in any order.
    std::span<const std::array<std::uint32_t, 2>> edges{};
};

/// A mesh cut along walls. Faces keep their numbers, and so do the vertices of the original mesh;
/// its own further vertices are copies of some of them.
struct CutMesh {
    /// Indices for MeshView::triangles. A face that is a wall names one vertex three times.
    std::vector<std::uint32_t> triangles;
    /// The vertex that each further vertex is a copy of: vertex `vertex_count + i` lies where
    /// `copied[i]` does.
    std::vector<std::uint32_t> copied;
};

/// Cuts a mesh along walls. Faces that are walls vanish: the rest is connected as if the mesh never
/// had them. Edges that are walls become borders of the faces on all their sides. A vertex that
/// walls of edges pass is copied, so that each side has its own, also where they pass along a
/// border; around the end of a wall paths still lead. The lowest face of a vertex keeps it.
///
/// Prepare the result with MeshView::keep_seams, or its borders are joined again: if seams are to
/// be joined, cut what join_seams() or weld() makes. Takes the time of sorting the edges at walls.
///
/// Errors: `invalid_argument` for a number of bytes other than that of faces, and for an edge that
/// no face has, with its index in `Error::element`; `mesh_rejected`, with the face in
/// `Error::element`, for an index out of range; for walls that leave no face; and for more copies
/// than can be numbered. `out_of_host_memory`.
GEODISK_API Result<CutMesh> cut(const IndexView& triangles, std::uint32_t vertex_count,
                                const Walls& walls) noexcept;

} // namespace geodisk
