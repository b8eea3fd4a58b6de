#include "mesh/connect.hpp"

#include <algorithm>

#include "mesh/vertex_fans.hpp"
#include "support/blocks.hpp"
#include "support/prefetch.hpp"

namespace geodisk {

std::vector<std::uint32_t> connect(const ThreadOptions& threads, IndexView triangles,
                                   std::span<Link> links, std::span<HalfEdge> half_edges,
                                   std::vector<VertexFan>& fans,
                                   std::vector<std::uint32_t>& corners,
                                   MeshStatistics& statistics) {
    list_corners(triangles, fans, corners);
    EdgeLinker linker(links, static_cast<std::uint32_t>(fans.size()));
    FanBuilder builder(links);
    constexpr std::size_t kAhead = 32; // Number of corners, of about six vertices.
    for (std::uint32_t v = 0; v < fans.size(); ++v) {
        VertexFan& fan = fans[v];
        if (fan.corner_count > 0) {
            ++statistics.vertices;
            const std::span own(corners.data() + fan.first_corner, fan.corner_count);
            const std::size_t ahead = fan.first_corner + kAhead;
            for (std::size_t i = ahead; i < std::min(ahead + own.size(), corners.size()); ++i) {
                const std::uint32_t first = corners[i] - corners[i] % 3;
                prefetch(&links[first]);
                prefetch(&links[first + 2]); // The links of a face may lie in two cache lines.
            }
            linker.link_at(v, own);
            builder.build(v, own, fan); // The links are in the cache now.
        }
    }
    linker.count(statistics);
    for_blocks(threads, half_edges.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t h = begin; h < end; ++h) {
            half_edges[h].around = links[h].around;
            half_edges[h].fan_angles = links[h].angle;
        }
    });
    return linker.take_borders();
}

} // namespace geodisk
