#include "common/polygon_triangulation.hpp"

#include "common/vec3.hpp"

#include <algorithm>
#include <cstddef>

namespace geodisk::tools {

namespace {

struct Point2 {
    double x;
    double y;
    friend bool operator==(Point2, Point2) = default;
};

/// Twice the signed area of triangle a b c.
double turn(Point2 a, Point2 b, Point2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Turns below this are straight; the projected polygon is about 1 wide.
constexpr double kStraight = 1e-14;

/// Corners relative to the first and scaled to about 1, so that products neither overflow nor
/// vanish. The scale is a power of two: no coordinate is rounded by it.
std::vector<Vec3> normalized_corners(std::span<const double> positions,
                                     std::span<const std::uint32_t> corners) {
    const auto corner_position = [&](std::uint32_t vertex) {
        const double* p = &positions[3 * std::size_t{vertex}];
        return Vec3{p[0], p[1], p[2]};
    };
    double largest = 0;
    for (const std::uint32_t vertex : corners) {
        const Vec3 p = corner_position(vertex);
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    // First to at most 1/4 so that the difference of two corners cannot overflow.
    int exponent = 0;
    std::frexp(largest, &exponent);
    const auto scaled = [](Vec3 p, int by) {
        return Vec3{std::ldexp(p.x, by), std::ldexp(p.y, by), std::ldexp(p.z, by)};
    };
    const Vec3 origin = scaled(corner_position(corners[0]), -exponent - 2);
    std::vector<Vec3> points;
    double extent = 0;
    for (const std::uint32_t vertex : corners) {
        const Vec3 p = scaled(corner_position(vertex), -exponent - 2) - origin;
        extent = std::max({extent, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        points.push_back(p);
    }
    std::frexp(extent, &exponent);
    for (Vec3& p : points) {
        p = scaled(p, -exponent);
    }
    return points;
}

/// The polygon seen along the axis nearest to its Newell normal, counter-clockwise. Dropping a
/// coordinate instead of rotating keeps the others exact and maps a planar polygon one to one.
std::vector<Point2> project(const std::vector<Vec3>& points) {
    Vec3 normal;
    for (std::size_t i = 0; i < points.size(); ++i) {
        normal = normal + cross(points[i], points[(i + 1) % points.size()]);
    }
    const Vec3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    std::vector<Point2> projected;
    projected.reserve(points.size());
    for (const Vec3& p : points) {
        if (size.z >= size.x && size.z >= size.y) {
            projected.push_back(normal.z < 0 ? Point2{p.y, p.x} : Point2{p.x, p.y});
        } else if (size.x >= size.y) {
            projected.push_back(normal.x < 0 ? Point2{p.z, p.y} : Point2{p.y, p.z});
        } else {
            projected.push_back(normal.y < 0 ? Point2{p.x, p.z} : Point2{p.z, p.x});
        }
    }
    return projected;
}

bool is_fan(const std::vector<Point2>& points) {
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        if (turn(points[0], points[i], points[i + 1]) <= kStraight) {
            return false;
        }
    }
    return true;
}

/// Cuts ears until three corners are left.
class EarClipper {
  public:
    explicit EarClipper(const std::vector<Point2>& points) : points_(points) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            rest_.push_back(i);
        }
    }

    /// Calls emit(a, b, c) with the polygon's corner numbers of each triangle.
    template <typename Emit>
    void run(const Emit& emit) {
        std::size_t ear = 1;
        while (rest_.size() > 3) {
            ear = find_ear(ear % rest_.size());
            emit(previous(ear), rest_[ear], next(ear));
            // The ear's successor moves into its place, so the cuts walk around the polygon.
            rest_.erase(rest_.begin() + static_cast<std::ptrdiff_t>(ear));
        }
        emit(rest_[0], rest_[1], rest_[2]);
    }

  private:
    std::size_t previous(std::size_t i) const { return rest_[i == 0 ? rest_.size() - 1 : i - 1]; }
    std::size_t next(std::size_t i) const { return rest_[i + 1 == rest_.size() ? 0 : i + 1]; }

    double corner_turn(std::size_t i) const {
        return turn(points_[previous(i)], points_[rest_[i]], points_[next(i)]);
    }

    /// The first proper ear from `start` on; else, for straight runs and polygons that cross
    /// themselves, the corner that bends least.
    std::size_t find_ear(std::size_t start) const {
        std::size_t straightest = start;
        for (std::size_t step = 0; step < rest_.size(); ++step) {
            const std::size_t i = (start + step) % rest_.size();
            const double bend = corner_turn(i);
            if (bend > kStraight && is_empty(i)) {
                return i;
            }
            if (std::abs(bend) < std::abs(corner_turn(straightest))) {
                straightest = i;
            }
        }
        return straightest;
    }

    /// No other corner lies in or on the triangle that cutting corner `i` makes. A corner at the
    /// same place as one of the triangle's is no obstacle: polygons with a bridge to a hole have
    /// such pairs.
    bool is_empty(std::size_t i) const {
        const Point2 a = points_[previous(i)];
        const Point2 b = points_[rest_[i]];
        const Point2 c = points_[next(i)];
        return std::none_of(rest_.begin(), rest_.end(), [&](std::size_t other) {
            const Point2 p = points_[other];
            return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 &&
                   turn(c, a, p) >= 0;
        });
    }

    const std::vector<Point2>& points_;
    std::vector<std::size_t> rest_; ///< Corner numbers not yet cut off, in order.
};

} // namespace

void triangulate_polygon(std::span<const double> positions, std::span<const std::uint32_t> corners,
                         std::vector<std::uint32_t>& triangles) {
    const auto emit = [&](std::size_t a, std::size_t b, std::size_t c) {
        triangles.insert(triangles.end(), {corners[a], corners[b], corners[c]});
    };
    if (corners.size() == 3) {
        emit(0, 1, 2);
        return;
    }
    if (corners.size() < 3) {
        return;
    }
    const std::vector<Point2> points = project(normalized_corners(positions, corners));
    if (is_fan(points)) {
        for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
            emit(0, i, i + 1);
        }
        return;
    }
    EarClipper(points).run(emit);
}

} // namespace geodisk::tools
