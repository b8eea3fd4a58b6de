#include "report/surface_data.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace geodisk::tools::report {
namespace {

using picture::CornerRec;

/// Steps of each coordinate of a normal, from -1 to 1.
constexpr double kNormalSteps = 65534;
constexpr std::uint32_t kNoNormal = 65535;

/// Two coordinates of 16 bits, the second one in front.
std::uint32_t packed_normal(const CornerRec& corner) {
    const double x = corner.normal_x, y = corner.normal_y, z = corner.normal_z;
    const double size = std::abs(x) + std::abs(y) + std::abs(z);
    if (!(size > 0)) {
        return kNoNormal << 16 | kNoNormal;
    }
    double u = x / size, v = y / size;
    if (z < 0) {
        const double folded = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
        v = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
        u = folded;
    }
    const auto steps = [](double part) {
        return static_cast<std::uint32_t>(std::lround((part + 1) / 2 * kNormalSteps));
    };
    return steps(v) << 16 | steps(u);
}

} // namespace

std::vector<PageArray> surface_arrays(const picture::Scene& scene,
                                      std::span<const std::uint32_t> triangles) {
    std::vector<std::uint32_t> normal_of;
    normal_of.reserve(scene.corners.size());
    for (const CornerRec& corner : scene.corners) {
        normal_of.push_back(packed_normal(corner));
    }
    std::vector<std::uint32_t> order(scene.corners.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](std::uint32_t corner) {
        return std::tuple(triangles[corner], normal_of[corner], corner);
    };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });

    std::vector<double> positions;
    std::vector<std::uint32_t> normals, point_of(scene.corners.size());
    std::uint32_t points = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::uint32_t corner = order[i];
        if (i == 0 || triangles[order[i - 1]] != triangles[corner] ||
            normal_of[order[i - 1]] != normal_of[corner]) {
            const glm::dvec3 at = scene.corner(corner);
            positions.insert(positions.end(), {at.x, at.y, at.z});
            normals.insert(normals.end(), {normal_of[corner] & 0xffff, normal_of[corner] >> 16});
            ++points;
        }
        point_of[corner] = points - 1;
    }
    return {rounded_numbers("positions", positions, -1, 1), whole_numbers("normals", normals),
            whole_numbers("corners", point_of)};
}

} // namespace geodisk::tools::report
