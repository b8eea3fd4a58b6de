#include "mesh/vertex_fans.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "constants.h"
#include "mesh/connectivity.hpp"

namespace geodisk {
namespace {

/// Corners are summed in units of 2^-20 radian, so that the last bit of the platform's atan2 never
/// shows, and stored in units of 2^-13.
constexpr std::uint64_t kFinePerUnit = 1u << 7;

std::uint32_t corner_angle(const HalfEdge& edge) {
    return static_cast<std::uint32_t>(std::lround(std::atan2(edge.sine, edge.cosine) * 0x1p20));
}

/// One step of a walk around a vertex: the corner, and whether it was entered by its own half-edge
/// (and is left by the previous one of its face) or the other way round.
struct Step {
    std::uint32_t corner;
    bool entered_by_own;
};

std::uint32_t exit_edge(Step step) {
    return step.entered_by_own ? previous_in_face(step.corner) : step.corner;
}

std::uint32_t entry_edge(Step step) {
    return step.entered_by_own ? step.corner : previous_in_face(step.corner);
}

bool is_border(std::span<const HalfEdge> half_edges, std::uint32_t h) {
    return around_half_edge(half_edges[h].around) == h;
}

/// Crosses the exit edge into the next corner at vertex v; nothing at a border or where three or
/// more faces meet.
std::optional<Step> next_step(std::span<const HalfEdge> half_edges, std::uint32_t v, Step step) {
    const std::uint32_t h = exit_edge(step);
    const std::uint32_t g = around_half_edge(half_edges[h].around);
    if (g == h || around_half_edge(half_edges[g].around) != h) {
        return std::nullopt;
    }
    if (half_edges[g].origin == v) {
        return Step{g, true};
    }
    return Step{next_in_face(g), false};
}

/// Orders the corners at `v` by walking around it; false where no single walk covers them.
bool order_corners(std::span<const HalfEdge> half_edges, std::uint32_t v,
                   std::span<std::uint32_t> corners, bool& open) {
    Step start{corners[0], true};
    open = false;
    for (const std::uint32_t corner : corners) {
        for (const bool own : {true, false}) {
            if (!open && is_border(half_edges, entry_edge({corner, own}))) {
                start = {corner, own};
                open = true;
            }
        }
    }
    std::vector<std::uint32_t> walk{start.corner};
    bool complete = false;
    for (Step step = start; walk.size() <= corners.size();) {
        const std::optional<Step> next = next_step(half_edges, v, step);
        if (!next) {
            complete = open && is_border(half_edges, exit_edge(step));
            break;
        }
        if (next->corner == start.corner) {
            complete = !open;
            break;
        }
        step = *next;
        walk.push_back(step.corner);
    }
    if (!complete || walk.size() != corners.size()) {
        return false;
    }
    std::copy(walk.begin(), walk.end(), corners.begin());
    return true;
}

/// Whether the corner has a side of next to no length beside the other. Such a side joins two
/// vertices into one place, whose angle is that of both together: neither fan alone tells whether
/// a path may bend there, nor in which direction the other lies.
bool at_short_side(std::span<const HalfEdge> half_edges, std::uint32_t corner) {
    constexpr double kShort = 0x1p-20;
    const double out = half_edges[corner].length;
    const double in = half_edges[previous_in_face(corner)].length;
    return std::fmin(out, in) <= kShort * std::fmax(out, in);
}

void measure_fan(std::span<HalfEdge> half_edges, std::span<const std::uint32_t> corners,
                 bool ordered, bool open, VertexFan& fan) {
    std::uint64_t fine = 0;
    for (const std::uint32_t corner : corners) {
        const std::uint64_t start = fine / kFinePerUnit;
        fine += corner_angle(half_edges[corner]);
        const std::uint64_t end = (fine + kFinePerUnit - 1) / kFinePerUnit;
        if (end > gpu::kLargestFanAngle) {
            ordered = false;
            break;
        }
        half_edges[corner].fan_angles = static_cast<std::uint32_t>(start | (end - start) << 16);
        ordered = ordered && !at_short_side(half_edges, corner);
    }
    if (!ordered) {
        fan.flags = gpu::kFanIrregular | gpu::kFanBends;
        return;
    }
    fan.total_angle = static_cast<std::uint32_t>((fine + kFinePerUnit - 1) / kFinePerUnit);
    // A shortest path makes at least pi on either side of a vertex it passes.
    const std::uint32_t needed = open ? gpu::kAnglePi : 2 * gpu::kAnglePi;
    fan.flags = (open ? gpu::kFanOpen : 0u) |
                (fan.total_angle + gpu::kAngleTolerance >= needed ? gpu::kFanBends : 0u);
}

} // namespace

void build_fans(std::span<HalfEdge> half_edges, std::span<VertexFan> fans,
                std::vector<std::uint32_t>& corners, MeshStatistics& statistics) {
    const auto count = static_cast<std::uint32_t>(half_edges.size());
    for (std::uint32_t h = 0; h < count; ++h) {
        if (takes_part(half_edges, h)) {
            ++fans[half_edges[h].origin].corner_count;
        }
    }
    std::uint32_t total = 0;
    for (VertexFan& fan : fans) {
        fan.first_corner = total;
        total += fan.corner_count;
    }
    corners.resize(total);
    std::vector<std::uint32_t> filled(fans.size(), 0);
    for (std::uint32_t h = 0; h < count; ++h) {
        if (takes_part(half_edges, h)) {
            const std::uint32_t v = half_edges[h].origin;
            corners[fans[v].first_corner + filled[v]++] = h;
        }
    }
    for (std::uint32_t v = 0; v < fans.size(); ++v) {
        VertexFan& fan = fans[v];
        if (fan.corner_count > 0) {
            ++statistics.vertices;
            const std::span own(corners.data() + fan.first_corner, fan.corner_count);
            bool open = false;
            const bool ordered = order_corners(half_edges, v, own, open);
            measure_fan(half_edges, own, ordered, open, fan);
        }
    }
}

} // namespace geodisk
