// PreparedMesh: a triangle mesh in intrinsic form, ready for sampling.
// Stable.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geodisk/detail/uninitialized.hpp"
#include "geodisk/export.hpp"
#include "geodisk/mesh_view.hpp"
#include "geodisk/status.hpp"
#include "geodisk/threads.hpp"

namespace geodisk {

/// Cosine and sine of an angle.
struct Direction {
    double cosine, sine;
};

/// Half-edge number `h = 3 * face + corner`. Runs from that corner to the next one of its face.
///
/// Its frame has the origin at the start, x along the edge and the face in y >= 0. It depends on
/// edge lengths only. Lengths are in mesh units.
struct HalfEdge {
    double length;
    double apex_x, apex_y;    ///< Third corner of the face in this frame; apex_y >= 0.
    std::uint32_t origin;     ///< Vertex where the half-edge starts.
    std::uint32_t around;     ///< Next half-edge of the same edge, see around_half_edge().
    std::uint32_t fan_angles; ///< Angles of the corner at the origin, in units of 2^-13 radian: its
                              ///< start within the vertex's fan in the low 16 bits, its size in the
                              ///< next 15 bits. The highest bit is set if the fan turns the other
                              ///< way through the corner: from the previous half-edge to this one.

    /// Returns the face's angle at the origin; {1, 0} if the third corner is the origin.
    GEODISK_API Direction angle() const noexcept;
};

/// Returns the next half-edge of the same undirected edge, from `HalfEdge::around`. On a border it
/// is the half-edge itself, on a manifold edge its twin, and otherwise a cycle of three or more.
constexpr std::uint32_t around_half_edge(std::uint32_t around) {
    return around >> 1;
}
/// Returns true if that half-edge runs in the same direction.
constexpr bool around_same_way(std::uint32_t around) {
    return (around & 1u) != 0;
}

/// Returns the half-edge after `h` in its face.
constexpr std::uint32_t next_in_face(std::uint32_t h) {
    return h % 3 == 2 ? h - 2 : h + 1;
}
/// Returns the half-edge before `h` in its face.
constexpr std::uint32_t previous_in_face(std::uint32_t h) {
    return h % 3 == 0 ? h + 2 : h - 1;
}

/// Corners around one vertex, in rotational order if there is one.
struct VertexFan {
    std::uint32_t first_corner; ///< Index into `PreparedMesh::corners`.
    std::uint32_t corner_count;
    std::uint32_t total_angle; ///< Sum of the corners' angles, in units of 2^-13 radian.
    std::uint32_t flags;       ///< `gpu::kFan*` bits of shaders/shared/constants.h.
};

/// Statistics of a mesh. Lengths are in mesh units.
struct MeshStatistics {
    std::uint64_t vertices = 0; ///< Vertices used by a face.
    std::uint64_t triangles = 0;
    std::uint64_t components = 0;     ///< Parts with no path between them.
    std::uint64_t boundary_edges = 0; ///< Edges of one face.
    /// Boundary edges with both ends exactly at those of another one: seams that
    /// MeshView::keep_seams leaves open. 0 for a mesh without coordinates.
    std::uint64_t coinciding_border_edges = 0;
    std::uint64_t nonmanifold_edges = 0;    ///< Edges of three or more faces.
    std::uint64_t repeated_index_faces = 0; ///< Faces that name a vertex twice. Ignored.
    std::uint64_t zero_area_faces = 0; ///< Faces without area. They connect but hold no sample.
    double area = 0;
    double diagonal = 0; ///< Diagonal of the bounding box of the used vertices; 0 for a
                         ///< mesh without coordinates.
    double longest_edge = 0;
};

/// A surface in intrinsic form, independent of the sampling distance.
///
/// Immutable after `prepare` and `load`: any number of threads may use one. All arrays are indexed
/// as in the caller's mesh: face f owns half-edges 3f, 3f+1, 3f+2.
class PreparedMesh {
  public:
    /// Connects faces that share vertices and builds their frames. Joins seams as join_seams()
    /// does, unless the view keeps them; faces and vertices keep their numbers. Takes linear time
    /// and memory (about 300 bytes per face). Large meshes use the threads that `threads` allows;
    /// they end before it returns. The result does not depend on them.
    ///
    /// Errors: `mesh_rejected`, with the face or vertex in `Error::element`, for an index out of
    /// range, a used coordinate that is not finite, no face with area, or a mesh too large for
    /// 32-bit indices; `invalid_argument` for sizes and layouts that MeshView does not allow and
    /// for no threads; `out_of_host_memory`.
    GEODISK_API static Result<PreparedMesh> prepare(const MeshView& mesh,
                                                    const ThreadOptions& threads = {}) noexcept;

    /// Prepares a mesh given by edge lengths. Errors: as above; `mesh_rejected`, with the face in
    /// `Error::element`, for a length that is not positive and finite, a face that violates the
    /// triangle inequality, or faces that disagree about the length of an edge. Faces that name a
    /// vertex twice may have any lengths.
    GEODISK_API static Result<PreparedMesh> prepare(const LengthMeshView& mesh,
                                                    const ThreadOptions& threads = {}) noexcept;

    /// Returns the mesh as bytes for load(), 130 to 170 per face, without joined_vertices(). Equal
    /// meshes give equal bytes.
    /// Errors: `out_of_host_memory`.
    GEODISK_API Result<std::vector<std::byte>> save() const noexcept;

    /// Returns the mesh that save() wrote, equal to the bit. The bytes may come from any source and
    /// need no alignment. They are checked completely, which takes about as long as preparing.
    ///
    /// Errors: `invalid_argument` for bytes that are not a saved mesh, are damaged, or have another
    /// version or byte order, with the faulty face or vertex in `Error::element` if there is one;
    /// `out_of_host_memory`.
    GEODISK_API static Result<PreparedMesh> load(std::span<const std::byte> bytes,
                                                 const ThreadOptions& threads = {}) noexcept;

    /// Returns the part that some faces make: its face i is `faces[i]`. Its vertices are those of
    /// the faces, in the order that they have here. Half-edges, and the fans of vertices all of
    /// whose faces belong to the part, are equal to the bit. An edge or vertex at the cut is as if
    /// the other faces did not exist. Takes time by the size of the part.
    ///
    /// Errors: `invalid_argument` unless `faces` ascend and are below face_count();
    /// `mesh_rejected` if no face of them has area; `out_of_host_memory`.
    GEODISK_API Result<PreparedMesh> part(std::span<const std::uint32_t> faces) const noexcept;

    /// Returns the half-edges, three per face.
    std::span<const HalfEdge> half_edges() const noexcept { return half_edges_; }
    /// Returns the fans, one per vertex.
    std::span<const VertexFan> fans() const noexcept { return fans_; }
    /// Returns the corners of all fans, as numbers of half-edges that start at the vertex.
    std::span<const std::uint32_t> corners() const noexcept { return corners_; }
    std::uint32_t face_count() const noexcept {
        return static_cast<std::uint32_t>(half_edges_.size() / 3);
    }
    std::uint32_t vertex_count() const noexcept { return static_cast<std::uint32_t>(fans_.size()); }
    const MeshStatistics& statistics() const noexcept { return statistics_; }
    /// Returns the lowest vertex that prepare() joined each vertex with. Empty if it joined none.
    std::span<const std::uint32_t> joined_vertices() const noexcept { return joined_vertices_; }
    /// Returns the number of border edges that prepare() joined to others.
    std::uint64_t joined_edges() const noexcept { return joined_edges_; }
    /// Returns a number that only copies of this mesh share in this process.
    std::uint64_t identity() const noexcept { return identity_; }

  private:
    friend struct MeshPieces; // Makes meshes of surfaces of which no process holds the whole.

    static std::uint64_t next_identity() noexcept;
    template <class View>
    static Result<PreparedMesh> prepare_any(const View& mesh, const ThreadOptions& threads);

    UninitializedVector<HalfEdge> half_edges_;
    std::vector<VertexFan> fans_;
    std::vector<std::uint32_t> corners_;
    MeshStatistics statistics_;
    std::vector<std::uint32_t> joined_vertices_;
    std::uint64_t joined_edges_ = 0;
    std::uint64_t identity_ = next_identity();
};

} // namespace geodisk
