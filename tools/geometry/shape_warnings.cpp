#include "geometry/shape_warnings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "geometry/vec.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

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

std::string digits_text(double steps) {
    const int digits = steps >= 10 ? static_cast<int>(std::log10(steps)) : 0;
    return digits == 0 ? "no digit"
                       : counted(static_cast<std::uint64_t>(digits), "digit", "digits");
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

void warn_of_slivers(MeshFile& mesh) {
    constexpr double kSliver = 1e-3; // Radians.
    constexpr std::uint64_t kFewest = 2, kOneIn = 100;
    Found slivers;
    std::uint64_t triangles = 0;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        if (mesh.takes_part(t)) {
            ++triangles;
            const double angle = smallest_angle(mesh, &mesh.triangles[3 * t]);
            if (angle > 0 && angle < kSliver) {
                slivers.add(t);
            }
        }
    }
    if (slivers.count >= kFewest && slivers.count * kOneIn > triangles) {
        add_warning(mesh.warnings, "slivers", slivers.count, mesh.name_of_triangle(slivers.first),
                    "",
                    "triangles are slivers, with an angle below 0.06 degrees: sampling takes "
                    "longer");
    }
}

void warn_of_far_origin(MeshFile& mesh) {
    constexpr double kFewestSteps = 1e3; // Across the mesh, of floats.
    double farthest = 0, diagonal = 0;
    for (std::size_t axis = 0; axis < mesh.dimension; ++axis) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            if (mesh.takes_part(i / 3)) {
                const double x =
                    mesh.positions[std::size_t{mesh.triangles[i]} * mesh.dimension + axis];
                low = std::min(low, x);
                high = std::max(high, x);
            }
        }
        farthest = std::max({farthest, -low, high});
        diagonal = std::hypot(diagonal, high - low);
    }
    const double times = farthest / diagonal;
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

} // namespace geodisk::tools
