#include "engine/domain/vertex_bounds.hpp"

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace geodisk {
namespace {

/// Dijkstra's algorithm over the edges.
class EdgePaths {
  public:
    explicit EdgePaths(const PreparedMesh& mesh)
        : mesh_(mesh), bounds_(mesh.vertex_count(), std::numeric_limits<double>::infinity()) {}

    void begin_at(const Sample& point, double distance);
    std::vector<double> go();

  private:
    void lower(std::uint32_t vertex, double bound) {
        if (bound < bounds_[vertex]) {
            bounds_[vertex] = bound;
            queue_.emplace(bound, vertex);
        }
    }

    using Reached = std::pair<double, std::uint32_t>;
    const PreparedMesh& mesh_;
    std::vector<double> bounds_;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue_;
};

void EdgePaths::begin_at(const Sample& point, double distance) {
    const std::array<double, 3> corners = corner_distances(mesh_, point);
    for (std::uint32_t i = 0; i < 3; ++i) {
        lower(mesh_.half_edges()[std::size_t{3} * point.face + i].origin, distance + corners[i]);
    }
}

std::vector<double> EdgePaths::go() {
    const auto half_edges = mesh_.half_edges();
    while (!queue_.empty()) {
        const auto [bound, vertex] = queue_.top();
        queue_.pop();
        if (bound > bounds_[vertex]) {
            continue;
        }
        const VertexFan& fan = mesh_.fans()[vertex];
        for (const std::uint32_t corner :
             mesh_.corners().subspan(fan.first_corner, fan.corner_count)) {
            const std::uint32_t first = corner - corner % 3;
            const HalfEdge& after = half_edges[first + (corner + 1) % 3];
            const HalfEdge& before = half_edges[first + (corner + 2) % 3];
            lower(after.origin, bound + half_edges[corner].length);
            lower(before.origin, bound + before.length);
        }
    }
    return std::move(bounds_);
}

} // namespace

std::array<double, 3> corner_distances(const PreparedMesh& mesh, const Sample& point) {
    const HalfEdge& first = mesh.half_edges()[std::size_t{3} * point.face];
    const double second = point.weights[1], third = point.weights[2];
    const double x = second * first.length + third * first.apex_x;
    const double y = third * first.apex_y;
    return {std::hypot(x, y), std::hypot(x - first.length, y),
            std::hypot(x - first.apex_x, y - first.apex_y)};
}

std::vector<double> vertex_bounds(const PreparedMesh& mesh, std::span<const Sample> points,
                                  std::span<const float> distances) {
    EdgePaths paths(mesh);
    for (std::size_t i = 0; i < points.size(); ++i) {
        paths.begin_at(points[i], distances[i]);
    }
    return paths.go();
}

} // namespace geodisk
