// Joining vertices that lie in one place, as of files that keep three vertices for each triangle.
#pragma once

#include <cstdint>
#include <vector>

#include "geodisk/export.hpp"
#include "geodisk/mesh_view.hpp"
#include "geodisk/status.hpp"

namespace geodisk {

/// A mesh with joined vertices, over the positions of the one it was made of: faces and vertices
/// keep their numbers, so that what belongs to them still does. Vertices that became another one
/// are no longer used.
struct WeldedMesh {
    std::vector<std::uint32_t> triangles; ///< For MeshView::triangles.
    std::vector<std::uint32_t> vertices;  ///< What each became: the lowest it is joined with.
    std::uint64_t merged_vertices = 0;    ///< Those that became another one.
    std::uint64_t degenerate_faces = 0;   ///< Faces that name a vertex twice since, not before.
};

/// Joins all used vertices that are no farther apart than `epsilon`, in mesh units, and those that
/// chains of such vertices connect; with 0, those of exactly the same coordinates, -0 being 0. No
/// vertex moves by more than the length of its chain. Time is that of sorting the vertices, if not
/// many lie within `epsilon` of each other.
///
/// Fails with `invalid_argument` when `epsilon` is negative or not finite, or above 0 and below
/// 2^-43 of the longest side of the bounding box, and as `PreparedMesh::prepare` where the view,
/// an index or a used coordinate is wrong; with `out_of_host_memory`.
GEODISK_API Result<WeldedMesh> weld(const MeshView& mesh, double epsilon = 0) noexcept;

} // namespace geodisk
