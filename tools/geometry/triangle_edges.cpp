#include "geometry/triangle_edges.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

namespace geodisk::tools {

TriangleEdges::TriangleEdges(const std::vector<std::uint32_t>& triangles)
    : of_corner(triangles.size(), std::numeric_limits<std::uint32_t>::max()) {
    std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> sorted;
    sorted.reserve(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        if (names_three(&triangles[i - i % 3])) {
            const std::uint32_t next = i % 3 == 2 ? i - 2 : i + 1;
            const auto [low, high] = std::minmax(triangles[i], triangles[next]);
            sorted.emplace_back(low, high, i);
        }
    }
    std::ranges::sort(sorted);
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const auto& [low, high, corner] = sorted[i];
        if (i == 0 || std::get<0>(sorted[i - 1]) != low || std::get<1>(sorted[i - 1]) != high) {
            starts.push_back(i);
            ends.push_back({low, high});
        }
        of_corner[corner] = static_cast<std::uint32_t>(ends.size() - 1);
        corners.push_back(corner);
    }
    starts.push_back(sorted.size());
}

} // namespace geodisk::tools
