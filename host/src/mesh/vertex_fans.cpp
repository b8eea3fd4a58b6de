#include "mesh/vertex_fans.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "constants.h"

namespace geodisk {
namespace {

/// Corners are summed in units of 2^-20 radian, so that the last bit of the platform's atan2 never
/// shows, and stored in units of 2^-13.
constexpr std::uint32_t kFinePerUnit = 1u << 7;

/// Bit of a packed angle that marks a corner which is_close() to another vertex or may be; angles
/// take 22 bits.
constexpr std::uint32_t kClose = 1u << 31;

constexpr std::uint32_t kIrregularFlags = gpu::kFanIrregular | gpu::kFanBends;

/// Returns the flags of a fan in rotational order.
std::uint32_t regular_flags(bool open, std::uint32_t total_angle) {
    // A shortest path has an angle of at least pi on either side of a vertex.
    const std::uint32_t needed = open ? gpu::kAnglePi : 2 * gpu::kAnglePi;
    return (open ? gpu::kFanOpen : 0u) |
           (total_angle + gpu::kAngleTolerance >= needed ? gpu::kFanBends : 0u);
}

/// Returns true if the corner is at one place with another vertex, or may be: if one side is almost
/// zero compared with the other, or if the corner lies almost on the opposite side, where another
/// one may lie beyond it. Such vertices are one place with the sum of their angles. Neither fan
/// alone shows whether a path may bend there, nor in which direction the other vertex lies.
bool is_close(const HalfEdge& from, const HalfEdge& to) {
    constexpr double kAlmostZero = 0x1p-16;
    const double opposite = from.length - from.apex_x;
    return std::min(from.length, to.length) <= kAlmostZero * std::max(from.length, to.length) ||
           (from.apex_x < 0 && from.length * from.apex_y <= kAlmostZero * opposite * opposite);
}

bool is_border(std::span<const Link> links, std::uint32_t h) {
    return around_half_edge(links[h].around) == h;
}

} // namespace

std::uint32_t pack_corner_angle(const HalfEdge& from, const HalfEdge& to) {
    const Direction direction = from.angle();
    const long angle = std::lround(std::atan2(direction.sine, direction.cosine) * 0x1p20);
    return static_cast<std::uint32_t>(angle) | (is_close(from, to) ? kClose : 0u);
}

std::uint32_t FanBuilder::exit_edge(Step step) {
    return step.entered_by_own ? previous_in_face(step.corner) : step.corner;
}

std::uint32_t FanBuilder::entry_edge(Step step) {
    return step.entered_by_own ? step.corner : previous_in_face(step.corner);
}

std::optional<FanBuilder::Step> FanBuilder::next_step(std::uint32_t v, Step step) const {
    const std::uint32_t h = exit_edge(step);
    const std::uint32_t g = around_half_edge(links_[h].around);
    if (g == h || around_half_edge(links_[g].around) != h) {
        return std::nullopt;
    }
    if (links_[g].origin == v) {
        return Step{g, true};
    }
    return Step{next_in_face(g), false};
}

void FanBuilder::build(std::uint32_t v, std::span<std::uint32_t> corners, VertexFan& fan) {
    bool open = false;
    const bool ordered = order_corners(v, corners, open);
    measure(corners, ordered, open, fan);
}

bool FanBuilder::order_corners(std::uint32_t v, std::span<std::uint32_t> corners, bool& open) {
    Step start{corners[0], true};
    open = false;
    for (const std::uint32_t corner : corners) {
        for (const bool own : {true, false}) {
            if (!open && is_border(links_, entry_edge({corner, own}))) {
                start = {corner, own};
                open = true;
            }
        }
    }
    walk_.assign(1, start);
    bool complete = false;
    for (Step step = start; walk_.size() <= corners.size();) {
        const std::optional<Step> next = next_step(v, step);
        if (!next) {
            complete = open && is_border(links_, exit_edge(step));
            break;
        }
        if (next->corner == start.corner) {
            complete = !open;
            break;
        }
        step = *next;
        walk_.push_back(step);
    }
    if (!complete || walk_.size() != corners.size()) {
        return false;
    }
    std::ranges::transform(walk_, corners.begin(), &Step::corner);
    return true;
}

void FanBuilder::measure(std::span<const std::uint32_t> corners, bool ordered, bool open,
                         VertexFan& fan) {
    std::uint64_t fine = 0;
    bool too_wide = false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::uint32_t corner = corners[i];
        const std::uint32_t packed = std::exchange(links_[corner].angle, 0);
        const std::uint64_t start = fine / kFinePerUnit;
        fine += packed & ~kClose;
        const std::uint64_t end = (fine + kFinePerUnit - 1) / kFinePerUnit;
        too_wide = too_wide || end > gpu::kLargestFanAngle;
        if (!too_wide) {
            const bool is_turned = ordered && !walk_[i].entered_by_own;
            links_[corner].angle = static_cast<std::uint32_t>(start | (end - start) << 16) |
                                   (is_turned ? gpu::kCornerTurned : 0u);
        }
        ordered = ordered && !too_wide && (packed & kClose) == 0;
    }
    if (!ordered) {
        fan.flags = kIrregularFlags;
        return;
    }
    fan.total_angle = static_cast<std::uint32_t>((fine + kFinePerUnit - 1) / kFinePerUnit);
    fan.flags = regular_flags(open, fan.total_angle);
}

/// Returns the angle of a corner in units of a fan.
std::uint32_t corner_size(std::uint32_t fan_angles) {
    return (fan_angles & ~gpu::kCornerTurned) >> 16;
}

bool angles_fit(std::uint32_t fan_angles, std::uint32_t packed) {
    const std::uint32_t fine = packed & ~kClose;
    const std::uint32_t size = corner_size(fan_angles) * kFinePerUnit;
    // Starts are rounded down, ends up.
    return (packed & kClose) == 0 && size + 1 >= fine && size <= fine + 2 * kFinePerUnit;
}

bool FanBuilder::fits(std::uint32_t v, const VertexFan& fan,
                      std::span<const std::uint32_t> corners) {
    if (corners.empty()) {
        return fan.flags == 0 && fan.total_angle == 0;
    }
    if (fan.flags == kIrregularFlags) {
        return fan.total_angle == 0;
    }
    bool open = false;
    copy_.assign(corners.begin(), corners.end());
    if (!order_corners(v, copy_, open) || !std::ranges::equal(copy_, corners) ||
        fan.flags != regular_flags(open, fan.total_angle)) {
        return false;
    }
    std::uint32_t end = 0;
    for (const Step& step : walk_) {
        const std::uint32_t angle = links_[step.corner].angle;
        const std::uint32_t start = angle & 0xffffu;
        const bool is_turned = (angle & gpu::kCornerTurned) != 0;
        if ((start != end && start + 1 != end) || // Starts are rounded down, ends up.
            is_turned == step.entered_by_own) {
            return false;
        }
        end = start + corner_size(angle);
    }
    return end == fan.total_angle && end <= gpu::kLargestFanAngle;
}

} // namespace geodisk
