#include "geometry/frames.hpp"

#include <bit>
#include <cmath>
#include <numbers>

#include <geodisk/detail/philox.hpp>

namespace geodisk::tools {

std::array<double, 4> frame_of(const Vec3& normal, double angle) {
    // The shortest rotation from z to the normal has no part about z. Opposite to z it is half a
    // turn about x.
    constexpr double kOpposite = 1e-12;
    double x = 1, y = 0, w = 0;
    if (1 + normal.z > kOpposite) {
        w = std::sqrt((1 + normal.z) / 2);
        x = -normal.y / (2 * w);
        y = normal.x / (2 * w);
    }
    if (length(normal) == 0) {
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

double frame_angle(std::uint64_t seed, std::uint32_t face, const float (&weights)[3]) {
    constexpr std::uint32_t kFrames = 0x66726d65; // Apart from the numbers of candidates.
    const auto random = philox(seed, {face, std::bit_cast<std::uint32_t>(weights[0]),
                                      std::bit_cast<std::uint32_t>(weights[1]), kFrames});
    return 2 * std::numbers::pi * random[0] * 0x1p-32;
}

} // namespace geodisk::tools
