// Which half-edges share an undirected edge, which corners a vertex has, and which vertices a path
// can join.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geodisk/mesh.hpp"
#include "mesh/vertex_sets.hpp"

namespace geodisk {

/// Whether a face names three vertices. One that does not is kept, but takes no part.
constexpr bool takes_part(const std::array<std::uint32_t, 3>& face) {
    return face[0] != face[1] && face[1] != face[2] && face[2] != face[0];
}

/// A half-edge while the mesh is being connected. Connecting reads and writes in the order of the
/// vertices, which may be any, so this is kept apart from the large HalfEdge.
struct Link {
    std::uint32_t origin; ///< As in HalfEdge, like `around`.
    std::uint32_t around;
    std::uint32_t angle; ///< pack_corner_angle(); once its fan is measured, HalfEdge::fan_angles.
};

/// `HalfEdge::around` of a half-edge that shares its edge with no other.
constexpr std::uint32_t lone_half_edge(std::uint32_t h) {
    return h << 1 | 1u;
}

/// Lists the corners of the faces that take part by vertex, each
/// named by the half-edge that starts at it: fills `corners`, in ascending order for each vertex,
/// and `first_corner` and `corner_count` of `fans`, one fan per vertex.
void list_corners(IndexView triangles, std::span<VertexFan> fans,
                  std::vector<std::uint32_t>& corners);

/// Joins the half-edges of one undirected edge into cycles (`Link::around`), vertex by vertex, and
/// counts border edges, non-manifold edges and components.
class EdgeLinker {
  public:
    /// All half-edges must be alone.
    EdgeLinker(std::span<Link> links, std::uint32_t vertex_count);

    /// Links the edges from vertex v to those of higher index, given all its corners (some). To be
    /// called for all vertices that have corners in ascending order: then all edges at v are
    /// linked.
    void link_at(std::uint32_t v, std::span<const std::uint32_t> corners);

    /// Fills in what all calls have counted.
    void count(MeshStatistics& statistics) const;

    /// The half-edges that are the only ones of their edges.
    std::vector<std::uint32_t> take_borders() { return std::move(borders_); }

  private:
    void link_cycle(std::span<const std::uint64_t> cycle);

    std::span<Link> links_;
    VertexSets components_;
    std::vector<std::uint32_t> borders_;
    std::vector<std::uint64_t> entries_; ///< Of link_at(), kept for its memory.
    std::uint64_t vertices_ = 0, joins_ = 0, nonmanifold_edges_ = 0;
};

} // namespace geodisk
