// Shortest paths along edges.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include <geodisk/mesh.hpp>
#include <geodisk/sample.hpp>

namespace geodisk {

/// Returns how far a point on the mesh is from the corners of its face, in a straight line.
std::array<double, 3> corner_distances(const PreparedMesh& mesh, const Sample& point);

/// Lengths of the shortest paths along edges to each vertex (Dijkstra's algorithm). They are at
/// least the geodesic distances.
class EdgePaths {
  public:
    /// Makes it for a mesh that must outlive it. No path is longer than `most`, which is also the
    /// length to vertices without any.
    explicit EdgePaths(const PreparedMesh& mesh,
                       double most = std::numeric_limits<double>::infinity())
        : mesh_(mesh), lengths_(mesh.vertex_count(), most) {}

    /// Begins paths at a vertex with this length.
    void begin_at(std::uint32_t vertex, double length) {
        if (length < lengths_[vertex]) {
            lengths_[vertex] = length;
            queue_.emplace(length, vertex);
        }
    }
    /// Begins paths at a point on the mesh with this length. They lead straight to a corner of its
    /// face.
    void begin_at(const Sample& point, double length);
    /// Returns the lengths for each vertex, of paths from all points and vertices so far.
    const std::vector<double>& lengths();

  private:
    using Reached = std::pair<double, std::uint32_t>;

    const PreparedMesh& mesh_;
    std::vector<double> lengths_;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue_;
};

} // namespace geodisk
