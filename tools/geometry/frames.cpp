#include "geometry/frames.hpp"

#include <bit>
#include <cmath>
#include <numbers>

#include <geodisk/detail/philox.hpp>

namespace geodisk::tools {

namespace {

constexpr double kOpposite = 1e-12; ///< A cosine so close to -1 is half a turn.

/// Returns `v` with the axes exchanged in a circle, so that the axis `from` becomes z.
Vec3 with_z_from(Up from, const Vec3& v) {
    return from == Up::z ? v : from == Up::x ? Vec3{v.y, v.z, v.x} : Vec3{v.z, v.x, v.y};
}

/// Returns the vector of which with_z_from() makes `v`.
Vec3 with_z_to(Up to, const Vec3& v) {
    return to == Up::z ? v : to == Up::x ? Vec3{v.z, v.x, v.y} : Vec3{v.y, v.z, v.x};
}

/// Returns the unit vector that is a part of the shortest way from z to `normal`. Half a turn goes
/// about x.
Vec3 part_of_way(const Vec3& normal, double part) {
    if (length(normal) == 0) {
        return {0, 0, 1};
    }
    const double across = std::hypot(normal.x, normal.y);
    const double angle = part * std::atan2(across, normal.z);
    const Vec3 side = 1 + normal.z > kOpposite
                          ? (across > 0 ? Vec3{normal.x / across, normal.y / across, 0} : Vec3{})
                          : Vec3{0, -1, 0};
    return {std::sin(angle) * side.x, std::sin(angle) * side.y, std::cos(angle)};
}

/// Returns the direction of the model's up axis.
Vec3 up_of(const Vec3& normal, const FrameStyle& style) {
    return style.has_world()
               ? with_z_to(style.world, part_of_way(with_z_from(style.world, normal), style.part))
               : normal;
}

/// Returns a quaternion that turns by `angle` about z, and then z to the unit vector `up`; zero
/// counts as z.
std::array<double, 4> turn_of_z(const Vec3& up, double angle) {
    // The shortest rotation from z has no part about z. Opposite to z it is half a turn about x.
    double x = 1, y = 0, w = 0;
    if (1 + up.z > kOpposite) {
        w = std::sqrt((1 + up.z) / 2);
        x = -up.y / (2 * w);
        y = up.x / (2 * w);
    }
    if (length(up) == 0) {
        x = y = 0;
        w = 1;
    }
    const double s = std::sin(angle / 2), c = std::cos(angle / 2);
    const std::array<double, 4> turned{x * c + y * s, y * c - x * s, w * s, w * c};
    const double size =
        std::hypot(std::hypot(turned[0], turned[1]), std::hypot(turned[2], turned[3]));
    const double scale = (turned[3] < 0 ? -1 : 1) / size;
    return {turned[0] * scale, turned[1] * scale, turned[2] * scale, turned[3] * scale};
}

} // namespace

std::array<double, 4> frame_of(const Vec3& normal, double angle, const FrameStyle& style) {
    const auto [x, y, z, w] = turn_of_z(with_z_from(style.model, up_of(normal, style)), angle);
    const Vec3 axis = with_z_to(style.model, {x, y, z});
    return {axis.x, axis.y, axis.z, w};
}

double frame_angle(std::uint64_t seed, std::uint32_t face, const float (&weights)[3]) {
    constexpr std::uint32_t kFrames = 0x66726d65; // Apart from the numbers of candidates.
    const auto random = philox(seed, {face, std::bit_cast<std::uint32_t>(weights[0]),
                                      std::bit_cast<std::uint32_t>(weights[1]), kFrames});
    return 2 * std::numbers::pi * random[0] * 0x1p-32;
}

} // namespace geodisk::tools
