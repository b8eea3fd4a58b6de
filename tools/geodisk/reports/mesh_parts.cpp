#include "geodisk/reports/mesh_parts.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "mesh/vertex_sets.hpp"

namespace geodisk::tools {

std::uint64_t parts_without(std::span<const std::uint32_t> triangles,
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
    std::uint64_t without = 0;
    for (std::uint32_t v = 0; v < vertices; ++v) {
        without += is_used[v] && parts.lowest(v) == v && !has_one[v];
    }
    return without;
}

} // namespace geodisk::tools
