// Texels: which face covers which, and where.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "geometry/texels.hpp"

namespace geodisk::test {
namespace {

using namespace tools;
using Uv = std::array<double, 2>;

MeshFile mesh_of(const std::vector<Uv>& uvs, const std::vector<std::uint32_t>& corners) {
    MeshFile mesh;
    mesh.positions.resize(3 * uvs.size());
    mesh.triangles = corners;
    MeshField field;
    field.of = MeshField::Of::corners;
    field.components = {"u", "v"};
    for (const auto& [u, v] : uvs) {
        field.values.insert(field.values.end(), {u, v});
    }
    field.corners = corners;
    mesh.texture_uvs = field;
    return mesh;
}

/// A square of n x n cells with inner vertices moved, some onto centres of texels, by less than a
/// quarter of a cell, so that no triangle turns over.
MeshFile jittered(std::uint32_t n, TextureSize size, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> off(-0.14, 0.14);
    std::vector<Uv> uvs;
    for (std::uint32_t y = 0; y <= n; ++y) {
        for (std::uint32_t x = 0; x <= n; ++x) {
            const auto moved = [&](std::uint32_t at, std::uint32_t count) {
                const double to = at == 0 || at == n ? at : at + off(random);
                const double u = to / n;
                return at == 0 || at == n || random() % 2 == 0
                           ? u
                           : (std::floor(u * count) + 0.5) / count;
            };
            const double u = moved(x, size.width), v = moved(y, size.height);
            uvs.push_back({u, v});
        }
    }
    std::vector<std::uint32_t> corners;
    for (std::uint32_t y = 0; y < n; ++y) {
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x, b = a + 1, c = a + n + 2, d = a + n + 1;
            // Turning either way.
            const std::vector<std::uint32_t> two =
                random() % 2 == 0 ? std::vector{a, b, c, c, a, d} : std::vector{b, a, d, b, c, d};
            corners.insert(corners.end(), two.begin(), two.end());
        }
    }
    return mesh_of(uvs, corners);
}

/// The texture coordinates of a texel's centre, by the weights there.
Uv place_of(const MeshFile& mesh, const Texels& texels, std::size_t texel) {
    const auto weights = texels.weights(texel);
    Uv uv{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t corner = mesh.triangles[std::size_t{3} * texels.faces()[texel] + k];
        uv[0] += double{weights[k]} * mesh.texture_uvs->values[2 * corner];
        uv[1] += double{weights[k]} * mesh.texture_uvs->values[2 * corner + 1];
    }
    return uv;
}

void check_places(const MeshFile& mesh, const Texels& texels) {
    const auto [width, height] = texels.size();
    // Centres that only rounded coordinates cover are so far off, in texels; of others, weights are
    // multiples of 2^-24.
    constexpr double kRounded = 1.5 / 256, kExact = 0x1p-22;
    double worst = 0;
    std::size_t covered = 0, rounded = 0;
    bool are_weights = true;
    for (std::size_t texel = 0; texel < texels.faces().size(); ++texel) {
        if (texels.faces()[texel] == Texels::kNone) {
            continue;
        }
        const auto w = texels.weights(texel);
        are_weights = are_weights && *std::ranges::min_element(w) >= 0 &&
                      double{w[0]} + double{w[1]} + double{w[2]} == 1;
        const auto [u, v] = place_of(mesh, texels, texel);
        const auto off = [](double at, double count, double centre) {
            const double texels_off = at * count - centre;
            return std::abs(texels_off - std::round(texels_off / count) * count);
        };
        const std::size_t column = texel % width, row = texel / width;
        const double own = std::max(off(u, width, static_cast<double>(column) + 0.5),
                                    off(1 - v, height, static_cast<double>(row) + 0.5));
        worst = std::max(worst, own);
        const bool is_exact = own < kExact * std::max(width, height);
        // The nearest point of the face is at its rim.
        are_weights = are_weights && (is_exact || *std::ranges::min_element(w) == 0);
        ++covered;
        rounded += is_exact ? 0 : 1;
    }
    CHECK(are_weights);
    CHECK(worst < kRounded);
    CHECK(rounded <= covered / 20);
}

} // namespace

TEST_SUITE("texels") {
    TEST_CASE("of a square belong to just one face") {
        for (std::uint32_t seed = 1; seed <= 20; ++seed) {
            for (const TextureSize size : {TextureSize{64, 64}, TextureSize{45, 90}}) {
                const MeshFile mesh = jittered(9, size, seed);
                const Texels texels(mesh, size);
                CHECK(texels.covered() == size.texels());
                CHECK(texels.overlapping() == 0);
                CHECK(texels.repeating() == 0);
                check_places(mesh, texels);
            }
        }
    }

    TEST_CASE("are covered as double precision tells") {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> anywhere(0.05, 0.95);
        const TextureSize size{40, 30};
        for (int round = 0; round < 200; ++round) {
            std::array<Uv, 3> t{};
            for (Uv& corner : t) {
                corner = {anywhere(random), anywhere(random)};
            }
            const MeshFile mesh = mesh_of({t[0], t[1], t[2]}, {0, 1, 2});
            const Texels texels(mesh, size);
            bool is_same = true;
            for (std::size_t texel = 0; texel < size.texels(); ++texel) {
                const std::size_t column = texel % size.width, row = texel / size.width;
                const double x = static_cast<double>(column) + 0.5;
                const double y = size.height - (static_cast<double>(row) + 0.5);
                double inside = INFINITY, outside = INFINITY; // Distance from each line, in texels.
                for (std::size_t k = 0; k < 3; ++k) {
                    const auto& [au, av] = t[k];
                    const auto& [bu, bv] = t[(k + 1) % 3];
                    const double dx = (bu - au) * size.width, dy = (bv - av) * size.height;
                    const double side = (dx * (y - av * size.height) - dy * (x - au * size.width)) /
                                        std::hypot(dx, dy);
                    inside = std::min(inside, side);
                    outside = std::min(outside, -side);
                }
                const double depth = std::max(inside, outside);
                const bool is_covered = texels.faces()[texel] == 0;
                is_same = is_same && (std::abs(depth) < 0.01 || is_covered == (depth > 0));
            }
            CHECK(is_same);
            check_places(mesh, texels);
        }
    }

    TEST_CASE("of several faces belong to the lowest, and wrap around") {
        const std::vector<Uv> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        const TextureSize size{16, 8};
        const MeshFile three = mesh_of(square, {0, 1, 2, 0, 2, 3, 0, 1, 3});
        const Texels twice(three, size);
        CHECK(twice.covered() == size.texels());
        CHECK(twice.overlapping() == size.texels() / 2);
        CHECK(std::ranges::find(twice.faces(), 2u) == twice.faces().end());
        // The first row is that of v = 1.
        CHECK(twice.faces()[0] == 1);
        CHECK(twice.faces()[size.texels() - 1] == 0);

        std::vector<Uv> moved = square;
        for (auto& [u, v] : moved) {
            u += 3, v -= 2;
        }
        const MeshFile far = mesh_of(moved, {0, 1, 2, 0, 2, 3});
        const Texels wrapped(far, size);
        const MeshFile near = mesh_of(square, {0, 1, 2, 0, 2, 3});
        CHECK(wrapped.faces() == Texels(near, size).faces());
        CHECK(wrapped.repeating() == 2);
        CHECK(wrapped.overlapping() == 0);
        check_places(far, wrapped);

        std::vector<Uv> large = square;
        for (auto& [u, v] : large) {
            u = 2 * u - 0.25, v = 2 * v + 0.5;
        }
        const MeshFile tiled = mesh_of(large, {0, 1, 2, 0, 2, 3});
        const Texels four(tiled, size);
        CHECK(four.covered() == size.texels());
        CHECK(four.overlapping() == size.texels());
        check_places(tiled, four);
    }

    TEST_CASE("have the weights of coordinates that are not rounded") {
        // The whole face is a few steps of rounding wide, around the centre of a texel.
        std::mt19937 random(3);
        std::uniform_real_distribution<double> off(0.5, 3);
        const TextureSize size{8, 8};
        for (int round = 0; round < 200; ++round) {
            const auto near = [&](double x, double y) {
                return Uv{(3.5 + x * off(random) / 256) / size.width,
                          (3.5 + y * off(random) / 256) / size.height};
            };
            const MeshFile mesh = mesh_of({near(-1, -1), near(1, -1), near(0, 1)}, {0, 1, 2});
            const Texels texels(mesh, size);
            if (texels.covered() == 1) {
                const std::size_t texel = std::size_t{4} * size.width + 3;
                REQUIRE(texels.faces()[texel] == 0);
                const auto [u, v] = place_of(mesh, texels, texel);
                const auto w = texels.weights(texel);
                const bool is_exact = std::hypot(u * 8 - 3.5, v * 8 - 3.5) < 1e-8;
                CHECK((is_exact || *std::ranges::min_element(w) == 0));
            }
        }
    }

    TEST_CASE("see both ways of counting rows") {
        const std::vector<Uv> low{{0, 0}, {1, 0}, {0, 0.5}};
        MeshFile mesh = mesh_of(low, {0, 1, 2, 0, 0, 1});
        const TextureSize size{4, 8};
        const Texels below(mesh, size);
        CHECK(below.faces().front() == Texels::kNone);
        CHECK(below.faces()[size.texels() - size.width] == 0);
        mesh.texture_uvs->is_from_top = true;
        const Texels above(mesh, size);
        CHECK(above.faces().front() == 0);
        CHECK(above.faces()[size.texels() - size.width] == Texels::kNone);
    }
}

} // namespace geodisk::test
