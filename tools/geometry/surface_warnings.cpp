#include "geometry/surface_warnings.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>

#include <geodisk/weld.hpp>

#include "constants.h"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Edges, each known by the face of its lowest half-edge.
struct OddEdges {
    Found nonmanifold, turned;
};

OddEdges find_edges(const PreparedMesh& mesh) {
    OddEdges found;
    const std::span<const HalfEdge> edges = mesh.half_edges();
    for (std::uint32_t h = 0; h < edges.size(); ++h) {
        const std::uint32_t other = around_half_edge(edges[h].around);
        const bool is_pair = around_half_edge(edges[other].around) == h;
        if (other != h && is_pair && h < other && around_same_way(edges[h].around)) {
            found.turned.add(h / 3);
        } else if (!is_pair) {
            std::uint32_t lowest = h;
            for (std::uint32_t g = other; g != h; g = around_half_edge(edges[g].around)) {
                lowest = std::min(lowest, g);
            }
            if (lowest == h) {
                found.nonmanifold.add(h / 3);
            }
        }
    }
    return found;
}

/// Returns true if some faces at the vertex share no edge there with the others, not even by way of
/// other faces. `corners` are its half-edges, `sets` is for its memory.
bool is_bow_tie(std::span<const HalfEdge> edges, std::span<const std::uint32_t> corners,
                std::vector<std::uint32_t>& order, std::vector<std::uint32_t>& sets) {
    order.assign(corners.begin(), corners.end());
    std::sort(order.begin(), order.end());
    sets.resize(order.size());
    std::iota(sets.begin(), sets.end(), 0u);
    const auto root = [&](std::uint32_t i) {
        while (sets[i] != i) {
            i = sets[i] = sets[sets[i]];
        }
        return i;
    };
    std::size_t parts = order.size();
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        for (const std::uint32_t side : {order[i], previous_in_face(order[i])}) {
            const std::uint32_t other = around_half_edge(edges[side].around);
            const bool starts_here = edges[other].origin == edges[order[i]].origin;
            const std::uint32_t corner = starts_here ? other : next_in_face(other);
            const auto found = std::lower_bound(order.begin(), order.end(), corner);
            const std::uint32_t a = root(i);
            const std::uint32_t b = root(static_cast<std::uint32_t>(found - order.begin()));
            parts -= a != b ? 1u : 0u;
            sets[a] = b;
        }
    }
    return parts > 1;
}

Found find_bow_ties(const PreparedMesh& mesh) {
    Found found;
    std::vector<std::uint32_t> order, sets;
    for (std::uint32_t v = 0; v < mesh.fans().size(); ++v) {
        const VertexFan& fan = mesh.fans()[v];
        if (fan.corner_count > 1 && (fan.flags & gpu::kFanIrregular) != 0 &&
            is_bow_tie(mesh.half_edges(),
                       mesh.corners().subspan(fan.first_corner, fan.corner_count), order, sets)) {
            found.add(v);
        }
    }
    return found;
}

/// The number as --weld takes it, 1e-6 rather than 1e-06.
std::string weld_text(double epsilon) {
    std::string text = exact_text(epsilon);
    for (const std::string zero : {"e-0", "e+0"}) {
        if (const std::size_t at = text.find(zero); at != std::string::npos) {
            text.erase(at + 2, 1);
        }
    }
    return text;
}

} // namespace

void warn_of_near_seams(const MeshView& view, const MeshStatistics& statistics,
                        std::vector<MeshWarning>& warnings) {
    if (statistics.boundary_edges <= statistics.coinciding_border_edges) {
        return;
    }
    const NearSeams seams = take(find_near_seams(view));
    if (seams.edges == 0) {
        return;
    }
    const std::string dropped = seams.degenerate_faces > 0
                                    ? " and drops " +
                                          counted(seams.degenerate_faces, "triangle", "triangles") +
                                          " as narrow as that"
                                    : "";
    const std::string advice =
        seams.epsilon > 0
            ? "--weld=" + weld_text(seams.epsilon) + " joins them" + dropped
            : "The gap is too small for --weld beside the size of the mesh; give both sides the "
              "same coordinates";
    const std::string effect =
        ", up to " + rounded(seams.gap, 2) + " apart: spacing is not kept across them. " + advice;
    add_warning(warnings, "near_seams", seams.edges, "",
                "edge nearly coincides with another one but is not connected" + effect,
                "edges nearly coincide but are not connected" + effect);
}

std::vector<MeshWarning> surface_warnings(const MeshFile& file, const PreparedMesh& mesh,
                                          bool has_normals) {
    const MeshStatistics& statistics = mesh.statistics();
    std::vector<MeshWarning> warnings;
    const auto warn = [&](const char* kind, const Found& found, const std::string& first,
                          const std::string& one, const std::string& many) {
        add_warning(warnings, kind, found.count, first, one, many);
    };
    const auto face = [&file](const Found& found) {
        return found.count == 0 ? "" : file.name_of_triangle(found.first);
    };
    if (!file.lengths.empty()) { // Which the reader does not judge.
        add_warning(warnings, "zero_area_faces", statistics.zero_area_faces, "",
                    "triangle without area kept: paths may lead through it",
                    "triangles without area kept: paths may lead through them");
    }
    const OddEdges edges = find_edges(mesh);
    warn("nonmanifold_edges", edges.nonmanifold, face(edges.nonmanifold),
         "edge joins three or more faces; distances count paths across all of them",
         "edges join three or more faces; distances count paths across all of them");
    const Found ties = find_bow_ties(mesh);
    warn("bow_tie_vertices", ties, ties.count == 0 ? "" : file.names.of_vertex(ties.first),
         "vertex joins faces that share no edge there; paths lead through it",
         "vertices join faces that share no edge there; paths lead through them");
    const std::string effect =
        has_normals ? "; --lift normals pulls them apart" : "; distances do not depend on that";
    warn("inconsistent_orientation", edges.turned, face(edges.turned),
         "edge has faces turned over against each other" + effect,
         "edges have faces turned over against each other" + effect);
    if (statistics.components > 1) {
        add_warning(warnings, "components", statistics.components, "", "",
                    "components: no path leads from one to another");
    }
    const std::uint64_t unwelded = file.copied.empty() ? statistics.coinciding_border_edges : 0;
    add_warning(
        warnings, "unwelded", unwelded, "",
        "edge coincides with another one but is not connected: spacing is not kept across it. "
        "Leave out --keep-seams to join them",
        "edges coincide but are not connected: spacing is not kept across them. "
        "Leave out --keep-seams to join them");
    if (file.lengths.empty()) {
        warn_of_near_seams({file.positions, file.triangles, file.dimension}, statistics, warnings);
    }
    return warnings;
}

} // namespace geodisk::tools
