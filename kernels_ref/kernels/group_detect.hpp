// Twin of shaders/kernels/group_detect.comp: the geodesic disk of one point in waves, as the lanes
// of a work group compute it together.
#pragma once

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "constants.h"
#include "kernels/windows.hpp"

namespace geodisk::ref {

/// A disk with so many windows that they must be trimmed.
struct ManyWindows : std::runtime_error {
    ManyWindows() : std::runtime_error("a disk in waves makes too many windows") {}
};

/// Computes geodesic disks in waves, and keeps its working memory. A wave takes all windows and
/// events that are nearer than the nearest one and a step. Within a phase of a wave nothing is
/// read that changes, so the order of the work does not matter.
template <class Real, bool kMayVary = true>
class GroupDetector : public Windows<Real, kMayVary> {
  public:
    /// Makes a detector, as Windows says.
    GroupDetector(const Surface<Real>& surface, const Bins<Real>& bins,
                  const Tolerances& tolerances, Real limit)
        : Base(surface, bins, tolerances, limit), vertices_(surface.fans.size()) {}

    /// Computes a disk, as Detector::run().
    template <class Wanted, class Hit>
    DiskCount run(FacePoint<Real> source, Wanted&& wanted, Hit&& hit) {
        return spread(source, this->scan_by(wanted, hit));
    }

    /// Computes the disk itself, as Detector::spread(). Throws ManyWindows where windows must be
    /// trimmed, which a Detector does.
    template <class Light>
    DiskCount spread(FacePoint<Real> source, const Light& light) {
        begin_disk(source);
        while (!items_.empty() || !events_.empty()) {
            spread_wave(light);
            if (makes_many(gpu::kUntrimmedInGroups, count_.chain, count_.windows)) {
                throw ManyWindows();
            }
        }
        return count_;
    }

    /// Returns the waves of the last disk.
    std::uint32_t waves() const { return waves_; }

  private:
    using Base = Windows<Real, kMayVary>;
    using Base::adaptive, Base::begin_operation, Base::entry_through, Base::error_of, Base::leave,
        Base::leave_shadow, Base::lit_child, Base::makes_many, Base::reach_through, Base::remember;
    using Base::count_, Base::margin_, Base::own_radius_, Base::slack_;
    using Base::kCrossingPart, Base::kFull, Base::kNearVertex, Base::kWholeFan;
    using Base::square, Base::surface_, Base::turns_back;
    using typename Base::Child;
    using typename Base::Window;

    /// The shortest paths to a vertex. A way is the corner that a path came in through, and whether
    /// it came along an edge; kWholeWay for a source so near that the whole fan is lit.
    struct VertexNote {
        Real distance = 0;
        std::uint32_t generation = 0;
        std::uint32_t first_way = ~0u, last_way = 0; ///< Lowest and highest of those that tie.
        Real crossing = static_cast<Real>(kFar);     ///< Lowest of those that tie.
        std::uint32_t path = 0; ///< Longest chain of those that tie, and the blur of that one.
        Real lit = -1;          ///< Distance that an event was made for.
    };
    static constexpr std::uint32_t kWholeWay = 0;
    static std::uint32_t way_of(std::uint32_t corner, bool along_edge) {
        return 2 * (corner + 1) + (along_edge ? 1 : 0);
    }

    /// A window that enters the face of half_edge, from an edge of the same or the other direction;
    /// or a source inside that face, `window` then has only sigma and chain, and for the candidate
    /// (chain 0) its position. Another source is at the apex, and lights the shadow there.
    struct Item {
        std::uint32_t half_edge;
        bool inside, same_way;
        Window window;
        Real distance;
        Shadow shadow{};
    };
    struct Event {
        std::uint32_t vertex;
        Real distance;
        std::uint32_t first, end; ///< Corners of the fan.
    };
    struct Proposal {
        const Item* item;
        std::uint32_t vertex, way;
        Real distance, crossing;
    };
    /// Relation of a window to the apex of the face that it enters.
    struct Meeting {
        Real crossing, distance;
        bool sees_apex;
    };

    void begin_disk(FacePoint<Real> source) {
        count_ = {};
        ++generation_;
        own_radius_ = adaptive() ? surface_.radius_at(source) : Real{0};
        items_.clear();
        events_.clear();
        waves_ = lit_again_ = 0;
        nearest_ = 0;
        Real around = 0;
        for (std::uint32_t e = 3 * source.face; e < 3 * source.face + 3; ++e) {
            const auto at = position_in(surface_, e, source);
            Item item{e, true, true, {}, Real{0}};
            item.window.x = at.x;
            item.window.y = at.y;
            items_.push_back(item);
            around += surface_.edges[e].length;
        }
        // Waves on a face of about no size would not end.
        step_ = std::max(around * static_cast<Real>(0.33333334f), slack_);
    }

    template <class Light>
    void spread_wave(const Light& light) {
        const Real end = nearest_ + step_;
        longest_chain_ = count_.chain;
        nearest_ = static_cast<Real>(kFar);
        taken_.clear();
        for (const Item& item : items_) {
            if (item.distance < end) {
                taken_.push_back(&item);
            } else {
                push(item);
            }
        }
        proposals_.clear();
        for (const Item* item : taken_) {
            take(*item, light);
        }
        for (const Proposal& proposal : proposals_) {
            settle(proposal);
        }
        for (const Item* item : taken_) {
            spread_item(*item);
        }
        for (const Event& event : events_) {
            light_fan(event, end);
        }
        items_.swap(next_items_);
        events_.swap(next_events_);
        next_items_.clear();
        next_events_.clear();
        count_.max_waiting =
            std::max(count_.max_waiting, static_cast<std::uint32_t>(items_.size()));
        if (++waves_ % gpu::kWavesPerStep == 0) {
            step_ *= 2;
        }
        // Vertices that are lit again and again waste windows: smaller waves have them in order.
        if (lit_again_ > gpu::kLitAgain + count_.vertices / 4) {
            step_ *= static_cast<Real>(0.5);
            lit_again_ = 0;
        }
    }

    Real distance_at(std::uint32_t v) const {
        return vertices_[v].generation == generation_ ? vertices_[v].distance
                                                      : static_cast<Real>(kFar);
    }

    /// Proposes a path of the item to v; `crossing` is where it crosses the edge opposite to v.
    void propose(const Item& item, std::uint32_t v, std::uint32_t way, Real distance,
                 Real crossing) {
        if (!(distance < reach_through(item.half_edge / 3))) {
            return;
        }
        VertexNote& note = vertices_[v];
        if (note.generation != generation_) {
            note = {static_cast<Real>(kFar), generation_};
            ++count_.vertices;
        }
        if (distance < note.distance) {
            const Real lit = note.lit;
            note = {distance, generation_};
            note.lit = lit;
        }
        if (distance == note.distance) {
            proposals_.push_back({&item, v, way, distance, crossing});
        }
    }

    /// Keeps a proposed path, if none is shorter. Makes an event if the fan is lit.
    void settle(const Proposal& proposal) {
        VertexNote& note = vertices_[proposal.vertex];
        if (note.distance != proposal.distance) {
            return;
        }
        const Window& window = proposal.item->window;
        const std::uint32_t chain = window.chain + 1;
        // At the corners of its own face the direction of the candidate is left open.
        const std::uint32_t blur = window.chain == 0 ? gpu::kMaxBlur
                                   : proposal.item->inside
                                       ? 0
                                       : blur_of(error_of(chain), proposal.distance - window.sigma);
        note.first_way = std::min(note.first_way, proposal.way);
        note.last_way = std::max(note.last_way, proposal.way);
        note.crossing = std::min(note.crossing, proposal.crossing);
        note.path = std::max(note.path, chain << gpu::kBlurBits | blur);
        const bool bends = (surface_.fans[proposal.vertex].flags & gpu::kFanBends) != 0;
        if (note.lit != note.distance && (bends || proposal.way == kWholeWay)) {
            lit_again_ += note.lit >= 0 ? 1u : 0u;
            note.lit = note.distance;
            events_.push_back({proposal.vertex, note.distance, 0, ~0u});
            ++count_.windows;
            count_.chain = std::max(count_.chain, chain);
        }
    }

    /// Returns the window as it enters the face of its item, with the source at (x, -y).
    Window entering(const Item& item) const {
        Window window = item.window;
        if (!item.same_way) {
            const Real length = surface_.edges[item.half_edge].length;
            window.x = length - item.window.x;
            window.b0 = length - item.window.b1;
            window.b1 = length - item.window.b0;
            std::swap(window.start, window.end);
        }
        return window;
    }

    Meeting meet_apex(const Edge<Real>& edge, const Window& w) const {
        const Real crossing = w.x + (edge.apex_x - w.x) * ratio(w.y, edge.apex_y + w.y);
        const Real distance = w.sigma + root(square(edge.apex_x - w.x) + square(edge.apex_y + w.y));
        return {crossing, distance, crossing >= w.b0 - slack_ && crossing <= w.b1 + slack_};
    }

    /// Lights the face, and proposes the distances of the vertices where paths end.
    template <class Light>
    void take(const Item& item, const Light& light) {
        begin_operation(item.window.chain, longest_chain_);
        const std::uint32_t h = item.half_edge;
        const std::uint32_t left = previous_in_face(h), right = next_in_face(h);
        const Edge<Real>& edge = surface_.edges[h];
        if (!item.inside) {
            if (turns_back(h, item.window)) {
                return;
            }
            const Window w = entering(item);
            light.wedge(h, w.x, w.y, w.b0, w.b1, w.sigma);
            const Meeting m = meet_apex(edge, w);
            if (m.sees_apex) {
                propose(item, surface_.edges[left].origin, way_of(left, false), m.distance,
                        m.crossing);
            }
            return;
        }
        const Real sigma = item.window.sigma;
        if (item.window.chain == 0) {
            const Real x = item.window.x;
            const Real y = item.window.y;
            if (h % 3 == 0) {
                light.face(h, x, y, sigma);
            }
            const Real distance = sigma + root(x * x + y * y);
            const bool whole = distance <= static_cast<Real>(kNearVertex);
            propose(item, edge.origin, whole ? kWholeWay : way_of(h, true), distance,
                    surface_.edges[right].length);
            return;
        }
        light.face(h, edge.apex_x, edge.apex_y, sigma);
        propose(item, edge.origin, way_of(h, true), sigma + surface_.edges[left].length,
                surface_.edges[right].length);
        propose(item, surface_.edges[right].origin, way_of(right, true),
                sigma + surface_.edges[right].length, Real{0});
    }

    void push(const Item& item) {
        next_items_.push_back(item);
        nearest_ = std::min(nearest_, item.distance);
    }

    void push(const Event& event) {
        next_events_.push_back(event);
        nearest_ = std::min(nearest_, event.distance);
    }

    void push(const Child& child) {
        if (child.distance < 0) {
            return;
        }
        if (child.window.chain > gpu::kLongestChain) {
            throw EndlessDisk(child.window.edge / 3);
        }
        ++count_.windows;
        count_.chain = std::max(count_.chain, child.window.chain);
        const std::uint32_t around = surface_.edges[child.window.edge].around;
        push(Item{around_half_edge(around), false, around_same_way(around), child.window,
                  child.distance});
    }

    /// Makes the windows of the next wave.
    void spread_item(const Item& item) {
        begin_operation(item.window.chain, longest_chain_);
        const std::uint32_t h = item.half_edge;
        const Edge<Real>& edge = surface_.edges[h];
        if (item.inside) {
            const std::uint32_t chain = item.window.chain + 1;
            const Real start = distance_at(edge.origin);
            const Real end = distance_at(surface_.edges[next_in_face(h)].origin);
            push(chain > 1 ? leave_shadow(h, item.shadow, start, end, item.window.sigma, chain)
                           : leave(h, start, end, item.window.x, item.window.y, 0, edge.length, 0,
                                   chain, remember(h, chain, h)));
            return;
        }
        if (!turns_back(h, item.window)) {
            cross_face(h, entering(item));
        }
        const std::uint32_t next = around_half_edge(edge.around);
        if (next != item.window.edge) { // And into another face of the edge.
            Item other = item;
            other.half_edge = next;
            other.same_way = item.same_way == around_same_way(edge.around);
            push(other);
        }
    }

    void cross_face(std::uint32_t h, const Window& w) {
        const Edge<Real>& edge = surface_.edges[h];
        const std::uint32_t left = previous_in_face(h), right = next_in_face(h);
        const std::uint32_t apex = surface_.edges[left].origin;
        const Meeting m = meet_apex(edge, w);
        bool to_left = m.crossing > w.b0;
        bool to_right = m.crossing < w.b1;
        if (m.sees_apex && to_left && to_right) {
            split_once(vertices_[apex], way_of(left, false), m, to_left, to_right);
        }
        const Real known = distance_at(apex);
        if (to_left) {
            push(lit_child(left, true, h, w.x, w.y, w.b0, m.crossing < w.b1 ? kFull : w.b1, known,
                           w));
        }
        if (to_right) {
            push(lit_child(right, false, h, edge.length - w.x, w.y, edge.length - w.b1,
                           m.crossing > w.b0 ? kFull : edge.length - w.b0, known, w));
        }
    }

    /// One angle, one split (Chen and Han 1990), against all shortest paths to the apex, if they
    /// came this way.
    void split_once(const VertexNote& note, std::uint32_t way, const Meeting& m, bool& to_left,
                    bool& to_right) const {
        if (!surface_.frame.splits_once || note.generation != generation_ ||
            note.first_way != way || note.last_way != way ||
            !(m.distance > note.distance + margin_)) {
            return;
        }
        to_right = m.crossing >= note.crossing - slack_;
        to_left = m.crossing <= note.crossing + slack_;
    }

    /// Lights the fan of a vertex, unless it was reached sooner by now. A wide fan is halved, for
    /// the next wave.
    void light_fan(const Event& event, Real wave_end) {
        const VertexNote& note = vertices_[event.vertex];
        const VertexFan& fan = surface_.fans[event.vertex];
        if (note.distance != event.distance) {
            return;
        }
        const std::uint32_t end = std::min(event.end, fan.corner_count);
        if (!(event.distance < wave_end)) {
            push(event);
        } else if (end - event.first > gpu::kCornersPerEvent) {
            const std::uint32_t middle = event.first + (end - event.first) / 2;
            push(Event{event.vertex, event.distance, event.first, middle});
            push(Event{event.vertex, event.distance, middle, end});
        } else {
            light_corners(fan, note, event.first, end);
        }
    }

    void light_corners(const VertexFan& fan, const VertexNote& note, std::uint32_t first,
                       std::uint32_t end) {
        const std::uint32_t from = note.first_way == kWholeWay ? kWholeFan : note.first_way / 2 - 1;
        const Entry entry = entry_through(fan, from, arrival_at(note, from));
        for (std::uint32_t i = first; i < end; ++i) {
            const std::uint32_t corner = surface_.corners[fan.first_corner + i];
            const Shadow shadow = shadow_in(entry, surface_.edges[corner].fan_angles);
            if (shadow.low <= shadow.high) {
                Item item{next_in_face(corner), true, true, {}, note.distance, shadow};
                item.window.sigma = note.distance;
                item.window.chain = note.path >> gpu::kBlurBits;
                push(item);
            }
        }
    }

    /// Returns how the shortest path came in through corner `from`, by where it crossed the edge
    /// opposite to it.
    std::uint32_t arrival_at(const VertexNote& note, std::uint32_t from) const {
        if (note.first_way != note.last_way || from == kWholeFan) {
            return gpu::kMaxBlur;
        }
        const Edge<Real>& edge = surface_.edges[next_in_face(from)];
        const Real along = square(edge.apex_x) + square(edge.apex_y) - edge.apex_x * note.crossing;
        // Rounding of the crossing turns the direction as well.
        const Real way = root(square(edge.apex_x - note.crossing) + square(edge.apex_y));
        const Real error = slack_ * static_cast<Real>(kCrossingPart);
        const std::uint32_t blur = std::max(note.path & gpu::kMaxBlur, blur_of(error, way));
        return arrival_from(along, edge.apex_y * note.crossing, blur);
    }

    std::vector<VertexNote> vertices_;
    std::uint32_t generation_ = 0;
    std::uint32_t waves_ = 0;
    std::uint32_t lit_again_ = 0;     ///< Events of vertices that had one, since the step changed.
    std::uint32_t longest_chain_ = 0; ///< When the wave began.
    Real step_ = 0;                   ///< By how much a wave goes beyond the nearest.
    Real nearest_ = 0;                ///< Nearest of the windows and events of the next wave.
    std::vector<Item> items_, next_items_;
    std::vector<Event> events_, next_events_;
    std::vector<const Item*> taken_; ///< Windows of this wave.
    std::vector<Proposal> proposals_;
};

} // namespace geodisk::ref
