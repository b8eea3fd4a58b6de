// Twin of shaders/lib/windows.glsl: windows of straight paths, and the points that they light.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "constants.h"
#include "geodisk/params.hpp"
#include "kernels/bins.hpp"
#include "kernels/shadow.hpp"
#include "kernels/waiting.hpp"
#include "lib/frame.hpp"
#include "lib/scalar.hpp"
#include "lib/surface.hpp"

namespace geodisk::ref {

/// Work of one disk; the shaders count the same.
struct DiskCount {
    std::uint32_t windows = 0;     ///< Windows and vertex events pushed.
    std::uint32_t max_waiting = 0; ///< Maximum of windows on the stack, or events waiting.
    std::uint32_t chain = 0;       ///< Longest chain of crossings.
    std::uint32_t vertices = 0;    ///< Vertices reached.
    std::uint32_t tested = 0;      ///< Points whose distance was computed.
};

/// A disk with too many windows: edges of many faces, or very many triangles.
struct EndlessDisk : std::runtime_error {
    explicit EndlessDisk(std::uint32_t face)
        : std::runtime_error("the geodesic disk of a point on face " + std::to_string(face) +
                             " could not be computed: it holds too many edges of more than two "
                             "faces, or too many triangles far smaller than the distance") {}
};

/// Returns the tolerances of distances in double precision, which only cover its rounding.
inline Tolerances double_tolerances() {
    Tolerances tolerances{};
    tolerances.limit = 1;
    tolerances.margin = 0x1p-40f;
    // Wider than rounding, for needles: a ray this far aside of its window is longer by the square
    // of it only.
    tolerances.slack = 0x1p-24f;
    // Directions of very short paths have it too.
    tolerances.base_error = 0x1p-40f;
    return tolerances;
}

/// Base of all ways to compute a geodesic disk: how windows cross faces, and which points they
/// light. With kMayVary false it is faster, and only for surfaces whose radii do not vary and
/// without classes.
template <class Real, bool kMayVary>
class Windows {
  public:
    /// Makes it for disks of this limit. Surface and bins must outlive it. If radii vary, two
    /// points are near if their distance is below the sum of their radii and `limit` - 1, else if
    /// it is below `limit`.
    Windows(const Surface<Real>& surface, const Bins<Real>& bins, const Tolerances& tolerances,
            Real limit)
        : surface_(surface), bins_(bins), limit_(limit), guard_(tolerances.limit - Real{1}),
          min_margin_(tolerances.margin), slack_(tolerances.slack),
          base_error_(tolerances.base_error), crossing_error_(tolerances.crossing_error),
          trim_scale_(std::max(Real{1}, static_cast<Real>(0x1p19) * base_error_)) {}

    /// Sets the limit of later disks.
    void set_limit(Real limit) { limit_ = limit; }

    /// Returns, for what is lit, the distance below which a point without a radius is near.
    Real limit_for_points() const { return adaptive() ? limit_with(Real{0}) : path_limit(); }

    /// Sets the class of the sources of later disks. `words` are those of the points by place,
    /// whose lowest bits are their classes; they must outlive the disks.
    void set_class(std::uint32_t own, std::span<const std::uint32_t> words) {
        own_class_ = own;
        words_ = words;
        limit_ = surface_.classes.reach[own] + guard_;
    }

  protected:
    using Window = ref::Window<Real>;

    /// Tests the points of what is lit.
    template <class Wanted, class Hit>
    struct Scan {
        Windows& windows;
        Wanted& wanted;
        Hit& hit;

        void face(std::uint32_t h, Real x, Real y, Real sigma) const {
            windows.scan_face(h, x, y, sigma, wanted, hit);
        }
        void wedge(std::uint32_t h, Real x, Real y, Real b0, Real b1, Real sigma) const {
            windows.scan_wedge(h, x, y, b0, b1, sigma, wanted, hit);
        }
    };
    template <class Wanted, class Hit>
    Scan<Wanted, Hit> scan_by(Wanted& wanted, Hit& hit) {
        return {*this, wanted, hit};
    }

    static constexpr std::uint32_t kNoEdge = ~0u;
    static constexpr std::uint32_t kWholeFan = ~0u;

    /// Returns true if there are so many windows and events that windows must be trimmed: more than
    /// `least`, and than suits the vertices reached.
    bool makes_many(std::uint32_t least, std::uint32_t longest_chain, std::uint32_t pushed) const {
        const std::uint32_t vertices = std::min(count_.vertices, gpu::kUntrimmedVertices);
        const auto across = static_cast<std::uint32_t>(root(static_cast<float>(vertices)));
        const bool is_strip = longest_chain > count_.vertices / gpu::kStripChain;
        const std::uint32_t most = longest_chain > gpu::kLongStrip ? 0 : gpu::kStripRoot;
        const std::uint32_t each =
            gpu::kUntrimmedEach +
            gpu::kUntrimmedPerRoot * (is_strip ? std::min(across, most) : across);
        return pushed > least + vertices * each;
    }

    static Real square(Real v) { return v * v; }

    /// Returns true if radii vary.
    bool adaptive() const { return kMayVary && surface_.is_adaptive(); }
    /// Returns true if points have classes.
    bool classed() const { return kMayVary && !words_.empty(); }

    Real error_of(std::uint32_t crossings) const {
        const Real half = crossing_error_ / 2; // The other half is for trimming.
        return base_error_ + static_cast<Real>(crossings) *
                                 (trims_ ? half + trim_scale_ * half : crossing_error_);
    }

    /// Says whether the disk trims its windows.
    void set_trims(bool trims) { trims_ = trims; }
    /// Returns by how much more positions round than those on edges of up to two units.
    Real trim_scale() const { return trim_scale_; }

    /// Begins to spread a source, window or event over a face. Long chains widen limit and margin:
    /// a path by its own chain, since its distance has that error; the margin by the longest of the
    /// disk so far, since any path may be the known one.
    void begin_operation(std::uint32_t chain, std::uint32_t longest_chain) {
        margin_ = std::max(min_margin_, error_of(longest_chain));
        beyond_guard_ = std::max(error_of(chain) - guard_, Real{0});
    }

    Real path_limit() const { return limit_ + beyond_guard_; }

    /// Returns the distance below which a point with this radius is near the source.
    Real limit_with(Real radius) const {
        return (own_radius_ + radius) + ((limit_ - Real{1}) + beyond_guard_);
    }

    /// Returns the distance beyond which no path through the face leads to a point near the source.
    Real reach_through(std::uint32_t face) const {
        return adaptive() ? limit_with(surface_.radii[face].bound) : path_limit();
    }

    /// Returns the distance beyond which no point of the face is near the source.
    Real reach_into(std::uint32_t face) const {
        return adaptive() ? limit_with(surface_.radii[face].largest()) : path_limit();
    }

    /// A window to push; none if its distance is negative.
    struct Child {
        Real distance = -1;
        Window window{};
    };

    /// Returns true if a window that enters the face of h returns to a face where it has been;
    /// shortest paths do not, if faces are straight. A window with a long chain remembers one face,
    /// where its chain was last a power of two, and so finds every cycle (Brent 1980).
    bool turns_back(std::uint32_t h, const Window& window) const {
        return surface_.frame.straight_faces && h / 3 == window.remembered / 3;
    }

    /// Returns what a window with this chain remembers after it leaves the face of h, where it
    /// began or came in remembering `remembered`.
    static std::uint32_t remember(std::uint32_t h, std::uint32_t chain, std::uint32_t remembered) {
        if (chain < gpu::kFirstRemembered) {
            return kNoEdge;
        }
        return std::has_single_bit(chain) ? h : remembered;
    }

    /// Returns the window that leaves its face through `e`, lit on [b0, b1] from (x, y) in the
    /// frame of e; `start` and `end` are the known distances of the edge's ends.
    Child leave(std::uint32_t e, Real start, Real end, Real x, Real y, Real b0, Real b1, Real sigma,
                std::uint32_t chain, std::uint32_t remembered) {
        if (around_half_edge(surface_.edges[e].around) == e || !(b0 < b1)) {
            return {};
        }
        y = y < static_cast<Real>(kSmallestOffset) ? Real{0} : y;
        // A source at an end of the edge lights only the edge: that vertex lights its fan itself,
        // and rounding could carry the window around it forever.
        const Real grain = surface_.edges[e].length * (4 * std::numeric_limits<Real>::epsilon());
        if (y == 0 && (x <= grain || surface_.edges[e].length - x <= grain)) {
            return {};
        }
        const Real aside = x < b0 ? b0 - x : (x > b1 ? x - b1 : Real{0});
        const Real distance = sigma + root(aside * aside + y * y);
        // Xin and Wang's filter with the two ends of the edge.
        const Real length = surface_.edges[e].length;
        if (!(distance < reach_through(e / 3)) || beats(start, b1, sigma, square(x - b1) + y * y) ||
            beats(end, length - b0, sigma, square(x - b0) + y * y)) {
            return {};
        }
        // If many faces share the edge, the shader has no room for the known distances of its ends.
        const bool many = shared_by_many(e);
        return {distance,
                {e, x, y, b0, b1, sigma, chain, many ? static_cast<Real>(kFar) : rounded_up(start),
                 many ? static_cast<Real>(kFar) : rounded_up(end), remembered}};
    }

    bool shared_by_many(std::uint32_t e) const {
        if (surface_.frame.splits_once) {
            return false; // The mesh has no such edge.
        }
        const std::uint32_t next = around_half_edge(surface_.edges[e].around);
        return around_half_edge(surface_.edges[next].around) != e;
    }

    /// Rounds a known distance up to a multiple of 2^-15, as windows carry it. A bound that is too
    /// large only keeps a window that could be dropped.
    Real rounded_up(Real distance) const {
        if (!(distance < limit_)) {
            return static_cast<Real>(kFar);
        }
        const auto steps = static_cast<std::int64_t>(distance * static_cast<Real>(0x1p15)) + 1;
        return static_cast<Real>(steps) * static_cast<Real>(0x1p-15);
    }

    /// Returns true if `known` plus a straight path of length `way` beats the window's own distance
    /// to a point, at squared distance `square` from its source, by more than the margin.
    bool beats(Real known, Real way, Real sigma, Real own_square) const {
        const Real rest = ((known + way) - sigma) + margin_;
        return rest < 0 || rest * rest < own_square;
    }

    /// Returns from where paths enter the fan that came in through corner `from`.
    Entry entry_through(const VertexFan& fan, std::uint32_t from, std::uint32_t arrival) const {
        return from == kWholeFan ? kEntersFromAnywhere
                                 : entry_of(fan, surface_.edges[from].fan_angles, arrival);
    }

    /// Returns the window over the edge e of paths of length sigma, which light this shadow in the
    /// opposite corner; `start` and `end` are as for leave().
    Child leave_shadow(std::uint32_t e, Shadow shadow, Real start, Real end, Real sigma,
                       std::uint32_t chain) {
        const Edge<Real>& edge = surface_.edges[e];
        const auto crossing = [&](std::int32_t angle) {
            return ray_crossing(angle, edge.apex_x, edge.apex_y, edge.length);
        };
        const std::int32_t size = corner_size(surface_.edges[previous_in_face(e)].fan_angles);
        // Wider by the slack: where the corner is close to the edge, rounding on the edge turns
        // rays far.
        const Real b0 = shadow.low > 0 ? std::max(crossing(shadow.low) - slack_, Real{0}) : Real{0};
        const Real b1 = shadow.high < size ? std::min(crossing(shadow.high) + slack_, edge.length)
                                           : edge.length;
        return leave(e, start, end, edge.apex_x, edge.apex_y, b0, b1, sigma, chain,
                     remember(e, chain, e));
    }

    /// Returns how a window's straight path arrives at the apex of the face that it enters, through
    /// the corner of the left edge. The window's source is at (x, -y).
    std::uint32_t arrival_at_apex(const Edge<Real>& edge, const Window& window, Real way) const {
        const Real aside = window.y + edge.apex_y;
        const Real along = edge.apex_x * (edge.apex_x - window.x) + edge.apex_y * aside;
        const Real across = edge.apex_x * window.y + edge.apex_y * window.x;
        return arrival_from(along, across, blur_of(error_of(window.chain + 1), way));
    }

    static constexpr Real kFull = -1;

    /// Returns the child through the left or right edge e, lit between the rays through `near` and
    /// `far`. Positions are measured from the start of h for the left child, from its end for the
    /// right one. `apex` is the known distance of the corner that both children share.
    Child lit_child(std::uint32_t e, bool left, std::uint32_t h, Real x, Real y, Real near,
                    Real far, Real apex, const Window& window) {
        const Edge<Real>& child = surface_.edges[e];
        const Edge<Real>& edge = surface_.edges[h];
        const Edge<Real>& angle = left ? edge : child;
        const Real apex_x = left ? edge.apex_x : edge.length - edge.apex_x;
        const auto along = [&](Real b) {
            const Real part = ratio(y * b, y * apex_x + edge.apex_y * (x - b));
            return child.length * part;
        };
        const Real low = along(near);
        const Real high = far == kFull ? child.length : along(far);
        const Real child_x = x * angle.cosine - y * angle.sine;
        const Real child_y = x * angle.sine + y * angle.cosine;
        const Real px = left ? child.length - child_x : child_x;
        const Real b0 = left ? child.length - high : low;
        const Real b1 = left ? child.length - low : high;
        // Xin and Wang's filter with the third corner of the face, at the apex of the child,
        // against the end of the lit interval next to the edge the window came through.
        const Real b = left ? b1 : b0;
        const Real third = left ? window.end : window.start;
        const Real way = root(square(child.apex_x - b) + child.apex_y * child.apex_y);
        if (beats(third, way, window.sigma, square(px - b) + child_y * child_y)) {
            return {};
        }
        return leave(e, left ? apex : window.end, left ? window.start : apex, px, child_y, b0, b1,
                     window.sigma, window.chain + 1,
                     remember(h, window.chain + 1, window.remembered));
    }

    /// Tests points of h's face at straight distance from (x, y) in the frame of h.
    template <class Wanted, class Hit>
    void scan_face(std::uint32_t h, Real x, Real y, Real sigma, Wanted& wanted, Hit& hit) {
        scan(h, x, y, sigma, wanted, hit, [](Real, Real) { return true; });
    }

    /// Tests points of h's face that (x, -y) sees through [b0, b1] of h.
    template <class Wanted, class Hit>
    void scan_wedge(std::uint32_t h, Real x, Real y, Real b0, Real b1, Real sigma, Wanted& wanted,
                    Hit& hit) {
        const Real low = (b0 - slack_) - x;
        const Real high = (b1 + slack_) - x;
        scan(h, x, -y, sigma, wanted, hit, [=](Real dx, Real dy) {
            const Real at = dx * y;
            return at >= low * dy && at <= high * dy;
        });
    }

    template <class Wanted, class Hit, class Lit>
    void scan(std::uint32_t h, Real x, Real y, Real sigma, Wanted& wanted, Hit& hit, Lit lit) {
        const std::uint32_t f = h / 3;
        const Grid& grid = bins_.grids[f];
        const Real rest = reach_into(f) - sigma;
        if (adaptive() && !(rest > 0)) {
            return; // The disk does not reach the face.
        }
        const Real rest2 = rest * rest;
        const auto scan_places = [&](std::uint32_t from, std::uint32_t to) {
            for (std::uint32_t place = from; place < to; ++place) {
                if (!wanted(place)) {
                    continue;
                }
                ++count_.tested;
                const auto q = position_in(surface_, h, bins_.points[place]);
                const Real dx = q.x - x;
                const Real dy = q.y - y;
                const Real distance2 = dx * dx + dy * dy;
                const Real limit2 = adaptive() || classed() ? near_square(place, sigma) : rest2;
                if (distance2 < limit2 && lit(dx, dy)) {
                    hit(place, sigma + std::sqrt(distance2));
                }
            }
        };
        if (grid.single()) {
            scan_places(bins_.starts[grid.first_cell], bins_.starts[grid.first_cell + 1]);
            return;
        }
        const auto center = in_other_frame(surface_, h, grid.base, {x, y});
        const Real reach =
            rest + static_cast<Real>(kCellPadding) * (surface_.edges[grid.base].length + 1);
        const Real per_unit =
            kMayVary ? surface_.cells_per_unit(f) : static_cast<Real>(gpu::kCellsPerDistance);
        const std::uint32_t column0 = cell_at(center.x - reach, grid.columns, per_unit);
        const std::uint32_t column1 = cell_at(center.x + reach, grid.columns, per_unit);
        const std::uint32_t row1 = cell_at(center.y + reach, grid.rows, per_unit);
        for (std::uint32_t row = cell_at(center.y - reach, grid.rows, per_unit); row <= row1;
             ++row) {
            const std::uint32_t start = grid.first_cell + row * grid.columns;
            scan_places(bins_.starts[start + column0], bins_.starts[start + column1 + 1]);
        }
    }

    /// Returns the distance below which a place of this class is near: 0 if the two classes keep
    /// none.
    Real limit_for(std::uint32_t other_class) const {
        const Real distance = surface_.classes.distance[own_class_][other_class];
        return distance > 0 ? distance + (guard_ + beyond_guard_) : Real{0};
    }

    /// Returns, if radii vary or points have classes, the squared distance from a source at sigma
    /// below which a place is near.
    Real near_square(std::uint32_t place, Real sigma) const {
        const Real limit = adaptive() ? limit_with(surface_.radius_at(bins_.points[place]))
                                      : limit_for(words_[place] % 8);
        const Real rest = limit - sigma;
        return rest > 0 ? rest * rest : Real{0};
    }

    static std::uint32_t cell_at(Real x, std::uint32_t count, Real per_unit) {
        const Real scaled = x * per_unit;
        if (scaled <= 0) {
            return 0;
        }
        const Real last = static_cast<Real>(count - 1);
        return scaled >= last ? count - 1 : static_cast<std::uint32_t>(scaled);
    }

    /// Sources closer than this to a vertex light its whole fan: unfolding around so near a vertex
    /// would lose the direction.
    static constexpr double kNearVertex = 0x1p-10;
    /// Part of the slack by which the place where a ray crosses an edge may be off.
    static constexpr double kCrossingPart = 0x1p-4;
    /// Rounding of positions against cell borders, relative to the face's extent.
    static constexpr double kCellPadding = 0x1p-20;

    const Surface<Real>& surface_;
    const Bins<Real>& bins_;
    Real limit_;
    const Real guard_, min_margin_, slack_;
    const Real base_error_, crossing_error_, trim_scale_;
    bool trims_ = false;
    Real margin_ = 0;       ///< By how much a known path must beat a window in this operation.
    Real beyond_guard_ = 0; ///< By how much its error exceeds the guard.
    Real own_radius_ = 0;   ///< Radius of the source, if radii vary.
    std::uint32_t own_class_ = 0;
    std::span<const std::uint32_t> words_; ///< Random words of the points, if they have classes.
    DiskCount count_;
};

} // namespace geodisk::ref
