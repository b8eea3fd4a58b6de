#include "analysis/laplacian.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <unordered_map>

namespace geodisk::tools::analysis {
namespace {

/// Stiffness grows as the inverse of a triangle's height, and equations must keep their digits.
constexpr double kFlattest = 1e-6;

/// A triangle by the squares of its sides, each opposite to the corner of its number.
struct Triangle {
    std::array<double, 3> squares;
    double area;
};

/// Without area for one that is no part of the surface.
Triangle triangle_of(const HalfEdge& edge) {
    const double x = edge.apex_x, y = edge.apex_y, rest = edge.length - x;
    Triangle result{{rest * rest + y * y, x * x + y * y, edge.length * edge.length},
                    edge.length * y / 2};
    const double longest = *std::max_element(result.squares.begin(), result.squares.end());
    result.area = std::max(result.area, kFlattest * longest / 2);
    return result;
}

/// Sums over triangles, entry by entry.
struct Entries {
    std::vector<Eigen::Triplet<double>> stiffness, mass;

    void add(const Triangle& triangle, const std::uint32_t* nodes) {
        const auto& squares = triangle.squares;
        const double sum = squares[0] + squares[1] + squares[2];
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const auto a = static_cast<int>(nodes[(corner + 1) % 3]);
            const auto b = static_cast<int>(nodes[(corner + 2) % 3]);
            // Half the cotangent of the angle between the other two sides.
            const double weight = (sum - 2 * squares[corner]) / (8 * triangle.area);
            add_edge(stiffness, a, b, -weight, weight);
            add_edge(mass, a, b, triangle.area / 12, triangle.area / 12);
        }
    }

  private:
    static void add_edge(std::vector<Eigen::Triplet<double>>& entries, int a, int b, double across,
                         double along) {
        entries.emplace_back(a, b, across);
        entries.emplace_back(b, a, across);
        entries.emplace_back(a, a, along);
        entries.emplace_back(b, b, along);
    }
};

Eigen::SparseMatrix<double> matrix_of(const std::vector<Eigen::Triplet<double>>& entries,
                                      std::size_t size) {
    Eigen::SparseMatrix<double> matrix(static_cast<Eigen::Index>(size),
                                       static_cast<Eigen::Index>(size));
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

} // namespace

Laplacian make_laplacian(const PreparedMesh& mesh, std::span<const std::uint32_t> triangles) {
    Laplacian result;
    result.nodes.assign(triangles.size(), Laplacian::kNoNode);
    std::unordered_map<std::uint32_t, std::uint32_t> numbers;
    Entries entries;
    for (std::size_t first = 0; first < triangles.size(); first += 3) {
        const Triangle triangle = triangle_of(mesh.half_edges()[first]);
        if (!(triangle.area > 0)) {
            continue;
        }
        for (std::size_t corner = first; corner < first + 3; ++corner) {
            const auto next = static_cast<std::uint32_t>(numbers.size());
            result.nodes[corner] = numbers.try_emplace(triangles[corner], next).first->second;
        }
        entries.add(triangle, &result.nodes[first]);
        result.area += triangle.area;
    }
    result.stiffness = matrix_of(entries.stiffness, numbers.size());
    result.mass = matrix_of(entries.mass, numbers.size());
    return result;
}

} // namespace geodisk::tools::analysis
