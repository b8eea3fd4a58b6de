#include "mesh/seams.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "mesh/connectivity.hpp"
#include "mesh/position_table.hpp"

namespace geodisk {
namespace {

/// A half-edge, by the other end of its edge than the vertex that is looked at.
struct Side {
    std::uint32_t other, half_edge;

    friend auto operator<=>(const Side&, const Side&) = default;
};

/// Finds the edges from a vertex to higher ones, given its corners, each by its half-edges.
void find_sides(const MeshView& mesh, std::uint32_t v, std::span<const std::uint32_t> corners,
                std::vector<Side>& sides) {
    sides.clear();
    for (const std::uint32_t corner : corners) {
        const std::uint32_t back = previous_in_face(corner);
        for (const auto& [end, half_edge] :
             {std::pair{next_in_face(corner), corner}, std::pair{back, back}}) {
            if (mesh.triangles[end] > v) {
                sides.push_back({mesh.triangles[end], half_edge});
            }
        }
    }
    std::ranges::sort(sides);
}

/// Returns the lowest half-edge of each edge whose faces all have the same corners, ascending.
std::vector<std::uint32_t> border_half_edges(const MeshView& mesh) {
    std::vector<VertexFan> fans(mesh.vertex_count());
    std::vector<std::uint32_t> corners, borders;
    list_corners(mesh.triangles, fans, corners);
    const auto apex = [&](const Side& side) {
        return mesh.triangles[previous_in_face(side.half_edge)];
    };
    std::vector<Side> sides;
    for (std::uint32_t v = 0; v < fans.size(); ++v) {
        find_sides(mesh, v, std::span(corners).subspan(fans[v].first_corner, fans[v].corner_count),
                   sides);
        for (auto begin = sides.begin(), end = begin; begin != sides.end(); begin = end) {
            bool has_one_apex = true;
            while (end != sides.end() && end->other == begin->other) {
                has_one_apex = has_one_apex && apex(*end) == apex(*begin);
                ++end;
            }
            if (has_one_apex) {
                borders.push_back(begin->half_edge);
            }
        }
    }
    std::ranges::sort(borders);
    return borders;
}

/// Returns true for the lowest half-edge of an edge whose faces all have the same corners.
bool starts_edge_of_one_apex(std::span<const HalfEdge> half_edges, std::uint32_t h) {
    const std::uint32_t apex = half_edges[previous_in_face(h)].origin;
    for (std::uint32_t g = around_half_edge(half_edges[h].around); g != h;
         g = around_half_edge(half_edges[g].around)) {
        if (g < h || half_edges[previous_in_face(g)].origin != apex) {
            return false;
        }
    }
    return true;
}

} // namespace

std::vector<EdgeEnds> border_edges(const MeshView& mesh) {
    std::vector<EdgeEnds> borders;
    for (const std::uint32_t h : border_half_edges(mesh)) {
        borders.push_back({mesh.triangles[h], mesh.triangles[next_in_face(h)]});
    }
    return borders;
}

std::vector<EdgeEnds> border_edges(const MeshView& mesh, std::span<const HalfEdge> half_edges) {
    std::vector<EdgeEnds> borders;
    for (std::uint32_t h = 0; h < half_edges.size(); ++h) {
        if (starts_edge_of_one_apex(half_edges, h) && takes_part(mesh.triangles.face(h / 3))) {
            borders.push_back({half_edges[h].origin, half_edges[next_in_face(h)].origin});
        }
    }
    return borders;
}

std::vector<CoincidingEdge> coinciding_edges(const MeshView& mesh,
                                             std::span<const EdgeEnds> borders) {
    PositionTable table(mesh);
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
