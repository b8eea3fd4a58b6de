// Twin of shaders/lib/trim.glsl: trimming of windows against each other (Mitchell, Mount and
// Papadimitriou 1987), in disks with very many.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "constants.h"
#include "lib/scalar.hpp"

namespace geodisk::ref {

/// Keeps, of the windows of a disk that came to each edge, the widest and the last narrower one,
/// for up to kKeptEdges edges.
template <class Real>
class KeptWindows {
  public:
    /// A window in the frame of the edge, from one of its ends, with the source at y from its line.
    struct Window {
        Real x, y, b0, b1, sigma;
    };

    /// `scale` is that of the rounding of positions, by which one window may be farther than
    /// another that it trims: 1, or more where edges are long.
    explicit KeptWindows(Real scale) : error_(scale * kError) {}

    /// Forgets the windows of earlier disks.
    void begin_disk() { ++generation_; }

    /// Returns true if a window that comes to the edge from vertex `start` to vertex `end` is
    /// dropped: everywhere that it lights before its paths are `limit` long, another one is not
    /// farther by more than rounding, or a path from there along the edge is shorter by `margin`.
    /// Otherwise it may be kept from now on.
    bool trims(std::uint32_t start, std::uint32_t end, Real length, Window window, Real limit,
               Real margin) {
        if (start > end) {
            std::swap(start, end);
            window = {length - window.x, window.y, length - window.b1, length - window.b0,
                      window.sigma};
        }
        edges_.resize(gpu::kKeptEdges);
        const std::uint32_t mixed = start * 2654435769u + (end - start) * 625341585u;
        std::array<Row, gpu::kKeptPerEdge>& kept = edges_[mixed & (gpu::kKeptEdges - 1)];
        const auto is_of_edge = [&](const Row& row) {
            return row.start == start && row.end == end && row.generation == generation_;
        };
        for (const Row& row : kept) {
            if (is_of_edge(row) && dominates(row.window, window, limit, margin)) {
                return true;
            }
        }
        // Replace the narrowest, or one of another edge.
        const auto width = [&](const Row& row) {
            return is_of_edge(row) ? row.window.b1 - row.window.b0 : Real{-1};
        };
        Row& narrowest =
            *std::min_element(kept.begin(), kept.end() - 1,
                              [&](const Row& a, const Row& b) { return width(a) < width(b); });
        Row& own = window.b1 - window.b0 < width(narrowest) ? kept.back() : narrowest;
        own = {start, end, generation_, window};
        return false;
    }

  private:
    struct Row {
        std::uint32_t start, end;
        std::uint32_t generation = 0;
        Window window;
    };
    static Real square(Real v) { return v * v; }

    /// Returns true if the kept window is hardly farther from the point `at` of the edge. Where it
    /// does not light the point, a path goes on from its end along the edge. That path bends, so it
    /// must be shorter by the margin. A point beside the end by rounding counts as lit. If the
    /// other source is near the point, so little of the edge turns its rays far: less counts then.
    bool is_as_near(const Window& kept, const Window& other, Real at, Real margin) const {
        const Real way = root(square(at - other.x) + square(other.y));
        const Real beside = error_ * std::min(way * kNearSource, Real{1});
        const Real lit_at = std::clamp(at, kept.b0 - beside, kept.b1 + beside);
        const Real along_edge = std::abs(at - lit_at) + margin;
        const Real distance = other.sigma + way;
        const Real rest = (distance - kept.sigma) + (lit_at == at ? error_ : -along_edge);
        return rest >= 0 && square(lit_at - kept.x) + square(kept.y) <= rest * rest;
    }

    /// Returns true if this holds everywhere. The difference of the two is largest at an end, or
    /// where both sources are collinear with the point. Along the edge it grows away from what the
    /// kept one lights.
    bool dominates(const Window& kept, const Window& other, Real limit, Real margin) const {
        const Real way = limit - other.sigma;
        const Real low = std::max(other.b0, other.x - way);
        const Real high = std::min(other.b1, other.x + way);
        const Real turn = other.x * kept.y - kept.x * other.y;
        const Real rise = kept.y - other.y;
        const Real over = rise < 0 ? -turn : turn;
        const Real under = std::abs(rise);
        const Real first_both = std::max(low, kept.b0 - error_);
        const Real last_both = std::min(high, kept.b1 + error_);
        const Real width = last_both - first_both;
        const Real across = width * under;
        const Real part = across > static_cast<Real>(kSmallestSquare)
                              ? ratio(over - first_both * under, across)
                              : Real{0};
        const Real between = first_both < last_both ? first_both + width * part : low;
        return is_as_near(kept, other, low, margin) && is_as_near(kept, other, high, margin) &&
               is_as_near(kept, other, between, margin);
    }

    /// Long chains round to many times the error of one number; in float the guard allows no more.
    static constexpr Real kError = std::max(std::numeric_limits<Real>::epsilon(), Real{0x1p-44});

    /// Inverse of the distance below which a source is near.
    static constexpr Real kNearSource = 0x1p10;

    Real error_;
    std::vector<std::array<Row, gpu::kKeptPerEdge>> edges_; ///< Kept windows; empty until a disk
                                                            ///< trims.
    std::uint32_t generation_ = 0;
};

} // namespace geodisk::ref
