// An upper bound on distances, along edges, is lowered until no face has a gradient of more than 1.
// Then no path from the marked faces, where it is 0, is shorter than it.
#include "parts/halo.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

#include "mesh/slopes.hpp"

namespace geodisk {
namespace {

constexpr double kBeyond = 1.25;

/// Shortest ways along edges, no longer than `most`, which is the value of all other vertices.
std::vector<double> along_edges(const PreparedMesh& mesh, std::span<const std::uint8_t> is_marked,
                                double most) {
    const auto edges = mesh.half_edges();
    std::vector<double> distances(mesh.vertex_count(), most);
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> next;
    for (std::uint32_t h = 0; h < edges.size(); ++h) {
        if (is_marked[h / 3] != 0 && distances[edges[h].origin] > 0) {
            distances[edges[h].origin] = 0;
            next.emplace(0, edges[h].origin);
        }
    }
    while (!next.empty()) {
        const auto [distance, vertex] = next.top();
        next.pop();
        if (distance > distances[vertex]) {
            continue;
        }
        const VertexFan& fan = mesh.fans()[vertex];
        for (const std::uint32_t corner :
             mesh.corners().subspan(fan.first_corner, fan.corner_count)) {
            const std::uint32_t back = previous_in_face(corner);
            const std::pair<std::uint32_t, double> sides[] = {
                {edges[next_in_face(corner)].origin, edges[corner].length},
                {edges[back].origin, edges[back].length}};
            for (const auto& [other, length] : sides) {
                if (distance + length < distances[other]) {
                    distances[other] = distance + length;
                    next.emplace(distances[other], other);
                }
            }
        }
    }
    return distances;
}

} // namespace

std::vector<double> distances_from(const PreparedMesh& mesh,
                                   std::span<const std::uint8_t> is_marked, double reach) {
    std::vector<double> values = along_edges(mesh, is_marked, kBeyond * reach);
    for (double& value : values) {
        value /= -reach;
    }
    values = raised_to_slope(mesh, reach, std::move(values));
    for (double& value : values) {
        value *= -reach;
    }
    return values;
}

double nearest_corner(const PreparedMesh& mesh, std::span<const double> distances,
                      std::uint32_t face) {
    const auto edges = mesh.half_edges().subspan(std::size_t{3} * face, 3);
    return std::min(
        {distances[edges[0].origin], distances[edges[1].origin], distances[edges[2].origin]});
}

double farthest_corner(const PreparedMesh& mesh, std::span<const double> distances,
                       std::uint32_t face) {
    const auto edges = mesh.half_edges().subspan(std::size_t{3} * face, 3);
    return std::max(
        {distances[edges[0].origin], distances[edges[1].origin], distances[edges[2].origin]});
}

} // namespace geodisk
