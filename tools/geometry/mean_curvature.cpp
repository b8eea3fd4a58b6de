#include "geometry/mean_curvature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

namespace geodisk::tools {
namespace {

/// The corner opposite to an edge of two vertices, the lower one first.
struct EdgeSide {
    std::uint32_t a, b;
};

/// Shape of a triangle, by corner; zeros for one without area.
struct Shape {
    std::array<double, 3> cotangents{}; ///< Cotangents of the angles.
    std::array<double, 3> areas{}; ///< The part of the area that is nearest, if none is obtuse.
};

class Laplacian {
    template <typename Values>
    auto coordinates(Values& values, std::size_t v) const {
        return std::span(values).subspan(v * mesh_.dimension, mesh_.dimension);
    }

  public:
    explicit Laplacian(const MeshFile& mesh)
        : mesh_(mesh), vertices_(mesh.positions.size() / mesh.dimension),
          sums_(mesh.positions.size(), 0.0), areas_(vertices_, 0.0) {
        for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
            add(t);
        }
    }

    double area(std::size_t v) const { return areas_[v]; }

    /// Half of the length of the Laplacian of the position.
    double curvature(std::size_t v) const {
        if (!(areas_[v] > 0)) {
            return 0;
        }
        double square = 0;
        for (const double x : coordinates(sums_, v)) {
            square += x * x;
        }
        // The sums are of cotangents, the Laplacian is half of that over the area.
        return std::sqrt(square) / (4 * areas_[v]);
    }

  private:
    Shape shape(std::size_t t) const {
        std::array<double, 3> squares{}; // Of the side opposite to each corner.
        for (std::size_t k = 0; k < 3; ++k) {
            const auto p = coordinates(mesh_.positions, mesh_.triangles[t + (k + 1) % 3]);
            const auto q = coordinates(mesh_.positions, mesh_.triangles[t + (k + 2) % 3]);
            for (std::size_t axis = 0; axis < p.size(); ++axis) {
                squares[k] += (p[axis] - q[axis]) * (p[axis] - q[axis]);
            }
        }
        const double longest = *std::max_element(squares.begin(), squares.end());
        const std::array<double, 3> products{(squares[1] + squares[2] - squares[0]) / 2,
                                             (squares[2] + squares[0] - squares[1]) / 2,
                                             (squares[0] + squares[1] - squares[2]) / 2};
        // The square of twice the area.
        const double square =
            products[0] * products[1] + products[1] * products[2] + products[2] * products[0];
        constexpr double kFlat = 1e-7; // Where rounding takes over.
        Shape result;
        if (!(square > kFlat * kFlat * longest * longest) || !std::isfinite(square)) {
            return result;
        }
        const double twice_area = std::sqrt(square);
        for (std::size_t k = 0; k < 3; ++k) {
            result.cotangents[k] = products[k] / twice_area;
        }
        const auto obtuse = std::min_element(products.begin(), products.end());
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
            result.areas[k] =
                *obtuse >= 0
                    ? (squares[i] * result.cotangents[i] + squares[j] * result.cotangents[j]) / 8
                : *obtuse == products[k] ? twice_area / 4
                                         : twice_area / 8;
        }
        return result;
    }

    void add(std::size_t t) {
        const Shape s = shape(t);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh_.triangles[t + (k + 1) % 3];
            const std::uint32_t b = mesh_.triangles[t + (k + 2) % 3];
            areas_[mesh_.triangles[t + k]] += s.areas[k];
            const auto p = coordinates(mesh_.positions, a);
            const auto q = coordinates(mesh_.positions, b);
            for (std::size_t axis = 0; axis < p.size(); ++axis) {
                const double pull = s.cotangents[k] * (q[axis] - p[axis]);
                coordinates(sums_, a)[axis] += pull;
                coordinates(sums_, b)[axis] -= pull;
            }
        }
    }

    const MeshFile& mesh_;
    std::size_t vertices_;
    std::vector<double> sums_; ///< Sums of cotangents times edges, `dimension` to a vertex.
    std::vector<double> areas_;
};

/// All edges as often as they have faces, sorted.
std::vector<EdgeSide> edge_sides(const MeshFile& mesh) {
    std::vector<EdgeSide> sides;
    sides.reserve(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
        if (!mesh.takes_part(t / 3)) {
            continue;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax(mesh.triangles[t + k], mesh.triangles[t + (k + 1) % 3]);
            sides.push_back({a, b});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const EdgeSide& x, const EdgeSide& y) {
        return x.a != y.a ? x.a < y.a : x.b < y.b;
    });
    return sides;
}

/// Gives the vertices on borders and such the mean of their neighbours inside.
void mend_borders(const std::vector<EdgeSide>& sides, std::vector<double>& curvatures) {
    std::vector<bool> is_border(curvatures.size(), false);
    for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
        while (end < sides.size() && sides[end].a == sides[i].a && sides[end].b == sides[i].b) {
            ++end;
        }
        if (end - i != 2) {
            is_border[sides[i].a] = true;
            is_border[sides[i].b] = true;
        }
    }
    std::vector<double> sums(curvatures.size(), 0.0);
    std::vector<std::uint32_t> counts(curvatures.size(), 0);
    const auto lend = [&](std::uint32_t from, std::uint32_t to) {
        if (is_border[to] && !is_border[from]) {
            sums[to] += curvatures[from];
            ++counts[to];
        }
    };
    for (const auto& [a, b] : sides) {
        lend(a, b);
        lend(b, a);
    }
    for (std::size_t v = 0; v < curvatures.size(); ++v) {
        if (is_border[v]) {
            curvatures[v] = counts[v] > 0 ? sums[v] / counts[v] : 0;
        }
    }
}

std::vector<double> mean_curvatures(const MeshFile& mesh, const Laplacian& laplacian) {
    std::vector<double> curvatures(mesh.positions.size() / mesh.dimension);
    for (std::size_t v = 0; v < curvatures.size(); ++v) {
        curvatures[v] = laplacian.curvature(v);
    }
    mend_borders(edge_sides(mesh), curvatures);
    return curvatures;
}

} // namespace

std::vector<double> mean_curvatures(const MeshFile& mesh) {
    return mean_curvatures(mesh, Laplacian(mesh));
}

std::vector<double> curvature_factors(const MeshFile& mesh) {
    const Laplacian laplacian(mesh);
    std::vector<double> factors = mean_curvatures(mesh, laplacian);
    double total = 0, area = 0;
    for (std::size_t v = 0; v < factors.size(); ++v) {
        total += laplacian.area(v) * factors[v];
        area += laplacian.area(v);
    }
    // Rounding bends a flat surface a little. A curvature this small turns it by a millionth over
    // its whole extent.
    constexpr double kFlat = 1e-6;
    const bool is_flat = !(total > kFlat * std::sqrt(area));
    for (double& factor : factors) {
        factor = is_flat ? 1 : 1 / (1 + factor * area / total);
    }
    return factors;
}

} // namespace geodisk::tools
