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
    /// Makes it for a mesh that must outlive it. All paths are shorter than `most`.
    explicit EdgePaths(const PreparedMesh& mesh, double most = kNone)
        : mesh_(mesh), most_(most), lengths_(mesh.vertex_count(), kNone) {}

    /// Forgets all paths, in time by the vertices that they reached.
    void restart(double most) {
        for (const std::uint32_t vertex : reached_) {
            lengths_[vertex] = kNone;
        }
        reached_.clear();
        most_ = most;
    }

    /// Begins paths at a vertex with this length.
    void begin_at(std::uint32_t vertex, double length) {
        if (length < most_ && length < lengths_[vertex]) {
            if (lengths_[vertex] == kNone) {
                reached_.push_back(vertex);
            }
            lengths_[vertex] = length;
            queue_.emplace(length, vertex);
        }
    }
    /// Lets paths end at a vertex where none is yet.
    void end_at(std::uint32_t vertex) {
        lengths_[vertex] = 0;
        reached_.push_back(vertex);
    }
    /// Begins paths at a point on the mesh with this length. They lead straight to a corner of its
    /// face.
    void begin_at(const Sample& point, double length);
    /// Returns the lengths for each vertex, of paths from all points and vertices so far. Infinite
    /// where there is none.
    const std::vector<double>& lengths();
    /// Returns the vertices with paths, in the order in which those came.
    const std::vector<std::uint32_t>& reached() const { return reached_; }

  private:
    static constexpr double kNone = std::numeric_limits<double>::infinity();
    using Reached = std::pair<double, std::uint32_t>;

    const PreparedMesh& mesh_;
    double most_;
    std::vector<double> lengths_;
    std::vector<std::uint32_t> reached_;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue_;
};

} // namespace geodisk
