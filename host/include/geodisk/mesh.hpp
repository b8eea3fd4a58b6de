// Triangle meshes as prepared: the intrinsic surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geodisk/export.hpp"
#include "geodisk/mesh_view.hpp"
#include "geodisk/status.hpp"
#include "geodisk/threads.hpp"
#include "geodisk/uninitialized.hpp"

namespace geodisk {

/// Cosine and sine of an angle.
struct Direction {
    double cosine, sine;
};

/// One half-edge, `h = 3 * face + corner`, running from that corner to the next one of its face.
///
/// Its frame has the origin at the start, x along the edge and the face in y >= 0. Lengths are in
/// mesh units. Only lengths enter, so the frame is intrinsic.
struct HalfEdge {
    double length;
    double apex_x, apex_y;    ///< The face's third corner in this frame; apex_y >= 0.
    std::uint32_t origin;     ///< Vertex the half-edge starts from.
    std::uint32_t around;     ///< Next half-edge of the same undirected edge, see `around_*`.
    std::uint32_t fan_angles; ///< The corner at the origin within its vertex's fan: start in the
                              ///< low 16 bits, size in the high ones, units of 2^-13 radian.

    /// Of the face's angle at the origin; {1, 0} where the third corner is the origin.
    GEODISK_API Direction angle() const noexcept;
};

/// `HalfEdge::around` packs the next half-edge around the same undirected edge (itself on a border,
/// the twin on a manifold edge, a cycle of three or more otherwise) with one bit that tells whether
/// it runs the same way.
constexpr std::uint32_t around_half_edge(std::uint32_t around) {
    return around >> 1;
}
/// Whether that half-edge runs the same way.
constexpr bool around_same_way(std::uint32_t around) {
    return (around & 1u) != 0;
}

/// Half-edges of a face, three in a row: the one behind `h`, and the one before.
constexpr std::uint32_t next_in_face(std::uint32_t h) {
    return h % 3 == 2 ? h - 2 : h + 1;
}
/// See next_in_face().
constexpr std::uint32_t previous_in_face(std::uint32_t h) {
    return h % 3 == 0 ? h + 2 : h - 1;
}

/// The corners around one vertex, in rotational order where there is one.
struct VertexFan {
    std::uint32_t first_corner; ///< Into `PreparedMesh::corners`.
    std::uint32_t corner_count;
    std::uint32_t total_angle; ///< In units of 2^-13 radian.
    std::uint32_t flags;       ///< `gpu::kFan*` bits of shaders/shared/constants.h.
};

/// What became known of a mesh as it was prepared. Lengths are in mesh units.
struct MeshStatistics {
    std::uint64_t vertices = 0; ///< Vertices used by a face.
    std::uint64_t triangles = 0;
    std::uint64_t components = 0;     ///< Parts with no path between them.
    std::uint64_t boundary_edges = 0; ///< Edges of one face.
    /// Boundary edges with both ends exactly where those of another one are: seams that are open
    /// because their vertices are doubled; see `join_seams`. 0 for a mesh without coordinates.
    std::uint64_t coinciding_border_edges = 0;
    std::uint64_t nonmanifold_edges = 0;    ///< Edges of three or more faces.
    std::uint64_t repeated_index_faces = 0; ///< Faces naming a vertex twice; they take no part.
    std::uint64_t zero_area_faces = 0; ///< Faces without area; they connect but hold no sample.
    double area = 0;
    double diagonal = 0; ///< Of the bounding box of the used vertices; 0 for a
                         ///< mesh without coordinates.
    double longest_edge = 0;
};

/// The surface in intrinsic form, independent of the sampling distance.
///
/// Immutable after `prepare` and `load`, so one object may serve many threads. All arrays are
/// indexed as in the caller's mesh: face f owns half-edges 3f, 3f+1, 3f+2.
class PreparedMesh {
  public:
    /// Connects faces that share vertices (for seams, see `join_seams`) and builds their frames.
    /// Takes linear time and memory (about 300 bytes per face). Large meshes take further threads
    /// as `threads` allows, which end before it returns; the result does not depend on them.
    ///
    /// Fails with `mesh_rejected` and the face or vertex in `Error::element` when an index is out
    /// of range, a used coordinate is not finite, there is no face with area, or the mesh is too
    /// large to index with 32 bits; with `invalid_argument` for sizes and layouts that MeshView
    /// rules out and for no threads; with `out_of_host_memory` when memory runs out.
    GEODISK_API static Result<PreparedMesh> prepare(const MeshView& mesh,
                                                    const ThreadOptions& threads = {}) noexcept;

    /// The same from edge lengths. Fails with `mesh_rejected` and the face in `Error::element` when
    /// a length is not positive and finite, a face violates the triangle inequality, or the faces
    /// of an edge disagree about its length. Faces that name a vertex twice may have any lengths.
    GEODISK_API static Result<PreparedMesh> prepare(const LengthMeshView& mesh,
                                                    const ThreadOptions& threads = {}) noexcept;

    /// The mesh as bytes for load(), 130 to 170 per face, the same for the same mesh.
    /// Fails with `out_of_host_memory`.
    GEODISK_API Result<std::vector<std::byte>> save() const noexcept;

    /// The mesh that save() was called on, to the bit. The bytes may come from anywhere and need no
    /// alignment: whatever could lead a run astray is refused, which takes about as long as
    /// preparing.
    ///
    /// Fails with `invalid_argument` for bytes of something else, of another version of the format
    /// or another byte order, and damaged ones, with the face or vertex in `Error::element` where
    /// there is one at fault; with `out_of_host_memory`.
    GEODISK_API static Result<PreparedMesh> load(std::span<const std::byte> bytes,
                                                 const ThreadOptions& threads = {}) noexcept;

    std::span<const HalfEdge> half_edges() const noexcept { return half_edges_; }
    std::span<const VertexFan> fans() const noexcept { return fans_; }
    std::span<const std::uint32_t> corners() const noexcept { return corners_; }
    std::uint32_t face_count() const noexcept {
        return static_cast<std::uint32_t>(half_edges_.size() / 3);
    }
    std::uint32_t vertex_count() const noexcept { return static_cast<std::uint32_t>(fans_.size()); }
    const MeshStatistics& statistics() const noexcept { return statistics_; }
    /// A number that no other mesh prepared by this process has, but for copies of this one.
    std::uint64_t identity() const noexcept { return identity_; }

  private:
    static std::uint64_t next_identity() noexcept;
    template <class View>
    static Result<PreparedMesh> prepare_any(const View& mesh, const ThreadOptions& threads);

    UninitializedVector<HalfEdge> half_edges_;
    std::vector<VertexFan> fans_;
    std::vector<std::uint32_t> corners_;
    MeshStatistics statistics_;
    std::uint64_t identity_ = next_identity();
};

} // namespace geodisk
