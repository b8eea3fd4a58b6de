#include "support/unfolding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

namespace geodisk::test {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
/// What may lie beside a window and count as inside, in squares of mesh units of about 1.
constexpr double kRounding = 1e-13;

} // namespace

/// What the origin sees through the edge from a to b of a face, b to the left: directions from
/// `right` to `left`.
struct Unfolding::Window {
    std::uint32_t face; ///< On the near side.
    std::uint32_t a, b;
    Plane at_a, at_b;
    Plane right, left;
};

/// One source: straight lines from it, then from each vertex that they meet, nearest first.
class Unfolding::Search {
  public:
    Search(const Unfolding& surface, std::span<const Point> targets, double reach)
        : surface_(surface), reach_(reach), targets_(targets), found_(targets.size(), kFar),
          vertices_(surface.fans_.size(), kFar) {
        for (std::size_t i = 0; i < targets.size(); ++i) {
            by_face_[targets[i].face].push_back(i);
        }
    }

    std::vector<double> run(const Point& source) {
        start_inside(source);
        while (!queue_.empty()) {
            const auto [distance, vertex] = queue_.top();
            queue_.pop();
            if (distance == vertices_[vertex]) {
                start_at(vertex, distance);
            }
        }
        return std::move(found_);
    }

  private:
    static double cross(Plane p, Plane q) { return p.x * q.y - p.y * q.x; }

    static Plane mix(std::array<Plane, 3> at, double w0, double w1, double w2) {
        return {w0 * at[0].x + w1 * at[1].x + w2 * at[2].x,
                w0 * at[0].y + w1 * at[1].y + w2 * at[2].y};
    }

    std::uint32_t corner(std::uint32_t face, std::uint32_t k) const {
        return surface_.mesh_.triangles[std::size_t{3} * face + k];
    }

    void reach_vertex(std::uint32_t vertex, Plane at) {
        const double distance = offset_ + std::hypot(at.x, at.y);
        if (distance < vertices_[vertex] && distance <= reach_) {
            vertices_[vertex] = distance;
            queue_.emplace(distance, vertex);
        }
    }

    /// The targets of a face whose corners lie at `at`, between two directions.
    void reach_targets(std::uint32_t face, const std::array<Plane, 3>& at, Plane right,
                       Plane left) {
        const auto own = by_face_.find(face);
        if (own == by_face_.end()) {
            return;
        }
        for (const std::size_t i : own->second) {
            const Point& t = targets_[i];
            const Plane p = mix(at, 1 - t.weight1 - t.weight2, t.weight1, t.weight2);
            const double distance = offset_ + std::hypot(p.x, p.y);
            if (cross(right, p) >= -kRounding && cross(p, left) >= -kRounding &&
                distance <= reach_) {
                found_[i] = std::min(found_[i], distance);
            }
        }
    }

    /// A face around the origin: everything in it is seen.
    void reach_all_targets(std::uint32_t face, const std::array<Plane, 3>& at) {
        reach_targets(face, at, {0, 0}, {0, 0});
    }

    /// The corners of a face with the first at the origin, counter-clockwise.
    std::array<Plane, 3> laid_out(std::uint32_t face) const {
        const std::uint32_t a = corner(face, 0), b = corner(face, 1), c = corner(face, 2);
        const double ab = surface_.length(a, b);
        const double ac = surface_.length(a, c);
        const double bc = surface_.length(b, c);
        const double x = (ab * ab + ac * ac - bc * bc) / (2 * ab);
        return {Plane{0, 0}, Plane{ab, 0}, Plane{x, std::sqrt(std::max(0.0, ac * ac - x * x))}};
    }

    void start_inside(const Point& source) {
        offset_ = 0;
        std::array<Plane, 3> at = laid_out(source.face);
        const Plane origin =
            mix(at, 1 - source.weight1 - source.weight2, source.weight1, source.weight2);
        for (Plane& p : at) {
            p = {p.x - origin.x, p.y - origin.y};
        }
        reach_all_targets(source.face, at);
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t next = (k + 1) % 3;
            reach_vertex(corner(source.face, k), at[k]);
            pass({source.face, corner(source.face, k), corner(source.face, next), at[k], at[next],
                  at[k], at[next]});
        }
    }

    void start_at(std::uint32_t vertex, double distance) {
        offset_ = distance;
        for (const std::uint32_t face : surface_.fans_[vertex]) {
            std::array<Plane, 3> at = laid_out(face);
            std::uint32_t k = 0;
            while (corner(face, k) != vertex) {
                ++k;
            }
            const Plane origin = at[k];
            for (Plane& p : at) {
                p = {p.x - origin.x, p.y - origin.y};
            }
            const std::uint32_t next = (k + 1) % 3, last = (k + 2) % 3;
            reach_all_targets(face, at);
            reach_vertex(corner(face, next), at[next]);
            reach_vertex(corner(face, last), at[last]);
            pass({face, corner(face, next), corner(face, last), at[next], at[last], at[next],
                  at[last]});
        }
    }

    /// Whether the nearest point of the edge is within reach.
    bool in_reach(const Window& w) const {
        const Plane along{w.at_b.x - w.at_a.x, w.at_b.y - w.at_a.y};
        const double square = along.x * along.x + along.y * along.y;
        const double t = std::clamp(-(w.at_a.x * along.x + w.at_a.y * along.y) / square, 0.0, 1.0);
        return offset_ + std::hypot(w.at_a.x + t * along.x, w.at_a.y + t * along.y) <= reach_;
    }

    /// Through the edge into the faces beyond it.
    void pass(const Window& w) {
        if (!in_reach(w)) {
            return;
        }
        for (const std::uint32_t face : surface_.faces_.at(std::minmax(w.a, w.b))) {
            if (face != w.face) {
                enter(face, w);
            }
        }
    }

    void enter(std::uint32_t face, const Window& w) {
        std::uint32_t k = 0;
        while (corner(face, k) == w.a || corner(face, k) == w.b) {
            ++k;
        }
        const std::uint32_t c = corner(face, k);
        const Plane at_c = surface_.beyond(w.a, w.at_a, w.b, w.at_b, c);
        std::array<Plane, 3> at{};
        for (std::uint32_t i = 0; i < 3; ++i) {
            at[i] = i == k ? at_c : corner(face, i) == w.a ? w.at_a : w.at_b;
        }
        reach_targets(face, at, w.right, w.left);
        const double from_right = cross(w.right, at_c);
        const double to_left = cross(at_c, w.left);
        if (from_right >= -kRounding && to_left >= -kRounding) {
            reach_vertex(c, at_c);
        }
        if (from_right > 0) {
            pass({face, w.a, c, w.at_a, at_c, w.right, to_left > 0 ? at_c : w.left});
        }
        if (to_left > 0) {
            pass({face, c, w.b, at_c, w.at_b, from_right > 0 ? at_c : w.right, w.left});
        }
    }

    const Unfolding& surface_;
    double reach_;
    std::span<const Point> targets_;
    std::vector<double> found_;
    std::vector<double> vertices_; ///< Distances known so far.
    std::map<std::uint32_t, std::vector<std::size_t>> by_face_;
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
    double offset_ = 0; ///< From the source to the origin.
};

Unfolding::Unfolding(const TestMesh& mesh) : mesh_(mesh), fans_(mesh.vertex_count()) {
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.triangles[3 * face + k];
            const std::uint32_t b = mesh.triangles[3 * face + (k + 1) % 3];
            faces_[std::minmax(a, b)].push_back(face);
            fans_[a].push_back(face);
        }
    }
}

double Unfolding::length(std::uint32_t a, std::uint32_t b) const {
    double sum = 0;
    for (std::size_t axis = 0; axis < mesh_.dimension; ++axis) {
        const double d = mesh_.positions[std::size_t{a} * mesh_.dimension + axis] -
                         mesh_.positions[std::size_t{b} * mesh_.dimension + axis];
        sum += d * d;
    }
    return std::sqrt(sum);
}

Unfolding::Plane Unfolding::beyond(std::uint32_t a, Plane at_a, std::uint32_t b, Plane at_b,
                                   std::uint32_t c) const {
    const double ab = length(a, b), ac = length(a, c), bc = length(b, c);
    const double along = (ab * ab + ac * ac - bc * bc) / (2 * ab);
    const double out = std::sqrt(std::max(0.0, ac * ac - along * along));
    const Plane e{(at_b.x - at_a.x) / ab, (at_b.y - at_a.y) / ab};
    return {at_a.x + along * e.x + out * e.y, at_a.y + along * e.y - out * e.x};
}

std::vector<double> Unfolding::distances(const Point& source, std::span<const Point> targets,
                                         double reach) const {
    return Search(*this, targets, reach).run(source);
}

} // namespace geodisk::test
