// Corners around each vertex in rotational order, with their angles.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geodisk/mesh.hpp"
#include "mesh/connectivity.hpp"

namespace geodisk {

/// Packs what a fan needs to know of a corner, given the half-edges from and to the corner: its
/// angle, and a bit that is set if the corner may be at one place with another vertex.
std::uint32_t pack_corner_angle(const HalfEdge& from, const HalfEdge& to);

/// Returns true if this may be HalfEdge::fan_angles of such a corner in a fan in rotational order,
/// up to the last bit of the angle.
bool angles_fit(std::uint32_t fan_angles, std::uint32_t packed);

/// Orders and measures fans one by one.
class FanBuilder {
  public:
    explicit FanBuilder(std::span<Link> links) : links_(links) {}

    /// Puts the corners of vertex v (some) into rotational order, turns their angles into
    /// `HalfEdge::fan_angles` and fills the rest of the fan. All edges at v must be linked.
    void build(std::uint32_t v, std::span<std::uint32_t> corners, VertexFan& fan);

    /// Returns true if the corners of v, whose angles fit, are in order, and the angles and the fan
    /// are as build() makes them. All edges at v must be linked.
    bool fits(std::uint32_t v, const VertexFan& fan, std::span<const std::uint32_t> corners);

  private:
    /// One step of a walk around a vertex: the corner, and true if it was entered through its own
    /// half-edge and is left through the previous one of its face, false for the reverse.
    struct Step {
        std::uint32_t corner;
        bool entered_by_own;
    };

    static std::uint32_t exit_edge(Step step);
    static std::uint32_t entry_edge(Step step);
    /// Crosses the exit edge into the next corner at vertex v. Returns nothing at a border, or
    /// where three or more faces meet.
    std::optional<Step> next_step(std::uint32_t v, Step step) const;
    /// Orders the corners along a walk around v, which walk_ then holds. Returns false, and leaves
    /// the corners as they are, if no single walk covers them.
    bool order_corners(std::uint32_t v, std::span<std::uint32_t> corners, bool& open);
    void measure(std::span<const std::uint32_t> corners, bool ordered, bool open, VertexFan& fan);

    std::span<Link> links_;
    std::vector<std::uint32_t> copy_; ///< Scratch memory of fits().
    std::vector<Step> walk_;          ///< The last walk.
};

} // namespace geodisk
