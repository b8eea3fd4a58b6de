#include "geodisk/reports/mesh_parts.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "mesh/vertex_sets.hpp"

namespace geodisk::tools {

BareParts parts_without(const PreparedMesh& mesh, std::span<const std::uint32_t> triangles,
                        std::span<const std::uint32_t> faces) {
    const std::uint32_t vertices = triangles.empty() ? 0 : std::ranges::max(triangles) + 1;
    VertexSets parts(vertices);
    std::vector<bool> is_used(vertices);
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
        const auto [a, b, c] = std::array{triangles[i], triangles[i + 1], triangles[i + 2]};
        if (a != b && b != c && c != a) {
            parts.join(a, b);
            parts.join(b, c);
            is_used[a] = is_used[b] = is_used[c] = true;
        }
    }
    std::vector<bool> has_one(vertices);
    for (const std::uint32_t face : faces) {
        has_one[parts.lowest(triangles[std::size_t{3} * face])] = true;
    }
    BareParts bare;
    for (std::uint32_t v = 0; v < vertices; ++v) {
        bare.count += is_used[v] && parts.lowest(v) == v && !has_one[v];
    }
    double area = 0;
    for (std::size_t i = 0; bare.count > 0 && i < triangles.size(); i += 3) {
        const HalfEdge& edge = mesh.half_edges()[i];
        area += has_one[parts.lowest(triangles[i])] ? 0 : 0.5 * edge.length * edge.apex_y;
    }
    bare.area_share = area > 0 ? area / mesh.statistics().area : 0;
    return bare;
}

} // namespace geodisk::tools
