// RayTree: a tree of boxes over triangles in space, which tells whether a ray meets any.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace geodisk {

/// A point or direction in space.
using Vec = std::array<double, 3>;

constexpr Vec operator-(const Vec& a, const Vec& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

constexpr double dot(const Vec& a, const Vec& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

constexpr Vec cross(const Vec& a, const Vec& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

class RayTree {
  public:
    /// Makes a tree over triangles, at least one, which are copied.
    explicit RayTree(std::span<const std::array<Vec, 3>> triangles);

    /// Returns true if a ray meets a triangle at more than `least` times `direction` from its
    /// origin.
    bool is_met(const Vec& origin, const Vec& direction, double least) const;

  private:
    struct Triangle {
        Vec corner, to_second, to_third;
    };
    struct Node {
        Vec low, high;
        std::uint32_t begin, end; ///< Of triangles_, for a leaf.
        std::uint32_t right;      ///< The left child is the next node; 0 for a leaf.
    };

    std::uint32_t build(std::span<const std::array<Vec, 3>> triangles,
                        std::span<std::uint32_t> order, std::uint32_t begin);

    std::vector<Triangle> triangles_; ///< In the order of the leaves.
    std::vector<Node> nodes_;
};

} // namespace geodisk
