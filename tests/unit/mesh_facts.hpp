// Independent measurements of a triangle mesh, for checking readers and generators.
#pragma once

#include "files/meshes/mesh_file.hpp"
#include "geometry/vec.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace geodisk::tools {

/// Returns the position of a vertex of a mesh in space.
inline Vec3 position_at(const MeshFile& mesh, std::size_t vertex) {
    const double* p = &mesh.positions[3 * vertex];
    return {p[0], p[1], p[2]};
}

/// From one vertex to another, with any number of coordinates.
inline std::vector<double> side(const MeshFile& mesh, std::size_t from, std::size_t to) {
    std::vector<double> side(mesh.dimension);
    for (std::size_t axis = 0; axis < side.size(); ++axis) {
        side[axis] = mesh.positions[to * mesh.dimension + axis] -
                     mesh.positions[from * mesh.dimension + axis];
    }
    return side;
}

inline double dot_product(const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

inline double triangle_area(const MeshFile& mesh, std::size_t triangle) {
    const std::uint32_t* corner = &mesh.triangles[3 * triangle];
    std::vector<double> a = side(mesh, corner[0], corner[1]);
    std::vector<double> b = side(mesh, corner[0], corner[2]);
    if (dot_product(a, a) < dot_product(b, b)) {
        std::swap(a, b);
    }
    // Height times base: of a needle, the difference of products would leave nothing.
    const double part = dot_product(a, b) / dot_product(a, a);
    double height2 = 0;
    for (std::size_t axis = 0; axis < a.size(); ++axis) {
        const double d = b[axis] - part * a[axis];
        height2 += d * d;
    }
    return 0.5 * std::sqrt(dot_product(a, a) * height2);
}

inline double total_area(const MeshFile& mesh) {
    double area = 0;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        area += mesh.takes_part(t) ? triangle_area(mesh, t) : 0;
    }
    return area;
}

/// Triangles that were not dropped.
inline std::size_t taking_part(const MeshFile& mesh) {
    std::size_t count = 0;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        count += mesh.takes_part(t) ? 1u : 0u;
    }
    return count;
}

struct MeshFacts {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::size_t unused_vertices = 0;
    std::size_t components = 0;
    std::size_t border_edges = 0;
    std::size_t crowded_edges = 0;    ///< Edges of more than two triangles.
    std::size_t clashing_edges = 0;   ///< Edges that two triangles run through the same way.
    std::size_t pinched_vertices = 0; ///< Fans of triangles beyond one per vertex.
    std::ptrdiff_t euler_characteristic = 0;
    double flattest = 0; ///< Least ratio of area to the square of the longest edge.

    bool is_closed_manifold() const {
        return border_edges == 0 && crowded_edges == 0 && pinched_vertices == 0;
    }
    /// Returns the genus of one closed orientable surface.
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
        const std::vector<double> edge = side(mesh, mesh.triangles[3 * triangle + i],
                                              mesh.triangles[3 * triangle + (i + 1) % 3]);
        longest = std::max(longest, std::sqrt(dot_product(edge, edge)));
    }
    return triangle_area(mesh, triangle) / (longest * longest);
}

/// The edges of a mesh, and which triangle corners at one vertex hang together through them.
class EdgeTable {
  public:
    explicit EdgeTable(const MeshFile& mesh) : fans_(mesh.triangles.size()) {
        for (std::size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
            add(mesh, corner);
        }
        for (std::size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
            fan_count_ += fans_.find(corner) == corner ? 1u : 0u;
        }
    }

    std::size_t fan_count() const { return fan_count_; }
    std::size_t size() const { return edges_.size(); }

    void count_edges(MeshFacts& facts) const {
        for (const auto& [ends, edge] : edges_) {
            const int count = edge.forward + edge.backward;
            facts.border_edges += count == 1 ? 1u : 0u;
            facts.crowded_edges += count > 2 ? 1u : 0u;
            facts.clashing_edges += edge.forward > 1 || edge.backward > 1 ? 1u : 0u;
        }
    }

  private:
    struct Edge {
        int forward = 0;
        int backward = 0;
        std::size_t corner = 0; // Of the first triangle at the edge.
    };

    static std::size_t next_corner(std::size_t corner) {
        return 3 * (corner / 3) + (corner + 1) % 3;
    }

    /// The edge from `corner` to the next one of its triangle.
    void add(const MeshFile& mesh, std::size_t corner) {
        const std::uint32_t from = mesh.triangles[corner];
        const std::uint32_t to = mesh.triangles[next_corner(corner)];
        const auto [entry, is_new] = edges_.try_emplace(std::minmax(from, to));
        Edge& edge = entry->second;
        if (is_new) {
            edge.corner = corner;
        } else {
            const std::size_t other = edge.corner;
            const bool same_way = mesh.triangles[other] == from;
            fans_.join(corner, same_way ? other : next_corner(other));
            fans_.join(next_corner(corner), same_way ? next_corner(other) : other);
        }
        ++(from < to ? edge.forward : edge.backward);
    }

    std::map<std::pair<std::uint32_t, std::uint32_t>, Edge> edges_;
    Groups fans_;
    std::size_t fan_count_ = 0;
};

inline MeshFacts measure(const MeshFile& mesh) {
    MeshFacts facts;
    facts.vertices = mesh.positions.size() / mesh.dimension;
    facts.triangles = mesh.triangles.size() / 3;

    Groups components(facts.vertices);
    std::vector<bool> used(facts.vertices, false);
    facts.flattest = 1;
    for (std::size_t t = 0; t < facts.triangles; ++t) {
        for (std::size_t i = 0; i < 3; ++i) {
            used[mesh.triangles[3 * t + i]] = true;
            components.join(mesh.triangles[3 * t], mesh.triangles[3 * t + i]);
        }
        facts.flattest = std::min(facts.flattest, flatness(mesh, t));
    }
    for (std::size_t vertex = 0; vertex < facts.vertices; ++vertex) {
        facts.unused_vertices += used[vertex] ? 0u : 1u;
        facts.components += used[vertex] && components.find(vertex) == vertex ? 1u : 0u;
    }

    const EdgeTable edges(mesh);
    edges.count_edges(facts);
    const std::size_t used_vertices = facts.vertices - facts.unused_vertices;
    facts.pinched_vertices = edges.fan_count() - used_vertices;
    facts.euler_characteristic = static_cast<std::ptrdiff_t>(used_vertices + facts.triangles) -
                                 static_cast<std::ptrdiff_t>(edges.size());
    return facts;
}

} // namespace geodisk::tools
