// Welding, exactly and within a distance, beside plain union of all pairs; and the statistic that
// tells of seams to weld.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "geodisk/weld.hpp"
#include "support/meshes.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

/// Every face with vertices of its own.
TestMesh loose_triangles_of(const TestMesh& mesh) {
    TestMesh soup{{}, {}, mesh.dimension};
    for (const std::uint32_t v : mesh.triangles) {
        const auto first = mesh.positions.begin() + std::ptrdiff_t{v} * mesh.dimension;
        soup.positions.insert(soup.positions.end(), first, first + mesh.dimension);
        soup.triangles.push_back(static_cast<std::uint32_t>(soup.triangles.size()));
    }
    return soup;
}

WeldedMesh welded(const TestMesh& mesh, double epsilon) {
    auto result = weld(mesh.view(), epsilon);
    REQUIRE(result);
    return std::move(*result);
}

MeshStatistics statistics_of(const TestMesh& mesh, const std::vector<std::uint32_t>& triangles) {
    const auto result = PreparedMesh::prepare({mesh.positions, triangles, mesh.dimension, true});
    REQUIRE(result);
    return result->statistics();
}

/// Returns what each vertex becomes, by all pairs, over and over.
std::vector<std::uint32_t> by_all_pairs(const TestMesh& mesh, double epsilon) {
    std::vector<std::uint32_t> lowest;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        lowest.push_back(v);
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (std::uint32_t a = 0; a < mesh.vertex_count(); ++a) {
            for (std::uint32_t b = 0; b < a; ++b) {
                double sum = 0;
                for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
                    const double d = (mesh.positions[a * mesh.dimension + axis] -
                                      mesh.positions[b * mesh.dimension + axis]) /
                                     epsilon;
                    sum += d * d;
                }
                if (sum <= 1 && lowest[a] != lowest[b]) {
                    lowest[a] = lowest[b] = std::min(lowest[a], lowest[b]);
                    changed = true;
                }
            }
        }
    }
    return lowest;
}

} // namespace

TEST_CASE("weld: a soup becomes the mesh it was made of") {
    for (const TestMesh& mesh : {builtin("icosphere", 3), builtin("moebius", 4),
                                 builtin("klein-bottle", 6), flat_grid(5, 4, 1, 1)}) {
        const TestMesh soup = loose_triangles_of(mesh);
        const MeshStatistics open = statistics_of(soup, soup.triangles);
        const MeshStatistics whole = prepared(mesh).statistics();
        CHECK(open.components == mesh.face_count());
        CHECK(open.boundary_edges == 3 * mesh.face_count());
        CHECK(open.coinciding_border_edges == open.boundary_edges - whole.boundary_edges);
        CHECK(whole.coinciding_border_edges == 0);
        for (const double epsilon : {0.0, 1e-9}) {
            const WeldedMesh result = welded(soup, epsilon);
            const MeshStatistics closed = statistics_of(soup, result.triangles);
            CHECK(closed.vertices == whole.vertices);
            CHECK(closed.components == whole.components);
            CHECK(closed.boundary_edges == whole.boundary_edges);
            CHECK(closed.coinciding_border_edges == 0);
            CHECK(closed.area == whole.area);
            CHECK(result.merged_vertices == soup.vertex_count() - whole.vertices);
            CHECK(result.degenerate_faces == 0);
            for (std::uint32_t i = 0; i < soup.triangles.size(); ++i) {
                REQUIRE(result.triangles[i] == result.vertices[soup.triangles[i]]);
                REQUIRE(result.triangles[i] <= soup.triangles[i]);
            }
        }
    }
}

TEST_CASE("weld: zero has no sign, and nothing else is rounded") {
    const double next = std::nextafter(1.0, 2.0);
    const TestMesh mesh{{0, 0, 1, 0, 0, 1, -0.0, 0, 1, -0.0, next, 1}, {0, 1, 2, 3, 4, 5}, 2};
    const WeldedMesh exact = welded(mesh, 0);
    CHECK(exact.vertices == std::vector<std::uint32_t>{0, 1, 2, 0, 1, 5});
    CHECK(exact.merged_vertices == 2);
    CHECK(statistics_of(mesh, mesh.triangles).coinciding_border_edges == 2);
    const WeldedMesh near = welded(mesh, 1);
    CHECK(near.triangles == std::vector<std::uint32_t>{0, 0, 0, 0, 0, 0});
    CHECK(near.degenerate_faces == 2);
}

TEST_CASE("weld: within epsilon as by all pairs, chains included") {
    std::mt19937 random(7);
    for (const std::uint32_t dimension : {2u, 3u, 5u}) {
        TestMesh mesh{{}, {}, dimension};
        std::uniform_real_distribution<double> uniform(-3, 2);
        for (std::uint32_t v = 0; v < 240; ++v) {
            mesh.triangles.push_back(v);
            for (std::uint32_t axis = 0; axis < dimension; ++axis) {
                // Some on a lattice, whose distances are exactly epsilon.
                const double x = uniform(random);
                mesh.positions.push_back(v % 3 == 0 ? std::floor(x * 4) / 4 : x);
            }
        }
        for (const double epsilon : {1e-3, 0.05, 0.25, 0.3, 0.5, 1.0, 2.0, 100.0}) {
            CAPTURE(dimension);
            CAPTURE(epsilon);
            CHECK(welded(mesh, epsilon).vertices == by_all_pairs(mesh, epsilon));
        }
    }
}

TEST_CASE("weld: unused vertices stay, whatever they are") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const TestMesh mesh{{nan, 0, 0, 0, 1, 0, HUGE_VAL, nan, 0, 1, 0, 0}, {1, 2, 4, 1, 2, 5}, 2};
    for (const double epsilon : {0.0, 0.1}) {
        const WeldedMesh result = welded(mesh, epsilon);
        CHECK(result.vertices == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 1});
        CHECK(result.triangles == std::vector<std::uint32_t>{1, 2, 4, 1, 2, 1});
        CHECK(result.degenerate_faces == 1);
    }
}

TEST_CASE("weld: what is refused") {
    const TestMesh mesh = flat_grid(1, 1, 1, 1);
    for (const double bad : {-1e-9, HUGE_VAL, std::numeric_limits<double>::quiet_NaN()}) {
        const auto result = weld(mesh.view(), bad);
        REQUIRE(!result);
        CHECK(result.error().status == Status::invalid_argument);
    }
    for (const double small : {1e-14, 5e-324}) {
        const auto result = weld(mesh.view(), small);
        REQUIRE(!result);
        CHECK(result.error().message == "epsilon is too small beside the bounding box of the mesh");
    }
    CHECK(weld(mesh.view(), 0x1p-43));
    CHECK(weld(mesh.view(), 1e300));
    const auto index = weld({mesh.positions, std::vector{0u, 1u, 9u}});
    REQUIRE(!index);
    CHECK(index.error().status == Status::mesh_rejected);
    CHECK(index.error().element == 0);
}
