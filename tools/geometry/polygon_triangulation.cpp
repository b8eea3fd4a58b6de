#include "geometry/polygon_triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "geometry/vec.hpp"

namespace geodisk::tools {
namespace {

/// Twice the signed area of triangle a b c.
double turn(Vec2 a, Vec2 b, Vec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Turns below this are straight; the projected polygon is about 1 wide.
constexpr double kStraight = 1e-14;

/// Corners relative to the first and scaled to about 1, so that products neither overflow nor
/// vanish. The scale is a power of two: no coordinate is rounded by it.
std::vector<Vec3> normalized_corners(std::vector<Vec3> points) {
    double largest = 0;
    for (const Vec3& p : points) {
        largest = std::max(largest, largest_coordinate(p));
    }
    // First to at most 1/4 so that the difference of two corners cannot overflow.
    int exponent = 0;
    std::frexp(largest, &exponent);
    const auto scaled = [](Vec3 p, int by) {
        return Vec3{std::ldexp(p.x, by), std::ldexp(p.y, by), std::ldexp(p.z, by)};
    };
    const Vec3 origin = scaled(points[0], -exponent - 2);
    double extent = 0;
    for (Vec3& p : points) {
        p = scaled(p, -exponent - 2) - origin;
        extent = std::max(extent, largest_coordinate(p));
    }
    std::frexp(extent, &exponent);
    for (Vec3& p : points) {
        p = scaled(p, -exponent);
    }
    return points;
}

/// The polygon seen along the axis nearest to its Newell normal, counter-clockwise. Dropping a
/// coordinate instead of rotating keeps the others exact and maps a planar polygon one to one.
std::vector<Vec2> project(const std::vector<Vec3>& points) {
    Vec3 normal;
    for (std::size_t i = 0; i < points.size(); ++i) {
        normal += cross(points[i], points[(i + 1) % points.size()]);
    }
    const Vec3 size = abs(normal);
    std::vector<Vec2> projected;
    projected.reserve(points.size());
    for (const Vec3& p : points) {
        if (size.z >= size.x && size.z >= size.y) {
            projected.push_back(normal.z < 0 ? Vec2{p.y, p.x} : Vec2{p.x, p.y});
        } else if (size.x >= size.y) {
            projected.push_back(normal.x < 0 ? Vec2{p.z, p.y} : Vec2{p.y, p.z});
        } else {
            projected.push_back(normal.y < 0 ? Vec2{p.x, p.z} : Vec2{p.z, p.x});
        }
    }
    return projected;
}

bool is_fan(const std::vector<Vec2>& points) {
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        if (turn(points[0], points[i], points[i + 1]) <= kStraight) {
            return false;
        }
    }
    return true;
}

/// Cuts ears until three corners are left.
///
/// Ears are remembered: cutting one changes the corners beside it only, so n corners, r of them not
/// convex, take O(n r) steps.
class EarClipper {
  public:
    explicit EarClipper(const std::vector<Vec2>& points)
        : points_(points), count_(points.size()), previous_(count_), next_(count_),
          is_convex_(count_), is_ear_(count_) {
        for (std::size_t i = 0; i < count_; ++i) {
            previous_[i] = i == 0 ? count_ - 1 : i - 1;
            next_[i] = i + 1 == count_ ? 0 : i + 1;
        }
        find_ears(0);
    }

    /// Calls emit(a, b, c) with the polygon's corner numbers of each triangle.
    template <typename Emit>
    void run(const Emit& emit) {
        std::size_t corner = 1;
        while (count_ > 3) {
            corner = find_corner_to_cut(corner);
            emit(previous_[corner], corner, next_[corner]);
            corner = cut(corner); // Going on behind the ear walks around the polygon.
        }
        emit(previous_[corner], corner, next_[corner]);
    }

  private:
    double bend(std::size_t i) const {
        return turn(points_[previous_[i]], points_[i], points_[next_[i]]);
    }

    /// The first ear from `start` on; else, for straight runs and polygons that cross themselves,
    /// the corner that bends least.
    std::size_t find_corner_to_cut(std::size_t start) {
        if (const std::size_t ear = walk_to_ear(start); is_ear_[ear]) {
            return ear;
        }
        // Cutting a straight corner may free an ear anywhere.
        if (cut_straight_) {
            find_ears(start);
            cut_straight_ = false;
            if (const std::size_t ear = walk_to_ear(start); is_ear_[ear]) {
                return ear;
            }
        }
        std::size_t straightest = start;
        for (std::size_t i = next_[start]; i != start; i = next_[i]) {
            if (std::abs(bend(i)) < std::abs(bend(straightest))) {
                straightest = i;
            }
        }
        cut_straight_ = std::abs(bend(straightest)) <= kStraight;
        return straightest;
    }

    std::size_t walk_to_ear(std::size_t start) const {
        std::size_t i = start;
        while (!is_ear_[i] && next_[i] != start) {
            i = next_[i];
        }
        return i;
    }

    /// Takes corner `i` out and returns the one after it.
    std::size_t cut(std::size_t i) {
        const std::size_t before = previous_[i];
        const std::size_t after = next_[i];
        next_[before] = after;
        previous_[after] = before;
        --count_;
        is_convex_[before] = bend(before) > kStraight;
        is_convex_[after] = bend(after) > kStraight;
        is_ear_[before] = is_ear(before);
        is_ear_[after] = is_ear(after);
        return after;
    }

    void find_ears(std::size_t start) {
        std::size_t i = start;
        do {
            is_convex_[i] = bend(i) > kStraight;
            i = next_[i];
        } while (i != start);
        do {
            is_ear_[i] = is_ear(i);
            i = next_[i];
        } while (i != start);
    }

    /// A convex corner whose triangle holds no other corner in it or on it; if it held any, it
    /// would hold one that is not convex. A corner at the same place as one of the triangle's is
    /// no obstacle: polygons with a bridge to a hole have such pairs.
    bool is_ear(std::size_t i) const {
        if (!is_convex_[i]) {
            return false;
        }
        const Vec2 a = points_[previous_[i]];
        const Vec2 b = points_[i];
        const Vec2 c = points_[next_[i]];
        for (std::size_t other = next_[i]; other != i; other = next_[other]) {
            const Vec2 p = points_[other];
            if (!is_convex_[other] && p != a && p != b && p != c && turn(a, b, p) >= 0 &&
                turn(b, c, p) >= 0 && turn(c, a, p) >= 0) {
                return false;
            }
        }
        return true;
    }

    const std::vector<Vec2>& points_;
    std::size_t count_; ///< Corners left, linked by previous_ and next_.
    std::vector<std::size_t> previous_;
    std::vector<std::size_t> next_;
    std::vector<bool> is_convex_;
    std::vector<bool> is_ear_;
    bool cut_straight_ = false; ///< Since the last find_ears().
};

using Coordinates = std::vector<double>;

double dot(const Coordinates& a, const Coordinates& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Corners relative to the first, in units of the largest coordinate.
std::vector<Coordinates> relative_corners(std::span<const double> positions,
                                          std::uint32_t dimension,
                                          std::span<const std::uint32_t> corners) {
    const auto coordinates = [&](std::uint32_t vertex) {
        return positions.subspan(std::size_t{vertex} * dimension, dimension);
    };
    double largest = 0;
    for (const std::uint32_t vertex : corners) {
        for (const double x : coordinates(vertex)) {
            largest = std::max(largest, std::abs(x));
        }
    }
    const double unit = largest > 0 ? largest : 1;
    std::vector<Coordinates> points;
    for (const std::uint32_t vertex : corners) {
        Coordinates& point = points.emplace_back(dimension);
        for (std::size_t axis = 0; axis < dimension; ++axis) {
            point[axis] = coordinates(vertex)[axis] / unit - coordinates(corners[0])[axis] / unit;
        }
    }
    return points;
}

/// The unit vector along the longest of `points`, whose part along it is then taken off all of
/// them and returned; zeros when all are zero.
Coordinates take_axis(std::vector<Coordinates>& points) {
    const auto longest = std::max_element(
        points.begin(), points.end(),
        [](const Coordinates& a, const Coordinates& b) { return dot(a, a) < dot(b, b); });
    const double size = std::sqrt(dot(*longest, *longest));
    Coordinates along(points.size(), 0.0);
    if (size == 0) {
        return along;
    }
    Coordinates axis = *longest;
    for (double& x : axis) {
        x /= size;
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        along[i] = dot(points[i], axis);
        for (std::size_t k = 0; k < axis.size(); ++k) {
            points[i][k] -= along[i] * axis[k];
        }
    }
    return along;
}

/// x y 0 of each corner in a plane through the polygon, about 1 wide. A planar polygon keeps its
/// shape up to scale; of another one this is a projection.
std::vector<Vec3> flattened_polygon(std::span<const double> positions, std::uint32_t dimension,
                                    std::span<const std::uint32_t> corners) {
    std::vector<Coordinates> points = relative_corners(positions, dimension, corners);
    const Coordinates x = take_axis(points);
    const Coordinates y = take_axis(points);
    std::vector<Vec3> flat;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        flat.emplace_back(x[i], y[i], 0.0);
    }
    return flat;
}

std::vector<Vec3> corners_in_space(std::span<const double> positions, std::uint32_t dimension,
                                   std::span<const std::uint32_t> corners) {
    if (dimension > 3) {
        return flattened_polygon(positions, dimension, corners);
    }
    std::vector<Vec3> points;
    for (const std::uint32_t vertex : corners) {
        points.push_back(point_at(positions, vertex));
    }
    return points;
}

} // namespace

void triangulate_polygon(std::span<const double> positions, std::span<const std::uint32_t> corners,
                         std::vector<std::uint32_t>& triangles, std::uint32_t dimension) {
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
    const std::vector<Vec2> points =
        project(normalized_corners(corners_in_space(positions, dimension, corners)));
    if (is_fan(points)) {
        for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
            emit(0, i, i + 1);
        }
        return;
    }
    EarClipper(points).run(emit);
}

} // namespace geodisk::tools
