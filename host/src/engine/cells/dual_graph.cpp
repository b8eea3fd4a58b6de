#include "engine/cells/dual_graph.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

#include <geodisk/detail/vertex_sets.hpp>

namespace geodisk {
namespace {

using Edge = std::array<std::uint32_t, 2>;
using Triangle = std::array<std::uint32_t, 3>;

Edge edge_between(std::uint32_t a, std::uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

/// Calls `work(first, end)` for each run of equal keys.
template <class Items, class Key, class Work>
void for_runs(const Items& items, const Key& key, const Work& work) {
    for (std::size_t first = 0; first < items.size();) {
        std::size_t end = first + 1;
        while (end < items.size() && key(items[end]) == key(items[first])) {
            ++end;
        }
        work(first, end);
        first = end;
    }
}

std::int64_t euler_of(const PreparedMesh& mesh) {
    const auto edges = mesh.half_edges();
    std::int64_t count = 0;
    for (std::uint32_t h = 0; h < edges.size(); ++h) {
        const std::uint32_t corner = h - h % 3;
        const std::uint32_t a = edges[corner].origin, b = edges[corner + 1].origin,
                            c = edges[corner + 2].origin;
        if (a == b || b == c || c == a) {
            continue; // Such faces are ignored.
        }
        count += h % 3 == 0 ? 1 : 0; // The face.
        bool is_first = true;
        for (std::uint32_t other = around_half_edge(edges[h].around); other != h && is_first;
             other = around_half_edge(edges[other].around)) {
            is_first = other > h;
        }
        count -= is_first ? 1 : 0; // The edge.
    }
    return count + static_cast<std::int64_t>(mesh.statistics().vertices);
}

/// Tells which triangles have only edges with one or two triangles, and corners with one fan.
std::uint64_t count_manifold(std::span<const Triangle> triangles, std::size_t samples) {
    // Sides, and the corners of triangles at their ends. Sides of one edge join these.
    struct Side {
        Edge edge;
        std::uint32_t triangle, corner; ///< The corner where it starts in the triangle.
    };
    std::vector<Side> sides;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            sides.push_back({edge_between(triangles[t][k], triangles[t][(k + 1) % 3]), t, k});
        }
    }
    std::ranges::sort(sides, {}, [](const Side& side) {
        return std::tuple(side.edge, side.triangle, side.corner);
    });
    const auto corner_at = [&](const Side& side, std::uint32_t sample) {
        const bool is_start = triangles[side.triangle][side.corner] == sample;
        return 3 * side.triangle + (is_start ? side.corner : (side.corner + 1) % 3);
    };
    VertexSets fans(3 * triangles.size());
    std::vector<std::uint8_t> is_faulty(samples, 0), is_wrong(triangles.size(), 0);
    for_runs(
        sides, [](const Side& side) { return side.edge; },
        [&](std::size_t first, std::size_t end) {
            for (std::size_t i = first; i < end; ++i) {
                if (end - first > 2) {
                    is_wrong[sides[i].triangle] = 1;
                }
                for (const std::uint32_t sample : sides[i].edge) {
                    fans.join(corner_at(sides[first], sample), corner_at(sides[i], sample));
                }
            }
        });
    std::vector<std::uint32_t> fan_of(samples, ~0u);
    for (std::uint32_t corner = 0; corner < 3 * triangles.size(); ++corner) {
        const std::uint32_t sample = triangles[corner / 3][corner % 3];
        const std::uint32_t fan = fans.lowest(corner);
        if (fan_of[sample] != ~0u && fan_of[sample] != fan) {
            is_faulty[sample] = 1;
        }
        fan_of[sample] = fan;
    }
    std::uint64_t count = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto [a, b, c] = triangles[t];
        if (is_wrong[t] + is_faulty[a] + is_faulty[b] + is_faulty[c] == 0) {
            ++count;
        }
    }
    return count;
}

} // namespace

std::vector<Triangle> dual_triangles(std::vector<Meeting> meetings, std::vector<KnotEnd> ends,
                                     std::uint32_t knots) {
    std::ranges::sort(ends);
    VertexSets whole(knots);
    for (std::size_t i = 1; i < ends.size(); ++i) {
        if (ends[i].point == ends[i - 1].point) {
            whole.join(ends[i].knot, ends[i - 1].knot);
        }
    }
    for (Meeting& meeting : meetings) {
        meeting.knot = whole.lowest(meeting.knot);
    }
    const auto place_of = [](const Meeting& meeting) {
        return std::tuple(meeting.samples, meeting.knot);
    };
    std::ranges::sort(meetings, {}, place_of);
    std::vector<Triangle> triangles;
    for_runs(meetings, place_of, [&](std::size_t first, std::size_t end) {
        std::ptrdiff_t turns = 0;
        for (std::size_t i = first; i < end; ++i) {
            turns += meetings[i].turns_back ? -1 : 1;
        }
        if ((end - first) % 2 == 1) {
            const auto [a, b, c] = meetings[first].samples;
            triangles.push_back(turns > 0 ? Triangle{a, b, c} : Triangle{a, c, b});
        }
    });
    return triangles;
}

std::vector<Edge> dual_edges(std::vector<Edge> pairs, std::span<const Triangle> triangles) {
    for (const auto& [a, b, c] : triangles) {
        pairs.push_back(edge_between(a, b));
        pairs.push_back(edge_between(b, c));
        pairs.push_back(edge_between(c, a));
    }
    std::ranges::sort(pairs);
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

DualReport dual_report(const PreparedMesh& mesh, const SurfaceCells& cells) {
    DualReport report;
    report.vertices = static_cast<std::uint64_t>(
        std::ranges::count_if(cells.areas, [](double area) { return area > 0; }));
    report.edges = cells.edges.size();
    report.triangles = cells.triangles.size();
    report.manifold = count_manifold(cells.triangles, cells.areas.size());
    report.euler = static_cast<std::int64_t>(report.vertices + report.triangles) -
                   static_cast<std::int64_t>(report.edges);
    report.mesh_euler = euler_of(mesh);
    return report;
}

} // namespace geodisk
