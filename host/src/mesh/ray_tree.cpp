#include "mesh/ray_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace geodisk {
namespace {

constexpr std::uint32_t kLeaf = 4; ///< Triangles that are not divided further.
/// Nodes that wait: one for each level of a tree whose halves are equal.
constexpr std::size_t kDepth = 64;

/// Returns true if a ray meets a box. `inverse` is 1 over each component of its direction.
bool meets(const Vec& low, const Vec& high, const Vec& origin, const Vec& inverse) {
    double begin = 0, end = HUGE_VAL;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double a = (low[axis] - origin[axis]) * inverse[axis];
        const double b = (high[axis] - origin[axis]) * inverse[axis];
        begin = std::max(begin, std::min(a, b)); // A NaN, of a ray along the side, changes nothing.
        end = std::min(end, std::max(a, b));
    }
    return begin <= end * (1 + 0x1p-50);
}

} // namespace

RayTree::RayTree(std::span<const std::array<Vec, 3>> triangles) {
    std::vector<std::uint32_t> order(triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    nodes_.reserve(triangles.size());
    build(triangles, order, 0);
    triangles_.reserve(triangles.size());
    for (const std::uint32_t t : order) {
        const auto& [a, b, c] = triangles[t];
        triangles_.push_back({a, b - a, c - a});
    }
}

std::uint32_t RayTree::build(std::span<const std::array<Vec, 3>> triangles,
                             std::span<std::uint32_t> order, std::uint32_t begin) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    const Vec first = triangles[order.front()][0];
    Node node{first, first, begin, begin + static_cast<std::uint32_t>(order.size()), 0};
    for (const std::uint32_t t : order) {
        for (const Vec& point : triangles[t]) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                node.low[axis] = std::min(node.low[axis], point[axis]);
                node.high[axis] = std::max(node.high[axis], point[axis]);
            }
        }
    }
    nodes_.push_back(node);
    if (order.size() <= kLeaf) {
        return index;
    }
    const Vec sides = node.high - node.low;
    const auto axis = static_cast<std::size_t>(std::ranges::max_element(sides) - sides.begin());
    const auto middle_of = [&](std::uint32_t t) {
        return triangles[t][0][axis] + triangles[t][1][axis] + triangles[t][2][axis];
    };
    const std::size_t half = order.size() / 2;
    std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
                     [&](auto a, auto b) { return middle_of(a) < middle_of(b); });
    build(triangles, order.first(half), begin);
    const std::uint32_t right =
        build(triangles, order.subspan(half), begin + static_cast<std::uint32_t>(half));
    nodes_[index].right = right;
    return index;
}

bool RayTree::is_met(const Vec& origin, const Vec& direction, double least) const {
    const Vec inverse{1 / direction[0], 1 / direction[1], 1 / direction[2]};
    std::array<std::uint32_t, kDepth> open{};
    for (std::size_t waiting = 1; waiting > 0;) {
        const std::uint32_t index = open[--waiting];
        const Node& node = nodes_[index];
        if (!meets(node.low, node.high, origin, inverse)) {
            continue;
        }
        if (node.right != 0) {
            open[waiting++] = node.right;
            open[waiting++] = index + 1;
            continue;
        }
        // Moeller and Trumbore 1997.
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
            const Triangle& t = triangles_[i];
            const Vec across = cross(direction, t.to_third);
            const double determinant = dot(t.to_second, across);
            const Vec from = origin - t.corner;
            const double u = dot(from, across) / determinant;
            const Vec normal = cross(from, t.to_second);
            const double v = dot(direction, normal) / determinant;
            // All comparisons fail for a ray in the plane of the triangle.
            if (u >= 0 && v >= 0 && u + v <= 1 && dot(t.to_third, normal) / determinant > least) {
                return true;
            }
        }
    }
    return false;
}

} // namespace geodisk
