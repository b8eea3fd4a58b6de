// Connectivity: half-edges that share an undirected edge, corners of each vertex, and components.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geodisk/detail/vertex_sets.hpp"
#include "geodisk/mesh.hpp"

namespace geodisk {

/// Returns true if a face names three different vertices. Other faces are kept but ignored.
constexpr bool takes_part(const std::array<std::uint32_t, 3>& face) {
    return face[0] != face[1] && face[1] != face[2] && face[2] != face[0];
}

/// Connectivity of a half-edge while the mesh is being connected. Connecting accesses memory in the
/// order of vertices, which may be random, so this is separate from the large HalfEdge.
struct Link {
    std::uint32_t origin; ///< Same as in HalfEdge, like `around`.
    std::uint32_t around;
    std::uint32_t angle; ///< pack_corner_angle(), and HalfEdge::fan_angles once its fan is
                         ///< measured.
};

/// Returns `HalfEdge::around` for a half-edge that is alone on its edge.
constexpr std::uint32_t lone_half_edge(std::uint32_t h) {
    return h << 1 | 1u;
}

/// Lists the corners of each vertex, from all faces that take part. A corner is named by the
/// half-edge that starts at it. Fills `corners`, in ascending order per vertex, and `first_corner`
/// and `corner_count` of `fans`, one fan per vertex.
void list_corners(IndexView triangles, std::span<VertexFan> fans,
                  std::vector<std::uint32_t>& corners);

/// Joins the half-edges of one undirected edge into cycles (`Link::around`), vertex by vertex, and
/// counts border edges, non-manifold edges and components.
class EdgeLinker {
  public:
    /// All half-edges of `links` must be alone.
    EdgeLinker(std::span<Link> links, std::uint32_t vertex_count);

    /// Links the edges from vertex v to higher vertices, given all corners of v (at least one).
    /// Call it in ascending order for all vertices that have corners. Afterwards all edges at v are
    /// linked.
    void link_at(std::uint32_t v, std::span<const std::uint32_t> corners);

    /// Writes the counts of all calls.
    void count(MeshStatistics& statistics) const;

    /// Returns the half-edges that are alone on their edges.
    std::vector<std::uint32_t> take_borders() { return std::move(borders_); }

  private:
    void link_cycle(std::span<const std::uint64_t> cycle);

    std::span<Link> links_;
    VertexSets components_;
    std::vector<std::uint32_t> borders_;
    std::vector<std::uint64_t> entries_; ///< Scratch memory of link_at().
    std::uint64_t vertices_ = 0, joins_ = 0, nonmanifold_edges_ = 0;
};

} // namespace geodisk
