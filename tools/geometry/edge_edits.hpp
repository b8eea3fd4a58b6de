// Flips and splits of the edges of a triangle mesh in which no edge has more than two triangles, of
// opposite ways along it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "geometry/mesh.hpp"
#include "geometry/vec.hpp"

namespace geodisk::tools {

/// The edges of a mesh that only this object changes, while it exists.
class EdgeEdits {
  public:
    explicit EdgeEdits(MeshFile& mesh) : mesh_(mesh) {
        for (std::size_t corner = 0; corner < mesh_.triangles.size(); ++corner) {
            enter(corner);
        }
    }

    bool has_edge(std::uint32_t a, std::uint32_t b) const {
        return corners_.contains({a, b}) || corners_.contains({b, a});
    }

    /// Flips edges a b, of triangles a b c and b a d, to c d, until `is_due(a, b, c, d)` of none.
    template <typename IsDue>
    void flip_all(const IsDue& is_due) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> due;
        for (const auto& [edge, corner] : corners_) {
            due.push_back(edge);
        }
        while (!due.empty()) {
            const auto [a, b] = due.back();
            due.pop_back();
            const auto left = corners_.find({a, b});
            const auto right = corners_.find({b, a});
            if (left == corners_.end() || right == corners_.end()) {
                continue; // Of the border, or flipped meanwhile.
            }
            const std::uint32_t c = apex_of(left->second);
            const std::uint32_t d = apex_of(right->second);
            if (!is_due(a, b, c, d)) {
                continue;
            }
            flip(left->second / 3, right->second / 3, a, b, c, d);
            due.insert(due.end(), {{a, d}, {d, b}, {b, c}, {c, a}});
        }
    }

    /// Puts a vertex onto the edge from one vertex to another, and cuts its triangles there.
    void split(std::uint32_t from, std::uint32_t to, const Vec3& place) {
        const auto middle = static_cast<std::uint32_t>(mesh_.positions.size() / 3);
        mesh_.positions.insert(mesh_.positions.end(), {place.x, place.y, place.z});
        for (const auto& [a, b] : {std::pair{from, to}, std::pair{to, from}}) {
            const auto found = corners_.find({a, b});
            if (found == corners_.end()) {
                continue; // Of the border.
            }
            const std::uint32_t c = apex_of(found->second);
            const std::size_t triangle = found->second / 3;
            corners_.erase(found);
            mesh_.triangles.insert(mesh_.triangles.end(), 3, 0);
            set(triangle, a, middle, c);
            set(mesh_.triangle_count() - 1, middle, b, c);
        }
    }

  private:
    std::uint32_t vertex(std::size_t corner) const { return mesh_.triangles[corner]; }
    static std::size_t next(std::size_t corner) {
        return corner % 3 == 2 ? corner - 2 : corner + 1;
    }
    /// The vertex across from the edge that begins at a corner.
    std::uint32_t apex_of(std::size_t corner) const { return vertex(next(next(corner))); }
    void enter(std::size_t corner) { corners_[{vertex(corner), vertex(next(corner))}] = corner; }

    void set(std::size_t triangle, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const std::uint32_t vertices[] = {a, b, c};
        for (std::size_t i = 0; i < 3; ++i) {
            mesh_.triangles[3 * triangle + i] = vertices[i];
        }
        for (std::size_t i = 0; i < 3; ++i) {
            enter(3 * triangle + i);
        }
    }

    /// Replaces triangles a b c and b a d by a d c and d b c.
    void flip(std::size_t left, std::size_t right, std::uint32_t a, std::uint32_t b,
              std::uint32_t c, std::uint32_t d) {
        corners_.erase({a, b});
        corners_.erase({b, a});
        set(left, a, d, c);
        set(right, d, b, c);
    }

    MeshFile& mesh_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> corners_; ///< By directed edge.
};

} // namespace geodisk::tools
