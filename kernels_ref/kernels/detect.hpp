// Twin of shaders/kernels/detect.comp: the geodesic disk of one point by windows (improved
// Chen-Han, Xin and Wang 2009), cut at the limit, and the points in it.
#pragma once

#include <algorithm>
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
#include "kernels/windows.hpp"
#include "lib/frame.hpp"
#include "lib/scalar.hpp"
#include "lib/surface.hpp"

namespace geodisk::ref {

/// Computes geodesic disks one after the other, and keeps its working memory. With kMayVary false
/// it is faster, and only for surfaces whose radii do not vary.
template <class Real, bool kMayVary = true>
class Detector : public Windows<Real, kMayVary> {
  public:
    /// Makes a detector, as Windows says.
    Detector(const Surface<Real>& surface, const Bins<Real>& bins, const Tolerances& tolerances,
             Real limit)
        : Base(surface, bins, tolerances, limit), vertices_(surface.fans.size()),
          kept_(Base::trim_scale()) {}

    /// Takes vertex events oldest first, as the shaders do with Events::oldest.
    void take_oldest_first() { waiting_.take_oldest_first(); }

    /// Trims windows in all disks, from the start.
    void trim_all() { trims_all_ = true; }

    /// Makes later disks share what they reach. The depth of a point in a disk is the disk's limit
    /// minus the distance of the point. A later disk goes only where it is deeper than all before:
    /// it finds the points where it is, and perhaps others. So the time of disks that overlap is
    /// about that of their union.
    void share_depths() {
        depths_.assign(surface_.fans.size(), -std::numeric_limits<Real>::infinity());
    }

    /// Computes a disk. Throws EndlessDisk if windows become too many. Calls `hit(place, distance)`
    /// for every place of `bins` with `wanted(place)` that is near `source`, once for each path
    /// found.
    template <class Wanted, class Hit>
    DiskCount run(FacePoint<Real> source, Wanted&& wanted, Hit&& hit) {
        return spread(source, this->scan_by(wanted, hit));
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
        note_depths();
        waiting_.begin_disk(trims_all_);
        begin();
        own_radius_ = adaptive() ? surface_.radius_at(source) : Real{0};
        spread_from_source(source, light);
        const auto on_window = [&](const Window& window) { cross_edge(window, light); };
        const auto on_event = [&](const Event& event) { spread_from_vertex(event, light); };
        do {
            if (!waiting_.trims() &&
                makes_many(gpu::kUntrimmedWindows, waiting_.longest_chain(), waiting_.pushed())) {
                untrimmed_ = waiting_.pushed();
                waiting_.begin(true);
                begin();
                spread_from_source(source, light);
            } else if (is_endless()) {
                throw EndlessDisk(source.face);
            }
        } while (waiting_.take(on_window, on_event));
        count_.windows = waiting_.pushed();
        count_.max_waiting = waiting_.most();
        count_.chain = waiting_.longest_chain();
        return count_;
    }

  private:
    using Base = Windows<Real, kMayVary>;
    using Base::adaptive, Base::arrival_at_apex, Base::begin_operation, Base::entry_through,
        Base::error_of, Base::leave, Base::leave_shadow, Base::lit_child, Base::makes_many,
        Base::reach_through, Base::remember;
    using Base::count_, Base::limit_, Base::margin_, Base::own_radius_, Base::slack_;
    using Base::kFull, Base::kNearVertex, Base::kNoEdge, Base::kWholeFan;
    using Base::square, Base::surface_, Base::turns_back;
    using typename Base::Child;
    using typename Base::Window;
    using Event = ref::Event<Real>;
    struct VertexNote {
        Real distance;
        Real crossing;         ///< Point where the best ray crossed `through`.
        std::uint32_t through; ///< Half-edge the best ray entered the face through.
        std::uint32_t generation;
    };
    void begin() {
        ++generation_;
        kept_.begin_disk();
        Base::set_trims(waiting_.trims());
        count_.vertices = 0;
    }

    /// Returns the shortest distance at which a path of this disk may still be of use at a vertex.
    Real distance_at(std::uint32_t v) const {
        const Real own = vertices_[v].generation == generation_ ? vertices_[v].distance
                                                                : static_cast<Real>(kFar);
        return depths_.empty() ? own : std::min(own, limit_ - depths_[v]);
    }

    /// Notes how deep in the last disk its vertices are, where disks share that.
    void note_depths() {
        for (const std::uint32_t v : reached_) {
            depths_[v] = std::max(depths_[v], last_limit_ - vertices_[v].distance);
        }
        reached_.clear();
        last_limit_ = limit_;
    }

    /// Handles a path of the given length that ends at v, having come in through `corner`.
    void reach(std::uint32_t v, Real distance, std::uint32_t corner, std::uint32_t arrival,
               std::uint32_t through, Real crossing, bool whole_fan, std::uint32_t chain) {
        if (!(distance < distance_at(v)) || !(distance < reach_through(corner / 3))) {
            return;
        }
        if (vertices_[v].generation != generation_) {
            ++count_.vertices;
            if (!depths_.empty()) {
                reached_.push_back(v);
            }
        }
        vertices_[v] = {distance, crossing, through, generation_};
        if (whole_fan || (surface_.fans[v].flags & gpu::kFanBends)) {
            waiting_.push(Event{v, whole_fan ? kWholeFan : corner, distance, chain, arrival});
        }
    }

    void push(const Child& child) {
        if (child.distance >= 0) {
            waiting_.push(child.window, child.distance);
        }
    }

    template <class Light>
    void spread_from_source(FacePoint<Real> source, const Light& light) {
        const std::uint32_t first = 3 * source.face;
        const auto at = position_in(surface_, first, source);
        begin_operation(0, waiting_.longest_chain());
        light.face(first, at.x, at.y, Real{0});
        for (std::uint32_t e = first; e < first + 3; ++e) {
            begin_operation(0, waiting_.longest_chain());
            const auto p = position_in(surface_, e, source);
            const Real distance = root(p.x * p.x + p.y * p.y);
            reach(surface_.edges[e].origin, distance, e,
                  arrival_from(p.x, p.y, blur_of(error_of(1), distance)), kNoEdge, 0,
                  distance <= static_cast<Real>(kNearVertex), 1);
            push(leave(e, distance_at(surface_.edges[e].origin),
                       distance_at(surface_.edges[next_in_face(e)].origin), p.x, p.y, 0,
                       surface_.edges[e].length, 0, 1, remember(e, 1, e)));
        }
    }

    template <class Light>
    void spread_from_vertex(const Event& event, const Light& light) {
        const std::uint32_t v = event.vertex;
        if (distance_at(v) < event.sigma) {
            return;
        }
        const VertexFan& fan = surface_.fans[v];
        const Entry entry = entry_through(fan, event.corner, event.arrival);
        for (std::uint32_t i = 0; i < fan.corner_count; ++i) {
            const std::uint32_t corner = surface_.corners[fan.first_corner + i];
            const Shadow shadow = shadow_in(entry, surface_.edges[corner].fan_angles);
            if (shadow.low > shadow.high) {
                continue;
            }
            const std::uint32_t e = next_in_face(corner);
            const std::uint32_t back = previous_in_face(corner);
            const Edge<Real>& edge = surface_.edges[e];
            begin_operation(event.chain, waiting_.longest_chain());
            reach(edge.origin, event.sigma + surface_.edges[corner].length, e,
                  gpu::kArrivedAlongPrevious, kNoEdge, 0, false, event.chain + 1);
            reach(surface_.edges[back].origin, event.sigma + surface_.edges[back].length, back, 0,
                  kNoEdge, 0, false, event.chain + 1);
            push(leave_shadow(e, shadow, distance_at(edge.origin),
                              distance_at(surface_.edges[back].origin), event.sigma,
                              event.chain + 1));
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

    /// Returns true if the disk does not end although it trims.
    bool is_endless() const {
        const std::uint32_t vertices = std::min(count_.vertices, gpu::kUntrimmedVertices);
        const std::uint32_t trimmed = waiting_.pushed() - untrimmed_;
        return waiting_.trims() && trimmed > gpu::kMaxWindows + vertices * gpu::kMaxPerVertex;
    }

    /// Returns true if the window, given in the frame of h, is dropped by trimming.
    bool is_trimmed(std::uint32_t h, const Window& window) {
        begin_operation(window.chain, waiting_.longest_chain());
        return kept_.trims(surface_.edges[h].origin, surface_.edges[next_in_face(h)].origin,
                           surface_.edges[h].length,
                           {window.x, window.y, window.b0, window.b1, window.sigma},
                           Base::path_limit(), margin_);
    }

    /// Carries the window, given in the frame of h with its source at (x, -y), into the face of h.
    template <class Light>
    void enter_face(std::uint32_t h, const Window& window, const Light& light) {
        const Real x = window.x;
        const Real y = window.y;
        const Real b0 = window.b0;
        const Real b1 = window.b1;
        const Real sigma = window.sigma;
        begin_operation(window.chain, waiting_.longest_chain());
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
            const Real way = root(square(edge.apex_x - x) + square(edge.apex_y + y));
            const Real distance = sigma + way;
            split_once(apex, h, crossing, distance, to_left, to_right);
            reach(apex, distance, left, arrival_at_apex(edge, window, way), h, crossing, false,
                  window.chain + 1);
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

    std::vector<VertexNote> vertices_;
    std::uint32_t generation_ = 0;
    std::vector<Real> depths_; ///< Depth of each vertex in earlier disks; empty if not shared.
    std::vector<std::uint32_t> reached_; ///< Vertices of the last disk, if depths are shared.
    Real last_limit_ = 0;
    Waiting<Real> waiting_;
    bool trims_all_ = false;
    std::uint32_t untrimmed_ = 0; ///< Windows and events pushed in this disk before it began to
                                  ///< trim.
    KeptWindows<Real> kept_;
};

} // namespace geodisk::ref
