#include "mesh/seams.hpp"

#include <algorithm>
#include <vector>

#include "mesh/position_table.hpp"

namespace geodisk {

std::uint64_t count_coinciding(const MeshView& mesh, std::span<const HalfEdge> half_edges,
                               std::span<const std::uint32_t> borders) {
    PositionTable places(mesh, std::min(2 * borders.size(), mesh.vertex_count()));
    std::vector<std::uint64_t> ends;
    ends.reserve(borders.size());
    for (const std::uint32_t h : borders) {
        const std::uint32_t from = places.first_at(half_edges[h].origin);
        const std::uint32_t to = places.first_at(half_edges[next_in_face(h)].origin);
        ends.push_back(std::uint64_t{std::min(from, to)} << 32 | std::max(from, to));
    }
    std::sort(ends.begin(), ends.end());
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        count +=
            (i > 0 && ends[i - 1] == ends[i]) || (i + 1 < ends.size() && ends[i + 1] == ends[i]);
    }
    return count;
}

} // namespace geodisk
