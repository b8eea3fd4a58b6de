#include "geodesics/wavefront.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "constants.h"
#include "geodesics/face_frame.hpp"

namespace geodisk::geodesics {
namespace {

/// Part of its length by which a path to a vertex or target may be longer than the straight one
/// since that passes beside its window. Rounding moves rays by less.
constexpr double kSlack = 0x1p-40;

/// Part of an edge that a root is off it at least.
constexpr double kGrain = 0x1p-50;

/// The apex of a face, in place of a point of its edge.
constexpr double kToApex = -1;

/// Half-edges between two questions whether to go on.
constexpr std::uint32_t kPerQuestion = 1u << 12;

/// Calls `visit(h, same_way)` for all other half-edges of the edge.
template <class Visit>
void for_around(std::span<const HalfEdge> edges, std::uint32_t edge, const Visit& visit) {
    bool same_way = true;
    for (std::uint32_t h = edge;;) {
        const std::uint32_t around = edges[h].around;
        same_way = same_way == around_same_way(around);
        h = around_half_edge(around);
        if (h == edge) {
            return;
        }
        visit(h, same_way);
    }
}

} // namespace

PathPoint precise(const Sample& point) {
    const double second = point.weights[1], third = point.weights[2];
    const double sum = double{point.weights[0]} + second + third;
    return {point.face, {1 - (second + third) / sum, second / sum, third / sum}};
}

std::uint32_t vertex_at(const PreparedMesh& mesh, const PathPoint& point) {
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
        if (point.weights[corner] == 1) {
            return mesh.half_edges()[std::size_t{3} * point.face + corner].origin;
        }
    }
    return kNone;
}

Wavefront::Wavefront(const PreparedMesh& mesh, double within)
    : mesh_(mesh), edges_(mesh.half_edges()), within_(within),
      is_in_space_(mesh.statistics().diagonal > 0), vertices_(mesh.vertex_count()),
      waiting_(edges_.size()), nearest_(edges_.size(), kFar) {}

void Wavefront::aim_at(std::span<const PathPoint> targets) {
    targets_ = targets;
    arrivals_.assign(targets.size(), {});
    by_face_.resize(targets.size());
    std::iota(by_face_.begin(), by_face_.end(), 0u);
    std::ranges::stable_sort(by_face_, {}, [&](std::uint32_t i) { return targets[i].face; });
    has_targets_.assign(targets.empty() ? 0 : mesh_.face_count(), false);
    for (const PathPoint& target : targets) {
        has_targets_[target.face] = true;
    }
}

/// Calls `visit(target)` for each target in a face.
template <class Visit>
void Wavefront::for_targets_in(std::uint32_t face, const Visit& visit) const {
    if (has_targets_.empty() || !has_targets_[face]) {
        return;
    }
    const auto face_of = [&](std::uint32_t i) { return targets_[i].face; };
    auto target = std::ranges::lower_bound(by_face_, face, {}, face_of);
    for (; target != by_face_.end() && face_of(*target) == face; ++target) {
        visit(*target);
    }
}

void Wavefront::add(const PathPoint& point, std::uint32_t index) {
    const std::uint32_t first = 3 * point.face;
    const Arrival here{0, mesh_.vertex_count() + index, index};
    if (const std::uint32_t vertex = vertex_at(mesh_, point); vertex != kNone) {
        reach(vertex, here);
        queue_.push({0, vertex, true});
        return;
    }
    begin_in_face(point, here);
    for (std::uint32_t h = first; h < first + 3; ++h) {
        if (point.weights[previous_in_face(h) % 3] != 0) {
            continue;
        }
        // On an edge, of all of whose faces it is.
        const double begin = point.weights[h % 3], end = point.weights[next_in_face(h) % 3];
        for_around(edges_, h, [&](std::uint32_t other, bool same_way) {
            PathPoint same{other / 3, {}};
            same.weights[other % 3] = same_way ? begin : end;
            same.weights[next_in_face(other) % 3] = same_way ? end : begin;
            begin_in_face(same, here);
        });
    }
}

/// Spreads a source over a face.
void Wavefront::begin_in_face(const PathPoint& at, const Arrival& here) {
    const std::uint32_t first = 3 * at.face;
    reach_targets_from(first, point_in(edges_[first], first, at.weights), here);
    for (std::uint32_t h = first; h < first + 3; ++h) {
        const FlatPoint p = point_in(edges_[h], h, at.weights);
        Arrival path = here;
        path.distance = length_of(p);
        reach(edges_[h].origin, path);
        leave(h, {p.x, p.y, 0, edges_[h].length, 0, here.root, kNone}, kNone, to_left_);
        arrive(h, to_left_);
    }
}

Result<Done> Wavefront::spread(const std::function<bool(std::uint32_t reached)>& goes_on) {
    for (std::uint32_t steps = 1; !queue_.empty(); ++steps) {
        const Next next = queue_.top();
        if (next.distance > within_) {
            break;
        }
        queue_.pop();
        if (next.is_vertex) {
            if (distance_at(next.number) == next.distance) {
                light_fan(next.number);
            }
        } else if (nearest_[next.number] == next.distance) {
            cross_face(next.number);
        }
        if (made_ > gpu::kMaxWindows + std::uint64_t{gpu::kMaxPerVertex} * reached_) {
            return Error{Status::mesh_rejected,
                         "distances could not be computed: the mesh holds too many edges of more "
                         "than two faces"};
        }
        if (steps % kPerQuestion == 0 && !goes_on(reached_)) {
            return Error{Status::cancelled, "cancelled"};
        }
    }
    return Done{};
}

/// Notes a path to a vertex, if none is shorter.
void Wavefront::reach(std::uint32_t vertex, const Arrival& path) {
    Arrival& known = vertices_[vertex];
    if (!(path.distance < known.distance) || path.distance > within_) {
        return;
    }
    reached_ += known.distance == kFar ? 1 : 0;
    known = path;
    if ((mesh_.fans()[vertex].flags & gpu::kFanBends) != 0) {
        queue_.push({path.distance, vertex, true});
    }
    if (vertex == aimed_) {
        within_ = path.distance;
    }
    if (!targets_.empty()) {
        const VertexFan& fan = mesh_.fans()[vertex];
        for (const std::uint32_t corner :
             mesh_.corners().subspan(fan.first_corner, fan.corner_count)) {
            reach_targets_from(corner, {0, 0}, {path.distance, vertex, path.source});
        }
    }
}

/// Notes a path to a target, if none is shorter. If it is the only one, longer paths are of no use
/// from then on.
void Wavefront::reach_target(std::uint32_t target, const Arrival& path) {
    if (path.distance < arrivals_[target].distance && !(path.distance > within_)) {
        arrivals_[target] = path;
        within_ = targets_.size() == 1 ? std::min(within_, path.distance) : within_;
    }
}

/// Notes the paths that go on from a root straight to the targets of its face.
void Wavefront::reach_targets_from(std::uint32_t h, FlatPoint from, const Arrival& root) {
    for_targets_in(h / 3, [&](std::uint32_t target) {
        const FlatPoint to = point_in(edges_[h], h, targets_[target].weights);
        Arrival path{root.distance, root.root, root.source};
        path.distance += length_of({to.x - from.x, to.y - from.y});
        reach_target(target, path);
    });
}

/// Makes windows of all directions around a vertex.
void Wavefront::light_fan(std::uint32_t vertex) {
    const VertexFan& fan = mesh_.fans()[vertex];
    const Arrival at = vertices_[vertex];
    for (const std::uint32_t corner : mesh_.corners().subspan(fan.first_corner, fan.corner_count)) {
        const std::uint32_t opposite = next_in_face(corner), back = previous_in_face(corner);
        const HalfEdge& edge = edges_[opposite];
        Arrival path{at.distance + edges_[corner].length, vertex, at.source};
        reach(edge.origin, path);
        path.distance = at.distance + edges_[back].length;
        reach(edges_[back].origin, path);
        leave(opposite, {edge.apex_x, edge.apex_y, 0, edge.length, at.distance, vertex, kNone},
              kNone, to_left_);
        arrive(opposite, to_left_);
    }
}

/// Notes the paths of a window that end in the face of h.
void Wavefront::look(std::uint32_t h, const Window& window) {
    const auto end_at = [&](FlatPoint p) -> std::optional<Arrival> {
        const double straight = length_of({p.x - window.x, p.y + window.y});
        const double crossing = window.crossing_to(p.x, p.y);
        double way = straight;
        if (!(crossing >= window.begin && crossing <= window.end)) {
            const double beside = crossing < window.begin ? window.begin : window.end;
            way = std::sqrt(window.square_to(beside)) + length_of({p.x - beside, p.y});
            if (!(way <= straight * (1 + kSlack))) {
                return std::nullopt;
            }
        }
        const std::uint32_t source = window.root < mesh_.vertex_count()
                                         ? vertices_[window.root].source
                                         : window.root - mesh_.vertex_count();
        return Arrival{window.sigma + way, window.root, source,      h,
                       window.x,           window.y,    window.trail};
    };
    if (const auto path = end_at({edges_[h].apex_x, edges_[h].apex_y})) {
        reach(edges_[previous_in_face(h)].origin, *path);
    }
    for_targets_in(h / 3, [&](std::uint32_t target) {
        if (const auto path = end_at(point_in(edges_[h], h, targets_[target].weights))) {
            reach_target(target, *path);
        }
    });
}

/// Carries all windows that wait at h through its face.
void Wavefront::cross_face(std::uint32_t h) {
    crossing_.clear();
    crossing_.swap(waiting_[h]);
    nearest_[h] = kFar;
    for (const Window& window : crossing_) {
        look(h, window);
    }
    const std::uint32_t left = previous_in_face(h), right = next_in_face(h);
    const HalfEdge& edge = edges_[h];
    for (const Window& window : crossing_) {
        if ((is_in_space_ && window.remembered == h / 3) || is_beaten_at_ends(h, window)) {
            continue;
        }
        const double middle = window.crossing_to(edge.apex_x, edge.apex_y);
        if (middle > window.begin) {
            cross_to(left, h, window, window.begin, middle < window.end ? kToApex : window.end);
        }
        if (middle < window.end) {
            cross_to(right, h, window, window.end, middle > window.begin ? kToApex : window.begin);
        }
    }
    // The farther along h they cross, the nearer to the begin of either edge.
    std::ranges::reverse(to_left_);
    std::ranges::reverse(to_right_);
    arrive(left, to_left_);
    arrive(right, to_right_);
}

/// Carries a window from h over another edge of its face: what is lit between its rays through
/// `near` and `far`, places on h, or the apex for kToApex.
void Wavefront::cross_to(std::uint32_t child, std::uint32_t h, const Window& window, double near,
                         double far) {
    const double length = edges_[child].length;
    // From the corner that both edges share, by the angle between them.
    const bool is_left = child == previous_in_face(h);
    const HalfEdge& edge = is_left ? edges_[h] : edges_[child];
    const double apex_way = is_left ? length : edges_[h].length;
    const double cosine = edge.apex_x / apex_way, sine = edge.apex_y / apex_way;
    const auto from_corner = [&](double at) { return is_left ? at : edges_[h].length - at; };
    const double x = from_corner(window.x), y = window.y;
    const auto along = [&](double at) {
        const double under = y * cosine + sine * (x - at);
        return under > 0 ? std::min(y * at / under, length) : length;
    };
    const double low = along(from_corner(near));
    const double high = far == kToApex ? length : along(from_corner(far));
    Window next = window;
    // A window that winds around a needle returns to a face: one that is remembered since its chain
    // was last a power of two finds every cycle (Brent 1980).
    if (++next.chain >= gpu::kFirstRemembered && std::has_single_bit(next.chain)) {
        next.remembered = h / 3;
    }
    next.x = x * cosine - y * sine;
    next.y = x * sine + y * cosine;
    next.begin = low;
    next.end = high;
    // The left one runs towards that corner.
    next = is_left ? turned(next, length) : next;
    // From the third corner of the face, beside the edge that the paths came over.
    const double beside = is_left ? next.end : next.begin;
    const double way = length_of({edges_[child].apex_x - beside, edges_[child].apex_y});
    if (!is_beaten(is_left ? end_of(h) : edges_[h].origin, way, next, beside)) {
        leave(child, next, window.trail, is_left ? to_left_ : to_right_);
    }
}

/// Adds a window, given in the frame of the half-edge that it leaves a face by, unless it is of no
/// use beyond.
void Wavefront::leave(std::uint32_t h, Window window, std::uint32_t from, WindowList& windows) {
    const double length = edges_[h].length, grain = kGrain * length;
    // A root in line with the edge lights nothing beyond it: its ends go on for themselves. One on
    // the edge, as the corner of a flat triangle may be, lights everything.
    if (window.y < grain && (window.x <= grain || length - window.x <= grain)) {
        return;
    }
    window.y = std::max(window.y, grain);
    if (window.is_empty() || window.nearest() > within_ ||
        around_half_edge(edges_[h].around) == h || is_beaten_at_ends(h, window)) {
        return;
    }
    if (records_) {
        if (trails_.size() >= kNone) {
            throw std::length_error("trails");
        }
        window.trail = static_cast<std::uint32_t>(trails_.size());
        trails_.push_back({h, from});
    }
    windows.push_back(window);
    ++made_;
}

/// Returns true if a path by way of a vertex is shorter than the window's own to a point of its
/// edge, `way` from the vertex (Xin and Wang 2009).
bool Wavefront::is_beaten(std::uint32_t vertex, double way, const Window& window, double at) const {
    const double rest = (distance_at(vertex) + way) * (1 + kTie) - window.sigma;
    return rest < 0 || square(rest) < window.square_to(at);
}

/// Returns true if this holds for an end of the edge and the far end of the window.
bool Wavefront::is_beaten_at_ends(std::uint32_t h, const Window& window) const {
    return is_beaten(edges_[h].origin, window.end, window, window.end) ||
           is_beaten(end_of(h), edges_[h].length - window.begin, window, window.begin);
}

/// Takes windows over an edge into its other faces, where they wait.
void Wavefront::arrive(std::uint32_t leaving, WindowList& windows) {
    if (windows.empty()) {
        return;
    }
    const double length = edges_[leaving].length;
    for_around(edges_, leaving, [&](std::uint32_t h, bool same_way) {
        turned_ = windows;
        if (!same_way) {
            std::ranges::transform(turned_, turned_.begin(),
                                   [&](const Window& window) { return turned(window, length); });
            std::ranges::reverse(turned_);
        }
        double nearest = kFar;
        for (const Window& window : turned_) {
            nearest = std::min(nearest, window.nearest());
        }
        merger_.merge(waiting_[h], turned_);
        if (nearest < nearest_[h]) {
            nearest_[h] = nearest;
            queue_.push({nearest, h, false});
        }
    });
    windows.clear();
}

} // namespace geodisk::geodesics
