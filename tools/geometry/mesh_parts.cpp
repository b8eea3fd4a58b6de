#include "geometry/mesh_parts.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace geodisk::tools {
namespace {

/// A forest of vertices with a tree for each part.
class Forest {
  public:
    explicit Forest(std::uint32_t vertices) : parents_(vertices) {
        std::iota(parents_.begin(), parents_.end(), 0u);
    }

    std::uint32_t root_of(std::uint32_t v) {
        while (parents_[v] != v) {
            parents_[v] = parents_[parents_[v]];
            v = parents_[v];
        }
        return v;
    }

    void join(std::uint32_t a, std::uint32_t b) { parents_[root_of(a)] = root_of(b); }

  private:
    std::vector<std::uint32_t> parents_;
};

} // namespace

std::uint64_t parts_without(std::span<const std::uint32_t> triangles,
                            std::span<const std::uint32_t> faces) {
    const std::uint32_t vertices = triangles.empty() ? 0 : std::ranges::max(triangles) + 1;
    Forest forest(vertices);
    std::vector<bool> is_used(vertices);
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
        const auto [a, b, c] = std::array{triangles[i], triangles[i + 1], triangles[i + 2]};
        if (a != b && b != c && c != a) {
            forest.join(a, b);
            forest.join(b, c);
            is_used[a] = is_used[b] = is_used[c] = true;
        }
    }
    std::vector<bool> has_one(vertices);
    for (const std::uint32_t face : faces) {
        has_one[forest.root_of(triangles[std::size_t{3} * face])] = true;
    }
    std::uint64_t without = 0;
    for (std::uint32_t v = 0; v < vertices; ++v) {
        without += is_used[v] && forest.root_of(v) == v && !has_one[v];
    }
    return without;
}

} // namespace geodisk::tools
