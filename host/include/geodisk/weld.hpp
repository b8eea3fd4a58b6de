// Joins vertices at the same place, for example in files that store three vertices per triangle.
// Stable.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geodisk/export.hpp"
#include "geodisk/mesh_view.hpp"
#include "geodisk/status.hpp"
#include "geodisk/threads.hpp"

namespace geodisk {

/// A mesh with joined vertices, over the positions of the original mesh. Faces and vertices keep
/// their numbers, so data per face and vertex stays valid. Vertices that were merged into another
/// one are no longer used.
struct WeldedMesh {
    std::vector<std::uint32_t> triangles; ///< Indices for MeshView::triangles.
    std::vector<std::uint32_t> vertices;  ///< Lowest vertex that each vertex is joined with.
    std::uint64_t merged_vertices = 0;    ///< Vertices merged into another one.
    std::uint64_t degenerate_faces = 0;   ///< Faces that name a vertex twice only after joining.
    std::uint64_t joined_edges = 0;       ///< Border edges that join_seams() joined to others.
};

/// Joins all used vertices that are at most `epsilon` apart, in mesh units, also through chains of
/// such vertices. 0 joins vertices with exactly the same coordinates; -0 equals 0. No vertex moves
/// by more than the length of its chain. Takes the time of sorting the vertices, unless many lie
/// within `epsilon` of each other.
///
/// Errors: `invalid_argument` if `epsilon` is negative or not finite, or above 0 and below 2^-43 of
/// the longest side of the bounding box; those of `PreparedMesh::prepare` for a wrong view, index
/// or used coordinate; `out_of_host_memory`.
GEODISK_API Result<WeldedMesh> weld(const MeshView& mesh, double epsilon = 0) noexcept;

/// Joins the ends of border edges that lie exactly on other border edges, for example along seams
/// of texture coordinates and normals. `PreparedMesh::prepare` does this itself.
///
/// A border edge belongs to a single face; copies of a face count as one. Edges coincide if both
/// ends have the same coordinates; -0 equals 0. All edges that coincide, also three or more, become
/// one edge. Nothing else is joined: parts without borders stay separate where they touch, and so
/// do borders that meet in a point or overlap in part. An edge without length counts as a point.
///
/// Only triangles without area can vanish, but triangles on top of each other may become copies. A
/// second call finds nothing to join. Takes time linear in the mesh, plus the sorting of its
/// borders.
///
/// Errors: those of weld() for the mesh; `out_of_host_memory`.
GEODISK_API Result<WeldedMesh> join_seams(const MeshView& mesh) noexcept;

/// Border edges that nearly coincide with others, for example where a file rounds coordinates
/// differently along a seam.
struct NearSeams {
    std::uint64_t edges = 0; ///< Border edges whose ends are both close to those of another one.
    double gap = 0;          ///< Largest distance between such ends, in mesh units.
    /// A round number with which weld() joins them all. 0 if the gap is so small beside the mesh
    /// that weld() takes none without losing faces.
    double epsilon = 0;
    std::uint64_t degenerate_faces = 0; ///< Faces that weld() then removes.
};

/// Finds seams that join_seams() leaves open by a small gap: at most 1/100 of the edges there, and
/// 1/10,000 of the bounding box of all borders. Ignores edges that coincide exactly, and finds
/// nothing where the surface itself is that narrow. Takes the time of sorting the borders.
///
/// Errors: those of weld() for the mesh; `invalid_argument` for wrong thread options;
/// `out_of_host_memory`.
GEODISK_API Result<NearSeams> find_near_seams(const MeshView& mesh,
                                              const ThreadOptions& threads = {}) noexcept;

/// Returns, for every vertex, the mean of `values` over all vertices that it is joined with. Use it
/// for data that differs between the two sides of a seam. `values` has one element per vertex,
/// `vertices` is WeldedMesh::vertices. Errors: `invalid_argument` for wrong sizes or vertices;
/// `out_of_host_memory`.
GEODISK_API Result<std::vector<double>> means_of_joined(std::span<const std::uint32_t> vertices,
                                                        std::span<const double> values) noexcept;

} // namespace geodisk
