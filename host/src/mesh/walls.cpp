#include "geodisk/walls.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "geodisk/detail/vertex_sets.hpp"
#include "mesh/connectivity.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

using Edge = std::array<std::uint32_t, 2>;
using Face = std::array<std::uint32_t, 3>;

Edge sorted_edge(std::uint32_t a, std::uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

Face face_of(std::span<const std::uint32_t> triangles, std::size_t face) {
    return {triangles[3 * face], triangles[3 * face + 1], triangles[3 * face + 2]};
}

/// The edges that are walls.
class WallEdges {
  public:
    explicit WallEdges(std::span<const Edge> edges) {
        edges_.reserve(edges.size());
        for (const auto& [a, b] : edges) {
            edges_.push_back(sorted_edge(a, b));
        }
        std::sort(edges_.begin(), edges_.end());
        edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    }

    bool has(std::uint32_t a, std::uint32_t b) const {
        return std::binary_search(edges_.begin(), edges_.end(), sorted_edge(a, b));
    }

    /// Returns which vertices are ends of walls.
    std::vector<bool> ends(std::uint32_t vertex_count) const {
        std::vector<bool> found(vertex_count, false);
        for (const auto& [a, b] : edges_) {
            found[a] = found[b] = true;
        }
        return found;
    }

  private:
    std::vector<Edge> edges_;
};

/// Checks that faces have all edges of `walls`.
Result<Done> check_edges(std::span<const std::uint32_t> triangles, std::uint32_t vertex_count,
                         std::span<const Edge> walls) {
    std::vector<bool> is_end(vertex_count, false);
    for (std::size_t i = 0; i < walls.size(); ++i) {
        for (const std::uint32_t vertex : walls[i]) {
            if (vertex >= vertex_count) {
                return invalid("wall " + std::to_string(i) + " names vertex " +
                                   std::to_string(vertex) + ", the mesh has " +
                                   std::to_string(vertex_count),
                               i);
            }
            is_end[vertex] = true;
        }
    }
    std::vector<Edge> known; // Those that may be walls.
    for (std::size_t f = 0; f < triangles.size() / 3; ++f) {
        const Face face = face_of(triangles, f);
        for (std::size_t k = 0; takes_part(face) && k < 3; ++k) {
            if (is_end[face[k]] && is_end[face[(k + 1) % 3]]) {
                known.push_back(sorted_edge(face[k], face[(k + 1) % 3]));
            }
        }
    }
    std::sort(known.begin(), known.end());
    for (std::size_t i = 0; i < walls.size(); ++i) {
        const auto& [a, b] = walls[i];
        if (!std::binary_search(known.begin(), known.end(), sorted_edge(a, b))) {
            return invalid("wall " + std::to_string(i) + " is no edge: no face has the vertices " +
                               std::to_string(a) + " and " + std::to_string(b),
                           i);
        }
    }
    return Done{};
}

bool has_faces(std::span<const std::uint32_t> triangles) {
    for (std::size_t f = 0; f < triangles.size() / 3; ++f) {
        if (takes_part(face_of(triangles, f))) {
            return true;
        }
    }
    return false;
}

/// A corner of a face, at a vertex where a wall ends.
struct CornerAtWall {
    std::uint32_t vertex, corner; ///< `corner` indexes triangles.
    auto operator<=>(const CornerAtWall&) const = default;
};

std::vector<CornerAtWall> corners_at_walls(std::span<const std::uint32_t> triangles,
                                           const std::vector<bool>& is_end) {
    std::vector<CornerAtWall> corners;
    for (std::uint32_t c = 0; c < triangles.size(); ++c) {
        if (is_end[triangles[c]] && takes_part(face_of(triangles, c / 3))) {
            corners.push_back({triangles[c], c});
        }
    }
    std::sort(corners.begin(), corners.end());
    return corners;
}

/// The corners of one vertex, in sets that edges join.
class Sides {
  public:
    Sides(const IndexView& triangles, std::span<const CornerAtWall> corners, const WallEdges& walls)
        : between_walls_(corners.size()), with_walls_(corners.size()) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> edges; // Other end and corner.
        for (std::uint32_t i = 0; i < corners.size(); ++i) {
            edges.emplace_back(triangles[next_in_face(corners[i].corner)], i);
            edges.emplace_back(triangles[previous_in_face(corners[i].corner)], i);
        }
        std::sort(edges.begin(), edges.end());
        std::uint32_t passing = 0; // Walls at the vertex; two pass it, also along a border.
        for (std::size_t i = 0; i < edges.size(); ++i) {
            const bool is_first = i == 0 || edges[i].first != edges[i - 1].first;
            passing += is_first && walls.has(corners.front().vertex, edges[i].first) ? 1u : 0u;
        }
        is_passed_ = passing > 1;
        for (std::size_t i = 1; i < edges.size(); ++i) {
            if (edges[i].first != edges[i - 1].first) {
                continue;
            }
            with_walls_.join(edges[i].second, edges[i - 1].second);
            if (!walls.has(corners.front().vertex, edges[i].first)) {
                between_walls_.join(edges[i].second, edges[i - 1].second);
            }
        }
        for (std::uint32_t i = 0; i < corners.size(); ++i) {
            is_passed_ = is_passed_ || between_walls_.lowest(i) != with_walls_.lowest(i);
        }
    }

    /// Returns the lowest corner of the set that a corner is in, if walls pass the vertex, else 0.
    std::uint32_t side_of(std::uint32_t corner) {
        return is_passed_ ? between_walls_.lowest(corner) : 0;
    }

  private:
    VertexSets between_walls_, with_walls_;
    bool is_passed_ = false;
};

} // namespace

Result<CutMesh> cut(const IndexView& triangles, std::uint32_t vertex_count,
                    const Walls& walls) noexcept {
    return guarded([&]() -> Result<CutMesh> {
        const std::size_t faces = triangles.size() / 3;
        if (triangles.size() % 3 != 0) {
            return invalid("the number of indices is no multiple of 3");
        }
        if (!walls.faces.empty() && walls.faces.size() != faces) {
            return invalid("there are " + std::to_string(walls.faces.size()) +
                           " bytes for walls, and " + std::to_string(faces) + " faces");
        }
        CutMesh result;
        result.triangles.resize(triangles.size());
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            result.triangles[i] = triangles[i];
            if (triangles[i] >= vertex_count) {
                return Error{Status::mesh_rejected,
                             "face " + std::to_string(i / 3) + " names vertex " +
                                 std::to_string(triangles[i]) + ", the mesh has " +
                                 std::to_string(vertex_count),
                             i / 3};
            }
        }
        GEODISK_TRY(check_edges(result.triangles, vertex_count, walls.edges));
        for (std::size_t f = 0; f < walls.faces.size(); ++f) {
            if (walls.faces[f] != 0) {
                std::fill_n(&result.triangles[3 * f], 3, triangles[3 * f]);
            }
        }
        if (!walls.faces.empty() && !has_faces(result.triangles)) {
            return Error{Status::mesh_rejected, "every face is a wall"};
        }
        const WallEdges edges(walls.edges);
        const std::vector<CornerAtWall> corners =
            corners_at_walls(result.triangles, edges.ends(vertex_count));
        for (auto first = corners.begin(); first != corners.end();) {
            const auto last = std::find_if(first, corners.end(), [&](const CornerAtWall& c) {
                return c.vertex != first->vertex;
            });
            const std::span<const CornerAtWall> here(first, last);
            Sides sides(triangles, here, edges);
            std::vector<std::uint32_t> vertices(here.size(), first->vertex); // By lowest corner.
            for (std::uint32_t i = 0; i < here.size(); ++i) {
                const std::uint32_t side = sides.side_of(i);
                if (side == i && i > 0) {
                    if (result.copied.size() >= UINT32_MAX - vertex_count) {
                        return Error{Status::mesh_rejected,
                                     "walls make more vertices than can be numbered"};
                    }
                    vertices[i] = vertex_count + static_cast<std::uint32_t>(result.copied.size());
                    result.copied.push_back(first->vertex);
                }
                result.triangles[here[i].corner] = vertices[side];
            }
            first = last;
        }
        return result;
    });
}

} // namespace geodisk
