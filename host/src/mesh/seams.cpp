#include "mesh/seams.hpp"

#include <algorithm>
#include <utility>

#include "mesh/connectivity.hpp"
#include "mesh/position_table.hpp"

namespace geodisk {
namespace {

/// Links the half-edges of each edge into a cycle.
std::vector<Link> linked_edges(const MeshView& mesh) {
    std::vector<Link> links(mesh.triangles.size());
    for (std::uint32_t h = 0; h < links.size(); ++h) {
        links[h] = {mesh.triangles[h], lone_half_edge(h), 0};
    }
    std::vector<VertexFan> fans(mesh.vertex_count());
    std::vector<std::uint32_t> corners;
    list_corners(mesh.triangles, fans, corners);
    EdgeLinker linker(links, static_cast<std::uint32_t>(fans.size()));
    for (std::uint32_t v = 0; v < fans.size(); ++v) {
        if (fans[v].corner_count > 0) {
            linker.link_at(v,
                           std::span(corners).subspan(fans[v].first_corner, fans[v].corner_count));
        }
    }
    return links;
}

/// Returns true for the lowest half-edge of an edge whose faces all have the same corners.
template <class Edge>
bool starts_edge_of_one_apex(std::span<const Edge> links, std::uint32_t h) {
    const std::uint32_t apex = links[previous_in_face(h)].origin;
    for (std::uint32_t g = around_half_edge(links[h].around); g != h;
         g = around_half_edge(links[g].around)) {
        if (g < h || links[previous_in_face(g)].origin != apex) {
            return false;
        }
    }
    return true;
}

template <class Edge>
std::vector<EdgeEnds> borders_of(const MeshView& mesh, std::span<const Edge> links) {
    std::vector<EdgeEnds> borders;
    for (std::uint32_t h = 0; h < links.size(); ++h) {
        if (starts_edge_of_one_apex(links, h) && takes_part(mesh.triangles.face(h / 3))) {
            borders.push_back({links[h].origin, links[next_in_face(h)].origin});
        }
    }
    return borders;
}

} // namespace

std::vector<EdgeEnds> border_edges(const MeshView& mesh) {
    const std::vector<Link> links = linked_edges(mesh);
    return borders_of(mesh, std::span(links));
}

std::vector<EdgeEnds> border_edges(const MeshView& mesh, std::span<const HalfEdge> half_edges) {
    return borders_of(mesh, half_edges);
}

std::vector<CoincidingEdge> coinciding_edges(const MeshView& mesh,
                                             std::span<const EdgeEnds> borders) {
    PositionTable table(mesh, std::min(2 * borders.size(), mesh.vertex_count()));
    std::vector<CoincidingEdge> edges;
    edges.reserve(borders.size());
    for (auto [from, to] : borders) {
        std::uint32_t first = table.first_at(from);
        std::uint32_t second = table.first_at(to);
        if (first > second) {
            std::swap(first, second);
            std::swap(from, to);
        }
        if (first != second) {
            edges.push_back({std::uint64_t{first} << 32 | second, from, to});
        }
    }
    std::sort(edges.begin(), edges.end());
    std::size_t kept = 0;
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        while (end < edges.size() && edges[end].places == edges[begin].places) {
            ++end;
        }
        for (std::size_t i = begin; i < end && end - begin > 1; ++i) {
            edges[kept++] = edges[i];
        }
    }
    edges.resize(kept);
    return edges;
}

} // namespace geodisk
