#include "mesh/edge_paths.hpp"

#include <cmath>
#include <cstddef>

namespace geodisk {

std::array<double, 3> corner_distances(const PreparedMesh& mesh, const Sample& point) {
    const HalfEdge& first = mesh.half_edges()[std::size_t{3} * point.face];
    const double second = point.weights[1], third = point.weights[2];
    const double x = second * first.length + third * first.apex_x;
    const double y = third * first.apex_y;
    return {std::hypot(x, y), std::hypot(x - first.length, y),
            std::hypot(x - first.apex_x, y - first.apex_y)};
}

void EdgePaths::begin_at(const Sample& point, double length) {
    const std::array<double, 3> corners = corner_distances(mesh_, point);
    for (std::uint32_t i = 0; i < 3; ++i) {
        begin_at(mesh_.half_edges()[std::size_t{3} * point.face + i].origin, length + corners[i]);
    }
}

const std::vector<double>& EdgePaths::lengths() {
    const auto edges = mesh_.half_edges();
    while (!queue_.empty()) {
        const auto [length, vertex] = queue_.top();
        queue_.pop();
        if (length > lengths_[vertex]) {
            continue;
        }
        const VertexFan& fan = mesh_.fans()[vertex];
        for (const std::uint32_t corner :
             mesh_.corners().subspan(fan.first_corner, fan.corner_count)) {
            const HalfEdge& before = edges[previous_in_face(corner)];
            begin_at(edges[next_in_face(corner)].origin, length + edges[corner].length);
            begin_at(before.origin, length + before.length);
        }
    }
    return lengths_;
}

} // namespace geodisk
