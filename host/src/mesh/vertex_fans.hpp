// The corners around each vertex in rotational order, with their angles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geodisk/mesh.hpp"
#include "mesh/connectivity.hpp"

namespace geodisk {

/// What a fan needs to know of a corner's shape, given the half-edges from the corner and to it:
/// its angle, and whether one side has next to no length beside the other.
std::uint32_t pack_corner_angle(const HalfEdge& from, const HalfEdge& to);

/// Whether this may be HalfEdge::fan_angles of such a corner in a fan of rotational order, up to
/// the last bit of the angle.
bool angles_fit(std::uint32_t fan_angles, std::uint32_t packed);

/// Orders and measures fans one by one.
class FanBuilder {
  public:
    explicit FanBuilder(std::span<Link> links) : links_(links) {}

    /// Puts the corners of vertex v (some) into rotational order, turns their angles into
    /// `HalfEdge::fan_angles` and fills the rest of the fan. All edges at v must be linked.
    void build(std::uint32_t v, std::span<std::uint32_t> corners, VertexFan& fan);

    /// Whether the corners of v, whose angles fit, are in order, and these angles and the fan as
    /// build() makes them. All edges at v must be linked.
    bool fits(std::uint32_t v, const VertexFan& fan, std::span<const std::uint32_t> corners);

  private:
    /// False where no single walk around v covers the corners; these stay as they are then.
    bool order_corners(std::uint32_t v, std::span<std::uint32_t> corners, bool& open);
    void measure(std::span<const std::uint32_t> corners, bool ordered, bool open, VertexFan& fan);

    std::span<Link> links_;
    std::vector<std::uint32_t> copy_; ///< Of fits(), kept for its memory.
    std::vector<std::uint32_t> walk_; ///< Of order_corners(), kept for its memory.
};

} // namespace geodisk
