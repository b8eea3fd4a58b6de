// Twin of shaders/kernels/detect.comp: the geodesic disk of one point by windows (improved
// Chen-Han, Xin and Wang 2009), cut at the limit, and the points in it.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "constants.h"
#include "geodisk/params.hpp"
#include "kernels/bins.hpp"
#include "kernels/trim.hpp"
#include "kernels/waiting.hpp"
#include "lib/frame.hpp"
#include "lib/scalar.hpp"
#include "lib/surface.hpp"

namespace geodisk::ref {

/// Work of one disk; the shaders count the same.
struct DiskCount {
    std::uint32_t windows = 0;      ///< Windows and vertex events pushed.
    std::uint32_t most_waiting = 0; ///< Maximum of windows on the stack, or events waiting.
    std::uint32_t chain = 0;        ///< Longest chain of crossings.
    std::uint32_t vertices = 0;     ///< Vertices reached.
    std::uint32_t tested = 0;       ///< Points whose distance was computed.
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
    return tolerances;
}

/// Computes geodesic disks one after the other, and keeps its working memory. With kMayVary false
/// it is faster, and only for surfaces whose radii do not vary.
template <class Real, bool kMayVary = true>
class Detector {
  public:
    /// Makes a detector. Surface and bins must outlive it. If radii vary, two points are near if
    /// their distance is below the sum of their radii and `limit` - 1, else if it is below `limit`.
    Detector(const Surface<Real>& surface, const Bins<Real>& bins, const Tolerances& tolerances,
             Real limit)
        : surface_(surface), bins_(bins), limit_(limit), guard_(tolerances.limit - Real{1}),
          least_margin_(tolerances.margin), slack_(tolerances.slack),
          base_error_(tolerances.base_error), crossing_error_(tolerances.crossing_error),
          vertices_(surface.fans.size()) {}

    /// Sets the limit of later disks.
    void set_limit(Real limit) { limit_ = limit; }

    /// Takes vertex events oldest first, as the shaders do with Events::oldest.
    void take_oldest_first() { waiting_.take_oldest_first(); }

    /// Trims windows in all disks, from the start.
    void trim_all() { trims_all_ = true; }

    /// Computes a disk. Throws EndlessDisk if windows become too many. Calls `hit(place, distance)`
    /// for every place of `bins` with `wanted(place)` that is near `source`, once for each path
    /// found.
    template <class Wanted, class Hit>
    DiskCount run(FacePoint<Real> source, Wanted&& wanted, Hit&& hit) {
        struct Scan {
            Detector& detector;
            Wanted& wanted;
            Hit& hit;

            void face(std::uint32_t h, Real x, Real y, Real sigma) const {
                detector.scan_face(h, x, y, sigma, wanted, hit);
            }
            void wedge(std::uint32_t h, Real x, Real y, Real b0, Real b1, Real sigma) const {
                detector.scan_wedge(h, x, y, b0, b1, sigma, wanted, hit);
            }
        };
        const Scan scan{*this, wanted, hit};
        return spread(source, scan);
    }

    /// Computes the disk itself, and passes to `light` each way in which faces are lit, in the
    /// frame of a half-edge h of the face. A distance is the straight distance from (x, y) plus
    /// sigma. `light.face(h, x, y, sigma)` lights the whole face, `light.wedge(h, x, y, b0, b1,
    /// sigma)` what (x, -y) sees of it through [b0, b1] of h. The distance of a point is the
    /// smallest of those that light it, if that is below the limit. Throws as run().
    template <class Light>
    DiskCount spread(FacePoint<Real> source, const Light& light) {
        count_ = {};
        untrimmed_ = 0;
        waiting_.begin_disk(trims_all_);
        begin();
        own_radius_ = adaptive() ? surface_.radius_at(source) : Real{0};
        spread_from_source(source, light);
        const auto on_window = [&](const Window& window) { cross_edge(window, light); };
        const auto on_event = [&](const Event& event) { spread_from_vertex(event, light); };
        do {
            if (makes_many()) {
                untrimmed_ = waiting_.pushed();
                waiting_.begin(true);
                begin();
                spread_from_source(source, light);
            } else if (is_endless()) {
                throw EndlessDisk(source.face);
            }
        } while (waiting_.take(on_window, on_event));
        count_.windows = waiting_.pushed();
        count_.most_waiting = waiting_.most();
        count_.chain = waiting_.longest_chain();
        return count_;
    }

  private:
    using Window = ref::Window<Real>;
    using Event = ref::Event<Real>;
    struct VertexNote {
        Real distance;
        Real crossing;         ///< Where the best ray crossed `through`.
        std::uint32_t through; ///< Half-edge the best ray entered the face through.
        std::uint32_t generation;
    };
    static constexpr std::uint32_t kNoEdge = ~0u;
    static constexpr std::uint32_t kWholeFan = ~0u;

    static Real square(Real v) { return v * v; }

    void begin() {
        ++generation_;
        kept_.begin_disk();
        count_.vertices = 0;
    }

    /// Returns true if radii vary.
    bool adaptive() const { return kMayVary && surface_.is_adaptive(); }

    Real error_of(std::uint32_t crossings) const {
        return base_error_ + static_cast<Real>(crossings) * crossing_error_;
    }

    /// Begins to spread a source, window or event over a face. Long chains widen limit and margin:
    /// a path by its own chain, since its distance has that error; the margin by the longest of the
    /// disk so far, since any path may be the known one.
    void begin_operation(std::uint32_t chain) {
        margin_ = std::max(least_margin_, error_of(waiting_.longest_chain()));
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

    Real distance_at(std::uint32_t v) const {
        return vertices_[v].generation == generation_ ? vertices_[v].distance
                                                      : static_cast<Real>(kFar);
    }

    /// Handles a path of the given length that ends at v, having come in through `corner`.
    void reach(std::uint32_t v, Real distance, std::uint32_t corner, std::uint32_t through,
               Real crossing, bool whole_fan, std::uint32_t chain) {
        if (!(distance < distance_at(v)) || !(distance < reach_through(corner / 3))) {
            return;
        }
        count_.vertices += vertices_[v].generation != generation_;
        vertices_[v] = {distance, crossing, through, generation_};
        if (whole_fan || (surface_.fans[v].flags & gpu::kFanBends)) {
            waiting_.push(Event{v, whole_fan ? kWholeFan : corner, distance, chain});
        }
    }

    /// A window to push; none if its distance is negative.
    struct Child {
        Real distance = -1;
        Window window{};
    };

    void push(const Child& child) {
        if (child.distance >= 0) {
            waiting_.push(child.window, child.distance);
        }
    }

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

    template <class Light>
    void spread_from_source(FacePoint<Real> source, const Light& light) {
        const std::uint32_t first = 3 * source.face;
        const auto at = position_in(surface_, first, source);
        begin_operation(0);
        light.face(first, at.x, at.y, Real{0});
        for (std::uint32_t e = first; e < first + 3; ++e) {
            begin_operation(0);
            const auto p = position_in(surface_, e, source);
            const Real distance = root(p.x * p.x + p.y * p.y);
            reach(surface_.edges[e].origin, distance, e, kNoEdge, 0,
                  distance <= static_cast<Real>(kNearVertex), 1);
            push(leave(e, distance_at(surface_.edges[e].origin),
                       distance_at(surface_.edges[next_in_face(e)].origin), p.x, p.y, 0,
                       surface_.edges[e].length, 0, 1, remember(e, 1, e)));
        }
    }

    /// Returns true if a shortest path that came in through corner `from` may go on into `corner`:
    /// it must keep an angle of pi on both sides, or on one side of an open fan.
    bool in_shadow(const VertexFan& fan, std::uint32_t from, std::uint32_t corner) const {
        if (from == kWholeFan || (fan.flags & gpu::kFanIrregular)) {
            return true;
        }
        const auto [from_start, from_end] = angles(from);
        const auto [start, end] = angles(corner);
        const std::uint32_t left = end - from_start;
        const std::uint32_t right = from_end - start;
        // Angles are in steps, so a needle may begin where its neighbour does: either may be the
        // first.
        const bool may_come_before = start < from_start || (start == from_start && corner != from);
        const bool may_come_behind = start >= from_start;
        const std::uint32_t needed = gpu::kAnglePi - gpu::kAngleTolerance;
        if (fan.flags & gpu::kFanOpen) {
            return (may_come_before && right >= needed) || (may_come_behind && left >= needed);
        }
        const std::uint32_t around = corner != from ? fan.total_angle : 0u;
        return (may_come_before && left + around >= needed && right >= needed) ||
               (may_come_behind && left >= needed && right + around >= needed);
    }

    std::pair<std::uint32_t, std::uint32_t> angles(std::uint32_t corner) const {
        const std::uint32_t word = surface_.edges[corner].fan_angles;
        const std::uint32_t start = word & 0xffffu;
        return {start, start + (word >> 16)};
    }

    template <class Light>
    void spread_from_vertex(const Event& event, const Light& light) {
        const std::uint32_t v = event.vertex;
        if (distance_at(v) < event.sigma) {
            return;
        }
        const VertexFan& fan = surface_.fans[v];
        for (std::uint32_t i = 0; i < fan.corner_count; ++i) {
            const std::uint32_t corner = surface_.corners[fan.first_corner + i];
            if (!in_shadow(fan, event.corner, corner)) {
                continue;
            }
            const std::uint32_t e = next_in_face(corner);
            const std::uint32_t back = previous_in_face(corner);
            const Edge<Real>& edge = surface_.edges[e];
            begin_operation(event.chain);
            reach(edge.origin, event.sigma + surface_.edges[corner].length, e, kNoEdge, 0, false,
                  event.chain + 1);
            reach(surface_.edges[back].origin, event.sigma + surface_.edges[back].length, back,
                  kNoEdge, 0, false, event.chain + 1);
            push(leave(e, distance_at(edge.origin), distance_at(surface_.edges[back].origin),
                       edge.apex_x, edge.apex_y, 0, edge.length, event.sigma, event.chain + 1,
                       remember(e, event.chain + 1, e)));
            light.face(e, edge.apex_x, edge.apex_y, event.sigma);
        }
    }

    /// Carries a window into every other face of its edge.
    template <class Light>
    void cross_edge(const Window& window, const Light& light) {
        const Real length = surface_.edges[window.edge].length;
        bool same_way = true;
        std::uint32_t h = window.edge;
        Window entering = window;
        bool is_first = true;
        for (;;) {
            const std::uint32_t around = surface_.edges[h].around;
            same_way = same_way == around_same_way(around);
            h = around_half_edge(around);
            if (h == window.edge) {
                return;
            }
            if (same_way) {
                entering = window;
            } else {
                entering.x = length - window.x;
                entering.b0 = length - window.b1;
                entering.b1 = length - window.b0;
                entering.start = window.end;
                entering.end = window.start;
            }
            if (std::exchange(is_first, false) && waiting_.trims() && is_trimmed(h, entering)) {
                return;
            }
            if (turns_back(h, window)) {
                continue;
            }
            enter_face(h, entering, light);
        }
    }

    /// Returns true if there are so many windows that the disk must restart to trim.
    bool makes_many() const {
        const std::uint32_t vertices = std::min(count_.vertices, gpu::kUntrimmedVertices);
        const std::uint32_t each = gpu::kUntrimmedEach + (vertices >> gpu::kUntrimmedShift);
        return !waiting_.trims() && waiting_.pushed() > gpu::kUntrimmedWindows + vertices * each;
    }

    /// Returns true if the disk does not end although it trims.
    bool is_endless() const {
        const std::uint32_t vertices = std::min(count_.vertices, gpu::kUntrimmedVertices);
        const std::uint32_t trimmed = waiting_.pushed() - untrimmed_;
        return waiting_.trims() && trimmed > gpu::kMostWindows + vertices * gpu::kMostPerVertex;
    }

    /// Returns true if the window, given in the frame of h, is dropped by trimming.
    bool is_trimmed(std::uint32_t h, const Window& window) {
        return kept_.trims(surface_.edges[h].origin, surface_.edges[next_in_face(h)].origin,
                           surface_.edges[h].length,
                           {window.x, window.y, window.b0, window.b1, window.sigma}, limit_);
    }

    /// Carries the window, given in the frame of h with its source at (x, -y), into the face of h.
    template <class Light>
    void enter_face(std::uint32_t h, const Window& window, const Light& light) {
        const Real x = window.x;
        const Real y = window.y;
        const Real b0 = window.b0;
        const Real b1 = window.b1;
        const Real sigma = window.sigma;
        begin_operation(window.chain);
        // First, so that memory of the bins and of the face is loaded at the same time.
        light.wedge(h, x, y, b0, b1, sigma);
        const Edge<Real>& edge = surface_.edges[h];
        const std::uint32_t left = previous_in_face(h);
        const std::uint32_t right = next_in_face(h);
        const Real crossing = x + (edge.apex_x - x) * ratio(y, edge.apex_y + y);
        bool to_left = crossing > b0;
        bool to_right = crossing < b1;
        const std::uint32_t apex = surface_.edges[left].origin;
        if (crossing >= b0 - slack_ && crossing <= b1 + slack_) {
            const Real distance = sigma + root(square(edge.apex_x - x) + square(edge.apex_y + y));
            split_once(apex, h, crossing, distance, to_left, to_right);
            reach(apex, distance, left, h, crossing, false, window.chain + 1);
        }
        const Real known = distance_at(apex);
        const Child over_left =
            to_left ? lit_child(left, true, h, x, y, b0, crossing < b1 ? kFull : b1, known, window)
                    : Child{};
        const Child over_right =
            to_right ? lit_child(right, false, h, edge.length - x, y, edge.length - b1,
                                 crossing > b0 ? kFull : edge.length - b0, known, window)
                     : Child{};
        // The nearer one is pushed last, so that the stack returns it first.
        const bool right_first = over_left.distance < over_right.distance;
        push(right_first ? over_right : over_left);
        push(right_first ? over_left : over_right);
    }

    static constexpr Real kFull = -1;

    /// One angle, one split (Chen and Han 1990): if another window reached the apex through the
    /// same angle by a shorter path, only the child on this window's own side matters.
    void split_once(std::uint32_t apex, std::uint32_t h, Real crossing, Real distance,
                    bool& to_left, bool& to_right) const {
        const VertexNote& note = vertices_[apex];
        if (!surface_.frame.splits_once || note.generation != generation_ || note.through != h ||
            !to_left || !to_right || !(distance > note.distance + margin_)) {
            return;
        }
        // If both rays cross at the same position within rounding, the sides are ambiguous.
        if (crossing < note.crossing - slack_) {
            to_right = false;
        } else if (crossing > note.crossing + slack_) {
            to_left = false;
        }
    }

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
                const Real limit2 = adaptive() ? near_square(place, sigma) : rest2;
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
            adaptive() ? surface_.cells_per_unit(f) : static_cast<Real>(gpu::kCellsPerDistance);
        const std::uint32_t column0 = cell_at(center.x - reach, grid.columns, per_unit);
        const std::uint32_t column1 = cell_at(center.x + reach, grid.columns, per_unit);
        const std::uint32_t row1 = cell_at(center.y + reach, grid.rows, per_unit);
        for (std::uint32_t row = cell_at(center.y - reach, grid.rows, per_unit); row <= row1;
             ++row) {
            const std::uint32_t start = grid.first_cell + row * grid.columns;
            scan_places(bins_.starts[start + column0], bins_.starts[start + column1 + 1]);
        }
    }

    /// Returns, if radii vary, the squared distance from a source at sigma below which a place is
    /// near.
    Real near_square(std::uint32_t place, Real sigma) const {
        const Real rest = limit_with(surface_.radius_at(bins_.points[place])) - sigma;
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
    /// Rounding of positions against cell borders, relative to the face's extent.
    static constexpr double kCellPadding = 0x1p-20;

    const Surface<Real>& surface_;
    const Bins<Real>& bins_;
    Real limit_;
    const Real guard_, least_margin_, slack_;
    const Real base_error_, crossing_error_;
    Real margin_ = 0;       ///< By how much a known path must beat a window in this operation.
    Real beyond_guard_ = 0; ///< By how much its error exceeds the guard.
    Real own_radius_ = 0;   ///< Radius of the source, if radii vary.
    std::vector<VertexNote> vertices_;
    std::uint32_t generation_ = 0;
    Waiting<Real> waiting_;
    bool trims_all_ = false;
    std::uint32_t untrimmed_ = 0; ///< Windows and events pushed in this disk before it began to
                                  ///< trim.
    KeptWindows<Real> kept_;
    DiskCount count_;
};

} // namespace geodisk::ref
