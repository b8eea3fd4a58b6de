#include "support/unfolding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace geodisk::test {
namespace {

constexpr auto kFar = std::numeric_limits<long double>::infinity();

} // namespace

/// An edge from a to b, b to the left as seen from the origin, through which lines from there leave
/// a face.
struct Unfolding::Window {
    std::uint32_t face;
    std::uint32_t a, b;
    Number length;
    Plane at_a, at_b;
    Plane to_b; ///< Unit vector: places of very near vertices would not tell the direction.
};

/// One source: straight lines from it, then from each vertex that they meet, nearest first.
class Unfolding::Search {
  public:
    Search(const Unfolding& surface, std::span<const Point> targets, double reach)
        : surface_(surface), reach_(reach), targets_(targets), found_(targets.size(), kFar),
          vertices_(surface.fans_.size(), kFar), entered_(surface.sides_.size() / 3, false) {
        for (std::size_t i = 0; i < targets.size(); ++i) {
            by_face_[targets[i].face].push_back(i);
        }
    }

    std::vector<double> run(const Point& source) {
        // Paths along edges bound the others. Without one there is none.
        std::swap(reach_, edge_reach_);
        follow(source, false);
        std::swap(reach_, edge_reach_);
        std::ranges::fill(vertices_, kFar);
        follow(source, true);
        std::ranges::replace_if(
            found_, [&](Number d) { return d > reach_; }, kFar);
        return {found_.begin(), found_.end()};
    }

  private:
    static Number cross(Plane p, Plane q) { return p.x * q.y - p.y * q.x; }
    static Number length(Plane p) { return std::sqrt(p.x * p.x + p.y * p.y); }

    /// The place of a point of a face whose corners from corner k on lie at `at`.
    static Plane mix(std::uint32_t k, const std::array<Plane, 3>& at, const Point& point) {
        const Number w1 = point.weight1, w2 = point.weight2, weights[3] = {1 - w1 - w2, w1, w2};
        Plane sum{0, 0};
        for (std::uint32_t i = 0; i < 3; ++i) {
            sum.x += weights[(k + i) % 3] * at[i].x;
            sum.y += weights[(k + i) % 3] * at[i].y;
        }
        return sum;
    }

    /// Returns true if a straight line to p crosses all edges of the sequence, one after the other.
    bool is_lit(Plane p) const {
        const Number rounding = surface_.beside_, way = length(p);
        const Plane to_p = way > 0 ? Plane{p.x / way, p.y / way} : Plane{1, 0};
        Number last = 0; // Crossing.
        for (const Window& w : crossed_) {
            // The part of the edge that is on the line, from its start.
            const Number at_start = cross(to_p, w.at_a), slope = cross(to_p, w.to_b);
            Number low = 0, high = w.length;
            clip(low, high, at_start + rounding, slope);
            clip(low, high, rounding - at_start, -slope);
            const auto along = [&](Number s) {
                return to_p.x * (w.at_a.x + s * w.to_b.x) + to_p.y * (w.at_a.y + s * w.to_b.y);
            };
            last = std::max(last, std::min(along(low), along(high)) - rounding);
            if (!(low <= high) ||
                last > std::min(std::max(along(low), along(high)), way) + rounding) {
                return false;
            }
        }
        return true;
    }

    /// Cuts an interval to where at_start + s * slope is not negative.
    static void clip(Number& low, Number& high, Number at_start, Number slope) {
        if (slope > 0) {
            low = std::max(low, -at_start / slope);
        } else if (slope < 0) {
            high = std::min(high, -at_start / slope);
        } else if (at_start < 0) {
            high = -1;
        }
    }

    /// Returns true if a part of the edge may be lit.
    bool is_lit(const Window& w) const {
        const Number scale = std::max({length(w.at_a), length(w.at_b), w.length});
        Number low = 0, high = w.length;
        for (const Window& c : crossed_) {
            const Number room =
                surface_.beside_ * (scale + std::max(length(c.at_a), length(c.at_b)));
            clip(low, high, cross(c.at_a, w.at_a) + room, cross(c.at_a, w.to_b));
            clip(low, high, cross(w.at_a, c.at_b) + room, cross(w.to_b, c.at_b));
        }
        return low <= high + surface_.beside_;
    }

    void follow(const Point& source, bool crosses) {
        crosses_ = crosses;
        start_inside(source);
        while (!queue_.empty()) {
            const auto [distance, vertex] = queue_.top();
            queue_.pop();
            if (distance == vertices_[vertex] && distance < bound()) {
                start_at(vertex, distance);
            }
        }
    }

    /// Returns the distance beyond which no path is of use.
    Number bound() const {
        Number farthest = 0;
        for (const Number distance : found_) {
            farthest = crosses_ && distance == kFar ? farthest : std::max(farthest, distance);
        }
        return std::min(reach_, farthest);
    }

    void reach_vertex(std::uint32_t vertex, Plane at) {
        const Number distance = offset_ + length(at);
        if (distance < vertices_[vertex] && distance <= reach_) {
            vertices_[vertex] = distance;
            queue_.emplace(distance, vertex);
        }
    }

    /// The targets of a face whose corners from corner k on lie at `at`.
    void reach_targets(std::uint32_t face, std::uint32_t k, const std::array<Plane, 3>& at) {
        const auto own = by_face_.find(face);
        if (own == by_face_.end()) {
            return;
        }
        for (const std::size_t i : own->second) {
            const Plane p = mix(k, at, targets_[i]);
            const Number distance = offset_ + length(p);
            if (distance < found_[i] && distance <= reach_ && is_lit(p)) {
                found_[i] = distance;
            }
        }
    }

    const Side& side(std::uint32_t face, std::uint32_t k) const {
        return surface_.sides_[std::size_t{3} * face + k % 3];
    }

    /// The corners of a face from corner k on, which is at the origin, counter-clockwise.
    std::array<Plane, 3> laid_out(std::uint32_t face, std::uint32_t k) const {
        const Side& edge = side(face, k);
        return {Plane{0, 0}, Plane{edge.length, 0}, Plane{edge.along, edge.off}};
    }

    void start_inside(const Point& source) {
        offset_ = 0;
        for (std::uint32_t k = 0; k < 3; ++k) {
            start_in(source.face, k, mix(k, laid_out(source.face, k), source));
        }
    }

    void start_at(std::uint32_t vertex, Number distance) {
        offset_ = distance;
        for (const std::uint32_t face : surface_.fans_[vertex]) {
            std::uint32_t k = 1; // Of the edge opposite to the vertex.
            while (surface_.corner(face, k + 2) != vertex) {
                ++k;
            }
            start_in(face, k, laid_out(face, k)[2]);
        }
    }

    /// From a place of the face, given in the frame of corner k, through the edge that begins
    /// there.
    void start_in(std::uint32_t face, std::uint32_t k, Plane origin) {
        std::array<Plane, 3> at = laid_out(face, k);
        for (Plane& p : at) {
            p = {p.x - origin.x, p.y - origin.y};
        }
        reach_targets(face, k, at);
        for (std::uint32_t i = 0; i < 3; ++i) {
            reach_vertex(surface_.corner(face, k + i), at[i]);
        }
        pass({face,
              surface_.corner(face, k),
              surface_.corner(face, k + 1),
              side(face, k).length,
              at[0],
              at[1],
              {1, 0}});
    }

    /// Returns true if the nearest point of the edge may be of use.
    bool in_reach(const Window& w) const {
        const Number foot = -(w.at_a.x * w.to_b.x + w.at_a.y * w.to_b.y);
        const Number along = std::clamp(foot, Number{0}, w.length);
        return offset_ + length({w.at_a.x + along * w.to_b.x, w.at_a.y + along * w.to_b.y}) <
               bound() + surface_.beside_;
    }

    /// Through the edge into the faces beyond it. No shortest path enters a face twice, as the
    /// straight line within the face is no longer; nor does one cross an edge without length, whose
    /// ends are one place.
    void pass(const Window& w) {
        if (!crosses_ || w.length == 0 || !in_reach(w) || !is_lit(w)) {
            return;
        }
        crossed_.push_back(w);
        entered_[w.face] = true;
        for (const std::uint32_t face : surface_.faces_.at(std::minmax(w.a, w.b))) {
            if (!entered_[face]) {
                enter(face, w);
            }
        }
        entered_[w.face] = false;
        crossed_.pop_back();
    }

    void enter(std::uint32_t face, const Window w) { // crossed_ moves.
        std::uint32_t k = 1;                         // Of the edge.
        while (surface_.corner(face, k + 2) == w.a || surface_.corner(face, k + 2) == w.b) {
            ++k;
        }
        const Side& edge = side(face, k);
        const bool from_a = surface_.corner(face, k) == w.a;
        const Number along = from_a ? edge.along : edge.back;
        const Number back = from_a ? edge.back : edge.along;
        const Plane from_a_to_c = turned(w.to_b, along, edge.off);
        const Plane at_c{w.at_a.x + from_a_to_c.x, w.at_a.y + from_a_to_c.y};
        reach_targets(face, k, {from_a ? w.at_a : w.at_b, from_a ? w.at_b : w.at_a, at_c});
        const std::uint32_t c = surface_.corner(face, k + 2);
        if (is_lit(at_c)) {
            reach_vertex(c, at_c);
        }
        const Number ac = side(face, from_a ? k + 2 : k + 1).length;
        const Number cb = side(face, from_a ? k + 1 : k + 2).length;
        pass({face, w.a, c, ac, w.at_a, at_c, turned(w.to_b, along / ac, edge.off / ac)});
        pass({face, c, w.b, cb, at_c, w.at_b, turned(w.to_b, back / cb, -edge.off / cb)});
    }

    /// The vector that goes so far along the edge and so far off it, beyond it.
    static Plane turned(Plane edge, Number along, Number off) {
        return {along * edge.x + off * edge.y, along * edge.y - off * edge.x};
    }

    const Unfolding& surface_;
    Number reach_;
    std::span<const Point> targets_;
    std::vector<Number> found_;
    std::vector<Number> vertices_; ///< Distances known so far.
    std::vector<bool> entered_;    ///< Faces of the straight line.
    std::map<std::uint32_t, std::vector<std::size_t>> by_face_;
    using Entry = std::pair<Number, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
    Number offset_ = 0;    ///< From the source to the origin.
    bool crosses_ = false; ///< Straight lines cross edges.
    Number edge_reach_ = kFar;
    std::vector<Window> crossed_; ///< By the straight line.
};

Unfolding::Unfolding(const TestMesh& mesh) : mesh_(mesh), fans_(mesh.vertex_count()) {
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            sides_.push_back(side_of(face, k));
            if (takes_part(face)) {
                faces_[std::minmax(corner(face, k), corner(face, k + 1))].push_back(face);
                fans_[corner(face, k)].push_back(face);
                beside_ = std::max(beside_, sides_.back().length * 0x1p-52L);
            }
        }
    }
}

bool Unfolding::takes_part(std::uint32_t face) const {
    return corner(face, 0) != corner(face, 1) && corner(face, 1) != corner(face, 2) &&
           corner(face, 2) != corner(face, 0);
}

Unfolding::Side Unfolding::side_of(std::uint32_t face, std::uint32_t k) const {
    const std::uint32_t a = corner(face, k), b = corner(face, k + 1), c = corner(face, k + 2);
    const auto dot = [&](std::uint32_t from, std::uint32_t to, std::uint32_t other) {
        Number sum = 0;
        for (std::size_t axis = 0; axis < mesh_.dimension; ++axis) {
            sum += (coordinate(to, axis) - coordinate(from, axis)) *
                   (coordinate(other, axis) - coordinate(from, axis));
        }
        return sum;
    };
    const Number square = dot(a, b, b), length = std::sqrt(square);
    if (square == 0) {
        return {0, 0, 0, std::sqrt(dot(a, c, c))};
    }
    // From the nearer end, so that a short side keeps its direction.
    const Number from_a = dot(a, b, c), from_b = dot(b, a, c);
    const bool is_near_a = dot(a, c, c) < dot(b, c, c);
    const std::uint32_t near = is_near_a ? a : b, far = is_near_a ? b : a;
    const Number part = (is_near_a ? from_a : from_b) / square;
    Number off = 0;
    for (std::size_t axis = 0; axis < mesh_.dimension; ++axis) {
        const Number d = (coordinate(c, axis) - coordinate(near, axis)) -
                         part * (coordinate(far, axis) - coordinate(near, axis));
        off += d * d;
    }
    return {length, from_a / length, from_b / length, std::sqrt(off)};
}

std::vector<double> Unfolding::distances(const Point& source, std::span<const Point> targets,
                                         double reach) const {
    return Search(*this, targets, reach).run(source);
}

} // namespace geodisk::test
