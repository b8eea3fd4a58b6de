#include "geometry/shape_warnings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "geometry/vec.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Returns true if the triangle is more than a line or point, up to rounding, at any scale.
bool has_area(const MeshFile& mesh, const std::uint32_t* corner) {
    const auto coordinate = [&](int k, std::size_t axis) {
        return mesh.positions[std::size_t{corner[k]} * mesh.dimension + axis];
    };
    double largest = 0;
    for (std::size_t axis = 0; axis < mesh.dimension; ++axis) {
        for (int k = 0; k < 3; ++k) {
            largest = std::max(largest, std::abs(coordinate(k, axis)));
        }
    }
    if (largest == 0) {
        return false;
    }
    std::array<double, kMaxCoordinates> longer{}, shorter{}; // Two sides.
    double longer2 = 0, shorter2 = 0, product = 0;
    for (std::size_t axis = 0; axis < mesh.dimension; ++axis) {
        const double a = 1 / largest * coordinate(0, axis);
        longer[axis] = 1 / largest * coordinate(1, axis) - a;
        shorter[axis] = 1 / largest * coordinate(2, axis) - a;
        longer2 += longer[axis] * longer[axis];
        shorter2 += shorter[axis] * shorter[axis];
        product += longer[axis] * shorter[axis];
    }
    if (longer2 < shorter2) {
        std::swap(longer, shorter);
        std::swap(longer2, shorter2);
    }
    double height2 = 0; // Of the shorter side above the longer one.
    for (std::size_t axis = 0; axis < mesh.dimension && longer2 > 0; ++axis) {
        const double part = shorter[axis] - product / longer2 * longer[axis];
        height2 += part * part;
    }
    constexpr double kFlat = 1e-15; // Less height is the rounding of coordinates, which are <= 1.
    return height2 > kFlat * kFlat;
}

/// Smallest angle of a triangle in radians, 0 without area.
double smallest_angle(const MeshFile& mesh, const std::uint32_t* corner) {
    double a2 = 0, b2 = 0, c2 = 0; // Squares of its sides, in units of the longest coordinate.
    std::array<double, kMaxCoordinates> ab{}, ac{};
    double largest = 0;
    const auto coordinate = [&](int k, std::size_t axis) {
        return mesh.positions[std::size_t{corner[k]} * mesh.dimension + axis];
    };
    for (std::size_t axis = 0; axis < mesh.dimension; ++axis) {
        ab[axis] = coordinate(1, axis) - coordinate(0, axis);
        ac[axis] = coordinate(2, axis) - coordinate(0, axis);
        largest = std::max({largest, std::abs(ab[axis]), std::abs(ac[axis])});
    }
    double product = 0;
    for (std::size_t axis = 0; axis < mesh.dimension && largest > 0; ++axis) {
        const double x = ab[axis] / largest, y = ac[axis] / largest;
        c2 += x * x;
        b2 += y * y;
        a2 += (x - y) * (x - y);
        product += x * y;
    }
    double square = 0; // Of twice the area: by the part of one side across the other.
    for (std::size_t axis = 0; axis < mesh.dimension && c2 > 0; ++axis) {
        const double part = ac[axis] / largest - product / c2 * (ab[axis] / largest);
        square += part * part * c2;
    }
    const double longer_two = a2 * b2 * c2 / std::min({a2, b2, c2}); // Product of their squares.
    return longer_two > 0 ? std::asin(std::min(1.0, std::sqrt(square / longer_two))) : 0;
}

/// Returns true for a triangle in space that clearly has an area and is no sliver, as nearly all
/// are.
bool is_plain(const double* a, const double* b, const double* c) {
    const Vec3 p{a[0], a[1], a[2]}, q{b[0], b[1], b[2]}, r{c[0], c[1], c[2]};
    const Vec3 normal = cross(q - p, r - p);
    const double sides[] = {dot(q - p, q - p), dot(r - p, r - p), dot(r - q, r - q)};
    const double shortest = std::min({sides[0], sides[1], sides[2]});
    const double longest = std::max({sides[0], sides[1], sides[2]});
    double largest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        largest = std::max({largest, std::abs(a[axis]), std::abs(b[axis]), std::abs(c[axis])});
    }
    // Far above the bounds of smallest_angle() and has_area(). Squares that underflow or overflow
    // meet neither.
    constexpr double kSine2 = 1e-5, kHeight2 = 1e-24;
    const double area2 = dot(normal, normal); // The square of twice the area.
    return area2 * shortest > kSine2 * (sides[0] * sides[1] * sides[2]) &&
           area2 > kHeight2 * (largest * largest) * longest;
}

std::string digits_text(double steps) {
    const int digits = steps >= 10 ? static_cast<int>(std::log10(steps)) : 0;
    return digits == 0 ? "no digit"
                       : counted(static_cast<std::uint64_t>(digits), "digit", "digits");
}

/// Adds a warning where more than 1 % of the triangles are slivers.
void warn_of_slivers(const TriangleShapes& shapes, MeshFile& mesh) {
    constexpr std::uint64_t kFewest = 2, kOneIn = 100;
    const Found& slivers = shapes.slivers;
    const std::uint64_t triangles = shapes.with_area.count + shapes.without_area.count;
    if (slivers.count >= kFewest && slivers.count * kOneIn > triangles) {
        add_warning(mesh.warnings, "slivers", slivers.count, mesh.name_of_triangle(slivers.first),
                    "",
                    "triangles are slivers, with an angle below 0.06 degrees: sampling takes "
                    "longer");
    }
}

/// Adds a warning where coordinates are so far from the origin that floats lose the shape.
void warn_of_far_origin(const TriangleShapes& shapes, MeshFile& mesh) {
    constexpr double kFewestSteps = 1e3; // Across the mesh, of floats.
    const double times = shapes.farthest / shapes.diagonal;
    const double float_steps = 0x1p23 / times, double_steps = 0x1p52 / times;
    if (!(float_steps < kFewestSteps)) {
        return;
    }
    const bool is_double_short = double_steps < 1e6;
    mesh.warnings.push_back(
        {"far_from_origin",
         1,
         "",
         "coordinates are " + rounded(times, 2) +
             " times as far from the origin as the mesh is large: " +
             (is_double_short ? "64-bit floats keep " + digits_text(double_steps)
                              : "32-bit floats keep " + digits_text(float_steps)) +
             " of its shape. Move it to the origin",
         {}});
}

} // namespace

double unevenness(std::span<const double> positions, std::uint32_t dimension,
                  std::span<const std::uint32_t> corners) {
    if (dimension != 3 || corners.size() < 4) {
        return 0;
    }
    const double count = static_cast<double>(corners.size());
    Vec3 centre, low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (const std::uint32_t v : corners) {
        const Vec3 p = point_at(positions, v);
        centre += p / count;
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const double size = length(high - low);
    if (!(size > 0) || !std::isfinite(size)) {
        return 0;
    }
    const auto corner = [&](std::size_t k) {
        return (point_at(positions, corners[k % corners.size()]) - centre) / size;
    };
    Vec3 normal;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        normal += cross(corner(k), corner(k + 1));
    }
    double largest = 0;
    for (std::size_t k = 0; k < corners.size() && length(normal) > 0; ++k) {
        largest = std::max(largest, std::abs(dot(corner(k), normalize(normal))));
    }
    return largest;
}

TriangleShapes shapes_of(const MeshFile& mesh) {
    constexpr double kSliver = 1e-3; // Radians.
    TriangleShapes shapes;
    std::array<double, kMaxCoordinates> low{}, high{};
    low.fill(HUGE_VAL);
    high.fill(-HUGE_VAL);
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        if (!mesh.takes_part(t)) {
            continue;
        }
        const std::uint32_t* const corner = &mesh.triangles[3 * t];
        const auto place = [&](std::size_t k) {
            return &mesh.positions[std::size_t{corner[k]} * mesh.dimension];
        };
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t axis = 0; axis < mesh.dimension; ++axis) {
                low[axis] = std::min(low[axis], place(k)[axis]);
                high[axis] = std::max(high[axis], place(k)[axis]);
            }
        }
        if (mesh.dimension == 3 && is_plain(place(0), place(1), place(2))) {
            shapes.with_area.add(t);
            continue;
        }
        (has_area(mesh, corner) ? shapes.with_area : shapes.without_area).add(t);
        if (const double angle = smallest_angle(mesh, corner); angle > 0 && angle < kSliver) {
            shapes.slivers.add(t);
        }
    }
    for (std::size_t axis = 0; axis < mesh.dimension; ++axis) {
        shapes.farthest = std::max({shapes.farthest, -low[axis], high[axis]});
        shapes.diagonal = std::hypot(shapes.diagonal, high[axis] - low[axis]);
    }
    return shapes;
}

void warn_of_shapes(const TriangleShapes& shapes, MeshFile& mesh) {
    warn_of_slivers(shapes, mesh);
    warn_of_far_origin(shapes, mesh);
}

} // namespace geodisk::tools
