// Parts of a mesh: some of its faces, in their order, and the radii there.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "geodisk/mesh.hpp"
#include "geodisk/radius_field.hpp"
#include "mesh/connect.hpp"
#include "mesh/face_frames.hpp"
#include "mesh/vertex_fans.hpp"
#include "support/blocks.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

Result<Done> check_faces(std::span<const std::uint32_t> faces, std::uint32_t count) {
    if (faces.empty()) {
        return invalid("a part of a mesh has at least one face");
    }
    for (std::size_t i = 0; i < faces.size(); ++i) {
        if (faces[i] >= count) {
            return invalid("face " + std::to_string(faces[i]) +
                           " of the part does not exist; the "
                           "mesh has " +
                           std::to_string(count));
        }
        if (i > 0 && faces[i] <= faces[i - 1]) {
            return invalid("the faces of a part must ascend, but " + std::to_string(faces[i]) +
                           " follows " + std::to_string(faces[i - 1]));
        }
    }
    return Done{};
}

/// Returns the vertices of the faces, ascending.
std::vector<std::uint32_t> vertices_of(std::span<const HalfEdge> half_edges) {
    std::vector<std::uint32_t> vertices;
    vertices.reserve(half_edges.size());
    for (const HalfEdge& edge : half_edges) {
        vertices.push_back(edge.origin);
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

/// Adds what the faces have by themselves to the statistics.
void measure_faces(std::span<const HalfEdge> half_edges, MeshStatistics& statistics) {
    const std::size_t faces = half_edges.size() / 3;
    std::vector<double> areas(faces);
    std::vector<MeshStatistics> blocks(block_count(faces));
    for (std::size_t f = 0; f < faces; ++f) {
        HalfEdge edges[3];
        std::copy_n(half_edges.begin() + static_cast<std::ptrdiff_t>(3 * f), 3, edges);
        const bool is_used = takes_part({edges[0].origin, edges[1].origin, edges[2].origin});
        areas[f] = add_face(is_used, edges, blocks[f / kBlock]);
    }
    sum_up(areas, blocks, statistics);
}

/// Copies three values per face.
std::vector<float> corners_of(std::span<const float> values, std::span<const std::uint32_t> faces) {
    std::vector<float> some;
    if (values.empty()) {
        return some;
    }
    some.reserve(3 * faces.size());
    for (const std::uint32_t face : faces) {
        const auto first = values.begin() + static_cast<std::ptrdiff_t>(std::size_t{3} * face);
        some.insert(some.end(), first, first + 3);
    }
    return some;
}

} // namespace

Result<PreparedMesh> PreparedMesh::part(std::span<const std::uint32_t> faces) const noexcept {
    return guarded([&]() -> Result<PreparedMesh> {
        GEODISK_TRY(check_faces(faces, face_count()));
        PreparedMesh part;
        auto& edges = part.half_edges_;
        edges.reserve(3 * faces.size());
        for (const std::uint32_t face : faces) {
            const auto first =
                half_edges_.begin() + static_cast<std::ptrdiff_t>(std::size_t{3} * face);
            edges.insert(edges.end(), first, first + 3);
        }
        const std::vector<std::uint32_t> vertices = vertices_of(edges);
        std::vector<std::uint32_t> triangles(edges.size());
        UninitializedVector<Link> links(edges.size());
        for (std::uint32_t h = 0; h < edges.size(); ++h) {
            const auto at = std::lower_bound(vertices.begin(), vertices.end(), edges[h].origin);
            edges[h].origin = triangles[h] = static_cast<std::uint32_t>(at - vertices.begin());
        }
        for (std::uint32_t h = 0; h < edges.size(); ++h) {
            const std::uint32_t first = h - h % 3;
            const bool is_used =
                takes_part({triangles[first], triangles[first + 1], triangles[first + 2]});
            links[h] = {triangles[h], lone_half_edge(h),
                        is_used ? pack_corner_angle(edges[h], edges[previous_in_face(h)]) : 0};
        }
        part.fans_.resize(vertices.size());
        connect({}, triangles, links, edges, part.fans_, part.corners_, part.statistics_);
        measure_faces(edges, part.statistics_);
        // Coordinates are those of the whole.
        part.statistics_.diagonal = statistics_.diagonal;
        if (!(part.statistics_.area > 0)) {
            return Error{Status::mesh_rejected, "no face of the part has area"};
        }
        return part;
    });
}

RadiusField RadiusField::on_part(const PreparedMesh& part,
                                 std::span<const std::uint32_t> faces) const {
    RadiusField some;
    some.factors_ = corners_of(factors_, faces);
    some.spreads_ = corners_of(spreads_, faces);
    some.packing_ = corners_of(packing_, faces);
    some.largest_density_ = largest_density_;
    some.min_density_ = min_density_;
    some.densities_.reserve(faces.size());
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        some.densities_.push_back(densities_[faces[f]]);
        const HalfEdge& edge = part.half_edges()[std::size_t{3} * f];
        some.effective_area_ += 0.5 * edge.length * edge.apex_y * samples_in(faces[f]);
    }
    some.find_min_factor();
    return some;
}

} // namespace geodisk
