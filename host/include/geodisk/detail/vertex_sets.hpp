// VertexSets: vertices joined in sets, such as the parts of a mesh.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace geodisk {

/// Disjoint sets of vertices, as a forest with one tree per set. The lowest vertex represents a
/// set.
class VertexSets {
  public:
    /// Starts with a set per vertex.
    explicit VertexSets(std::size_t count) : parents_(count) {
        std::iota(parents_.begin(), parents_.end(), 0u);
    }

    /// Returns the lowest vertex of the set that `v` is in.
    std::uint32_t lowest(std::uint32_t v) {
        while (parents_[v] != v) {
            parents_[v] = parents_[parents_[v]];
            v = parents_[v];
        }
        return v;
    }

    /// Joins two sets. Returns true if they were different.
    bool join(std::uint32_t a, std::uint32_t b) {
        const auto [low, high] = std::minmax({lowest(a), lowest(b)});
        parents_[high] = low;
        return low != high;
    }

  private:
    std::vector<std::uint32_t> parents_;
};

} // namespace geodisk
