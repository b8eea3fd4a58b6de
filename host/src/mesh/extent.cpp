#include "mesh/extent.hpp"

#include <algorithm>
#include <vector>

namespace geodisk {
namespace {

/// Returns the longest path from one vertex of each component to the others along edges of a
/// breadth-first tree.
double longest_tree_path(const PreparedMesh& mesh) {
    const auto half_edges = mesh.half_edges();
    std::vector<double> lengths(mesh.vertex_count(), -1);
    std::vector<std::uint32_t> queue;
    double longest = 0;
    for (std::uint32_t root = 0; root < mesh.vertex_count(); ++root) {
        if (lengths[root] >= 0) {
            continue;
        }
        lengths[root] = 0;
        queue.assign(1, root);
        for (std::size_t next = 0; next < queue.size(); ++next) {
            const std::uint32_t v = queue[next];
            const VertexFan& fan = mesh.fans()[v];
            for (const std::uint32_t corner :
                 mesh.corners().subspan(fan.first_corner, fan.corner_count)) {
                const std::uint32_t back = previous_in_face(corner);
                const std::pair<std::uint32_t, double> sides[] = {
                    {half_edges[next_in_face(corner)].origin, half_edges[corner].length},
                    {half_edges[back].origin, half_edges[back].length}};
                for (const auto& [other, length] : sides) {
                    if (lengths[other] < 0) {
                        lengths[other] = lengths[v] + length;
                        longest = std::max(longest, lengths[other]);
                        queue.push_back(other);
                    }
                }
            }
        }
    }
    return longest;
}

} // namespace

double distance_bound(const PreparedMesh& mesh) {
    // From a point to a vertex of its face, to the root, and the same way to the other point.
    return 2 * (longest_tree_path(mesh) + mesh.statistics().longest_edge);
}

} // namespace geodisk
