#include "geometry/mesh_parts.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <geodisk/vertex_sets.hpp>

namespace geodisk::tools {

BareParts parts_without(const PreparedMesh& mesh, std::span<const std::uint32_t> faces) {
    const std::span<const HalfEdge> edges = mesh.half_edges();
    const auto vertices = static_cast<std::uint32_t>(mesh.fans().size());
    VertexSets parts(vertices);
    std::vector<bool> is_used(vertices);
    for (std::size_t i = 0; i < edges.size(); i += 3) {
        const auto [a, b, c] =
            std::array{edges[i].origin, edges[i + 1].origin, edges[i + 2].origin};
        if (a != b && b != c && c != a) {
            parts.join(a, b);
            parts.join(b, c);
            is_used[a] = is_used[b] = is_used[c] = true;
        }
    }
    std::vector<bool> has_one(vertices);
    for (const std::uint32_t face : faces) {
        has_one[parts.lowest(edges[std::size_t{3} * face].origin)] = true;
    }
    BareParts bare;
    for (std::uint32_t v = 0; v < vertices; ++v) {
        bare.count += is_used[v] && parts.lowest(v) == v && !has_one[v];
    }
    double area = 0;
    for (std::size_t i = 0; bare.count > 0 && i < edges.size(); i += 3) {
        const bool is_bare = !has_one[parts.lowest(edges[i].origin)];
        area += is_bare ? 0.5 * edges[i].length * edges[i].apex_y : 0;
    }
    bare.area_share = area > 0 ? area / mesh.statistics().area : 0;
    return bare;
}

} // namespace geodisk::tools
