#include "picture/box_frame.hpp"

#include <cmath>
#include <cstdint>

namespace geodisk::tools::picture {
namespace {

/// Half the width of a bar, of the box's diagonal.
constexpr double kBar = 0.0015;

/// Appends the cuboid between two corners.
void add_cuboid(const std::array<double, 3>& low, const std::array<double, 3>& high,
                std::vector<double>& positions, std::vector<std::uint32_t>& triangles) {
    const auto first = static_cast<std::uint32_t>(positions.size() / 3);
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            positions.push_back((corner >> axis & 1) != 0 ? high[axis] : low[axis]);
        }
    }
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t across = 1u << (axis + 1) % 3, along = 1u << (axis + 2) % 3;
        for (const std::uint32_t side : {0u, 1u << axis}) {
            const std::uint32_t a = first + side, b = a + across, c = a + along, d = b + along;
            triangles.insert(triangles.end(), {a, b, c, d, c, b});
        }
    }
}

} // namespace

BoxFrame::BoxFrame(const BoxParams& box, double radius) {
    double diagonal = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        middle_[axis] = box.extents[axis] / 2;
        diagonal = std::hypot(diagonal, box.extents[axis]);
    }
    std::vector<double> positions;
    std::vector<std::uint32_t> triangles;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::uint32_t side = 0; side < 4; ++side) {
            std::array<double, 3> low, high;
            for (std::size_t other = 0; other < 3; ++other) {
                const bool is_far = (side >> ((other + 2 - axis) % 3) & 1) != 0;
                const double at = is_far ? box.extents[other] : 0;
                low[other] = (other == axis ? 0 : at) - kBar * diagonal;
                high[other] = (other == axis ? box.extents[other] : at) + kBar * diagonal;
            }
            add_cuboid(low, high, positions, triangles);
        }
    }
    scene_ = make_scene(positions, 3, triangles);
    scene_.around = radius * scene_.scale;
    const auto faces = static_cast<std::uint32_t>(triangles.size() / 3);
    for (std::uint32_t face = 0; face < faces; ++face) {
        table_.faces.push_back({1, 0, 1, 0, 1, 1, 1, face});
    }
    table_.starts.assign(std::size_t{faces} + 1, 0);
}

BallRec BoxFrame::ball(const std::array<double, 3>& at, double radius, std::uint32_t color) const {
    const auto place = [&](std::size_t axis) {
        return static_cast<float>((at[axis] - middle_[axis]) * scene_.scale);
    };
    return {place(0), place(1), place(2), static_cast<float>(radius * scene_.scale), color};
}

} // namespace geodisk::tools::picture
