#include "geometry/vertex_numbers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "geometry/weld_mesh.hpp"

namespace geodisk::tools {
namespace {

/// Returns the length of the edge from corner `k` of a triangle to the next.
double edge_length(const MeshFile& mesh, std::size_t triangle, std::size_t k) {
    if (!mesh.lengths.empty()) {
        return mesh.lengths[3 * triangle + k];
    }
    const std::uint32_t* const corners = &mesh.triangles[3 * triangle];
    const double* const a = &mesh.positions[std::size_t{corners[k]} * mesh.dimension];
    const double* const b = &mesh.positions[std::size_t{corners[(k + 1) % 3]} * mesh.dimension];
    double length = 0;
    for (std::size_t axis = 0; axis < mesh.dimension; ++axis) {
        length = std::hypot(length, b[axis] - a[axis]);
    }
    return length;
}

/// Returns the area by Heron's formula, in the form that needles do not disturb.
double area_of(const MeshFile& mesh, std::size_t triangle) {
    std::array<double, 3> l{edge_length(mesh, triangle, 0), edge_length(mesh, triangle, 1),
                            edge_length(mesh, triangle, 2)};
    std::ranges::sort(l);
    const auto [c, b, a] = l;
    return 0.25 *
           std::sqrt(std::max((a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c)), 0.0));
}

/// Means at vertices, of which values may count more or less.
class Means {
  public:
    explicit Means(std::size_t vertices) : sums_(vertices, 0.0), weights_(vertices, 0.0) {}

    void add(std::uint32_t vertex, double value, double weight) {
        sums_[vertex] += weight * value;
        weights_[vertex] += weight;
    }

    std::vector<double> take() && {
        for (std::size_t v = 0; v < sums_.size(); ++v) {
            sums_[v] = weights_[v] > 0 ? sums_[v] / weights_[v] : 1;
        }
        return std::move(sums_);
    }

  private:
    std::vector<double> sums_, weights_;
};

std::vector<double> means_of_faces(const MeshFile& mesh, const MeshField& number, Means means) {
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        for (std::size_t k = 3 * t; mesh.takes_part(t) && k < 3 * t + 3; ++k) {
            means.add(mesh.triangles[k], number.values[mesh.value_index(number, k)],
                      area_of(mesh, t));
        }
    }
    return std::move(means).take();
}

/// Each value counts once at a vertex, however many corners have it.
std::vector<double> means_of_corners(const MeshFile& mesh, const MeshField& number, Means means) {
    std::vector<std::pair<std::uint32_t, double>> found; // Vertex and value.
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
        if (mesh.takes_part(k / 3)) {
            found.emplace_back(mesh.triangles[k], number.values[number.corners[k]]);
        }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    for (const auto& [vertex, value] : found) {
        means.add(vertex, value, 1);
    }
    return std::move(means).take();
}

} // namespace

std::vector<double> vertex_numbers(const MeshFile& mesh, const MeshField& number) {
    if (number.of == MeshField::Of::vertices) {
        return values_at_vertices(mesh, number.values);
    }
    const bool of_faces = number.of == MeshField::Of::faces;
    return (of_faces ? means_of_faces : means_of_corners)(mesh, number, Means(mesh.vertex_count()));
}

} // namespace geodisk::tools
