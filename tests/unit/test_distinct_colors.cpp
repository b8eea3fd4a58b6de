// Colours of graphs.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "picture/distinct_colors.hpp"

namespace geodisk::test {
namespace {

using Edges = std::vector<std::array<std::uint32_t, 2>>;
using tools::picture::distinct_colors;

/// Checks that no edge has one colour, and returns how many there are.
std::uint32_t colors_of(std::size_t count, const Edges& edges) {
    const std::vector<std::uint32_t> colors = distinct_colors(count, edges);
    REQUIRE(colors.size() == count);
    CHECK(
        std::ranges::none_of(edges, [&](auto edge) { return colors[edge[0]] == colors[edge[1]]; }));
    CHECK(distinct_colors(count, edges) == colors);
    return count == 0 ? 0 : *std::ranges::max_element(colors) + 1;
}

/// A planar graph: each node joined to the corners of a triangle of earlier ones, which it splits.
Edges random_triangulation(std::uint32_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    Edges edges{{0, 1}, {1, 2}, {0, 2}};
    std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {0, 1, 2}};
    for (std::uint32_t node = 3; node < count; ++node) {
        auto& split = triangles[random() % triangles.size()];
        const auto [a, b, c] = split;
        edges.insert(edges.end(), {{a, node}, {b, node}, {c, node}});
        split = {a, b, node};
        triangles.push_back({b, c, node});
        triangles.push_back({a, c, node});
    }
    std::ranges::shuffle(edges, random);
    return edges;
}

} // namespace

TEST_CASE("neighbours have different colours, of which there are few") {
    CHECK(colors_of(0, {}) == 0);
    CHECK(colors_of(3, {}) == 1);
    CHECK(colors_of(2, {{0, 1}}) == 2);
    Edges all, star;
    for (std::uint32_t a = 0; a < 9; ++a) {
        for (std::uint32_t b = a + 1; b < 9; ++b) {
            all.push_back({a, b});
        }
        star.push_back({a, 9});
    }
    CHECK(colors_of(9, all) == 9);
    CHECK(colors_of(10, star) == 2);
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        CHECK(colors_of(2000, random_triangulation(2000, seed)) <= 6);
    }
    // A torus of hexagons.
    Edges torus;
    for (std::uint32_t i = 0; i < 400; ++i) {
        const std::uint32_t x = i % 20, y = i / 20, right = (x + 1) % 20, up = (y + 1) % 20;
        torus.insert(torus.end(), {{i, 20 * y + right}, {i, 20 * up + x}, {i, 20 * up + right}});
    }
    CHECK(colors_of(400, torus) <= 7);
}

} // namespace geodisk::test
