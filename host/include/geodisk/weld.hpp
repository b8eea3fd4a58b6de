// Joining vertices that lie in one place, as of files that keep three vertices for each triangle.
#pragma once

#include <cstdint>
#include <span>
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
    std::uint64_t merged_vertices = 0;    ///< Vertices that became another one.
    std::uint64_t degenerate_faces = 0;   ///< Faces that name a vertex twice since, not before.
    std::uint64_t joined_edges = 0;       ///< Border edges that join_seams() joined to others.
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

/// Joins the ends of border edges that lie exactly on other border edges, as along the seams of
/// texture coordinates and normals. `PreparedMesh::prepare` takes faces as connected where they
/// share vertices, so call this first for a mesh with seams.
///
/// A border edge is one of a single face; copies of a face count as one. Two edges coincide if both
/// ends have the same coordinates, -0 being 0. All that coincide become one edge, also three or
/// more. Nothing else is joined: parts without borders stay apart wherever they touch, as do
/// borders that meet in a point or overlap in part. An edge without length is a point. Only
/// triangles without area can vanish, but triangles on top of each other may become copies. A
/// second call finds nothing to join. Time is linear in the mesh, and that of sorting its borders.
///
/// Fails as weld() for the mesh; with `out_of_host_memory`.
GEODISK_API Result<WeldedMesh> join_seams(const MeshView& mesh) noexcept;

/// Border edges that nearly lie on others, as where a file rounds coordinates differently along a
/// seam.
struct NearSeams {
    std::uint64_t edges = 0; ///< Border edges whose ends are both close to those of another one.
    double gap = 0;          ///< Largest distance between such ends, in mesh units.
    double epsilon = 0;      ///< A round number for weld(), which then joins them all.
    std::uint64_t degenerate_faces = 0; ///< Faces that weld() then makes vanish.
};

/// Looks for seams that join_seams() leaves open by a small gap: at most 1/100 of the edges there,
/// and 1/10,000 of the bounding box of all borders. Where the surface itself is as narrow as that,
/// nothing counts. Edges that coincide exactly do not count. Time is that of sorting the borders.
///
/// Fails as weld() for the mesh; with `out_of_host_memory`.
GEODISK_API Result<NearSeams> find_near_seams(const MeshView& mesh) noexcept;

/// Returns for every vertex the mean of `values`, one per vertex, over all that it is joined with.
/// `vertices` is WeldedMesh::vertices. Both sides of a seam then have a say in what differs there.
/// Fails with `invalid_argument` where sizes or vertices are wrong; with `out_of_host_memory`.
GEODISK_API Result<std::vector<double>> means_of_joined(std::span<const std::uint32_t> vertices,
                                                        std::span<const double> values) noexcept;

} // namespace geodisk
