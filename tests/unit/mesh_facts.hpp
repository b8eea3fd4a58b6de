// Independent measurements of a triangle mesh, for checking readers and generators.
#pragma once

#include "common/mesh_file.hpp"
#include "common/vec3.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace geodisk::tools {

inline Vec3 position_at(const MeshFile& mesh, std::size_t vertex) {
    const double* p = &mesh.positions[3 * vertex];
    return {p[0], p[1], p[2]};
}

inline double triangle_area(const MeshFile& mesh, std::size_t triangle) {
    const std::uint32_t* corner = &mesh.triangles[3 * triangle];
    const Vec3 a = position_at(mesh, corner[0]);
    return 0.5 * length(cross(position_at(mesh, corner[1]) - a, position_at(mesh, corner[2]) - a));
}

inline double total_area(const MeshFile& mesh) {
    double area = 0;
    for (std::size_t t = 0; t < mesh.triangles.size() / 3; ++t) {
        area += triangle_area(mesh, t);
    }
    return area;
}

struct MeshFacts {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::size_t unused_vertices = 0;
    std::size_t components = 0;
    std::size_t border_edges = 0;
    std::size_t crowded_edges = 0;    ///< Edges of more than two triangles.
    std::size_t clashing_edges = 0;   ///< Edges that two triangles run through the same way.
    std::size_t pinched_vertices = 0; ///< Vertices whose triangles form more than one fan.
    std::ptrdiff_t euler_characteristic = 0;
    double flattest = 0; ///< Least ratio of area to the square of the longest edge.

    bool is_closed_manifold() const {
        return border_edges == 0 && crowded_edges == 0 && pinched_vertices == 0;
    }
    /// Of one closed orientable surface.
    std::ptrdiff_t genus() const { return (2 - euler_characteristic) / 2; }
};

/// Groups of numbers that are joined pair by pair.
class Groups {
  public:
    explicit Groups(std::size_t count) : parents_(count) {
        std::iota(parents_.begin(), parents_.end(), std::size_t{0});
    }
    std::size_t find(std::size_t i) {
        while (parents_[i] != i) {
            i = parents_[i] = parents_[parents_[i]];
        }
        return i;
    }
    void join(std::size_t a, std::size_t b) { parents_[find(a)] = find(b); }

  private:
    std::vector<std::size_t> parents_;
};

inline double flatness(const MeshFile& mesh, std::size_t triangle) {
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 a = position_at(mesh, mesh.triangles[3 * triangle + i]);
        const Vec3 b = position_at(mesh, mesh.triangles[3 * triangle + (i + 1) % 3]);
        longest = std::max(longest, length(b - a));
    }
    return triangle_area(mesh, triangle) / (longest * longest);
}

inline MeshFacts measure(const MeshFile& mesh) {
    struct Edge {
        int forward = 0;
        int backward = 0;
        std::size_t corner = 0; // Of the first triangle at the edge.
    };
    MeshFacts facts;
    facts.vertices = mesh.positions.size() / 3;
    facts.triangles = mesh.triangles.size() / 3;
    facts.flattest = 1;
    std::map<std::pair<std::uint32_t, std::uint32_t>, Edge> edges;
    std::vector<bool> used(facts.vertices, false);
    Groups components(facts.vertices);
    Groups fans(mesh.triangles.size()); // Corners of one vertex, joined across shared edges.
    for (std::size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
        const std::size_t triangle = corner / 3;
        const std::size_t next_corner = 3 * triangle + (corner + 1) % 3;
        const std::uint32_t from = mesh.triangles[corner];
        const std::uint32_t to = mesh.triangles[next_corner];
        used[from] = true;
        components.join(from, to);
        const auto [entry, is_new] = edges.try_emplace(std::minmax(from, to));
        Edge& edge = entry->second;
        if (is_new) {
            edge.corner = corner;
        } else {
            const std::size_t other = edge.corner;
            const std::size_t other_next = 3 * (other / 3) + (other + 1) % 3;
            const bool same_way = mesh.triangles[other] == from;
            fans.join(corner, same_way ? other : other_next);
            fans.join(next_corner, same_way ? other_next : other);
        }
        ++(from < to ? edge.forward : edge.backward);
    }
    for (std::size_t t = 0; t < facts.triangles; ++t) {
        facts.flattest = std::min(facts.flattest, flatness(mesh, t));
    }
    for (const auto& [ends, edge] : edges) {
        const int count = edge.forward + edge.backward;
        facts.border_edges += count == 1 ? 1u : 0u;
        facts.crowded_edges += count > 2 ? 1u : 0u;
        facts.clashing_edges += edge.forward > 1 || edge.backward > 1 ? 1u : 0u;
    }
    std::size_t fan_count = 0;
    for (std::size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
        fan_count += fans.find(corner) == corner ? 1u : 0u;
    }
    const std::size_t used_count =
        static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
    facts.unused_vertices = facts.vertices - used_count;
    facts.pinched_vertices = fan_count - used_count;
    for (std::size_t vertex = 0; vertex < facts.vertices; ++vertex) {
        facts.components += used[vertex] && components.find(vertex) == vertex ? 1u : 0u;
    }
    facts.euler_characteristic = static_cast<std::ptrdiff_t>(used_count + facts.triangles) -
                                 static_cast<std::ptrdiff_t>(edges.size());
    return facts;
}

} // namespace geodisk::tools
