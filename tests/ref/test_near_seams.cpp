// Border edges that nearly lie on others, and what only looks like that.
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "geodisk/weld.hpp"
#include "mesh/face_loss.hpp"
#include "support/meshes.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

NearSeams found_in(const TestMesh& mesh) {
    const auto found = find_near_seams(mesh.view());
    REQUIRE(found);
    return *found;
}

/// Every face with vertices of its own, each moved by up to `shift` along each axis.
TestMesh shaken(const TestMesh& mesh, double shift) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-shift, shift);
    TestMesh soup{{}, {}, mesh.dimension};
    for (const std::uint32_t v : mesh.triangles) {
        for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
            const double x = mesh.positions[std::size_t{v} * mesh.dimension + axis];
            soup.positions.push_back(x + (shift > 0 ? uniform(random) : 0));
        }
        soup.triangles.push_back(static_cast<std::uint32_t>(soup.triangles.size()));
    }
    return soup;
}

/// A plate of size 1 whose halves are this far apart, and a square of two sides of another size.
TestMesh plate_beside(double body, double gap) {
    return {{0,        0,        1,        0,        0,        1,        1,        1,
             1,        gap,      0,        1 + gap, //
             2 * body, 2 * body, 3 * body, 2 * body, 2 * body, 3 * body, 3 * body, 3 * body},
            {0, 1, 2, 4, 3, 5, 6, 7, 8, 7, 9, 8, 6, 7, 9, 6, 9, 8},
            2};
}

} // namespace

TEST_CASE("near seams: what is told joins a shaken soup, at any scale") {
    for (const double scale : {1e-30, 1e-6, 1.0, 1e6, 1e30}) {
        for (const double shift : {1e-15, 1e-9, 1e-7, 1e-6, 1e-5}) {
            CAPTURE(scale);
            CAPTURE(shift);
            TestMesh whole = builtin("icosphere", 3);
            for (double& x : whole.positions) {
                x *= scale;
            }
            const TestMesh soup = shaken(whole, shift * scale);
            const NearSeams seams = found_in(soup);
            CHECK(seams.edges == 3 * whole.face_count());
            CHECK(seams.gap <= 4 * shift * scale);
            CHECK(seams.degenerate_faces == 0);
            const auto joined = weld(soup.view(), seams.epsilon);
            REQUIRE(joined);
            const auto closed =
                PreparedMesh::prepare({soup.positions, joined->triangles, 3})->statistics();
            CHECK(closed.boundary_edges == 0);
            CHECK(closed.vertices == prepared(whole).statistics().vertices);
        }
    }
}

TEST_CASE("near seams: all are found where coordinates and lengths are round numbers") {
    for (const double size : {64.0, 100.0}) {
        const TestMesh whole = flat_grid(20, 10, size, size);
        const NearSeams seams = found_in(shaken(whole, size * 1e-5));
        CHECK(seams.edges == 3 * whole.face_count() - 2 * (20 + 10));
    }
}

TEST_CASE("near seams: a number of one digit where a power of ten joins too much") {
    // A strip whose seam is 2e-5 wide, and triangles of 5e-5 beside it.
    const TestMesh mesh{{0,    0, 1, 0,       1, 1, 0, 1, 1.00002, 0, 2, 0, 2, 1, 1.00002, 1, //
                         5e-5, 1, 0, 1 + 5e-5},
                        {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7, 3, 8, 9},
                        2};
    const NearSeams seams = found_in(mesh);
    CHECK(seams.edges == 2);
    CHECK(seams.epsilon == doctest::Approx(3e-5));
    CHECK(seams.degenerate_faces == 0);
}

TEST_CASE("near seams: not in meshes that are whole, coincide, or are narrow by themselves") {
    CHECK(found_in(builtin("icosphere", 3)).edges == 0);
    CHECK(found_in(flat_grid(50, 50, 1, 1)).edges == 0);
    CHECK(found_in(flat_grid(50, 50, 1, 1e-6)).edges == 0);
    CHECK(found_in(flat_grid(1, 1, 1, 1e-6)).edges == 0);
    CHECK(found_in(flat_grid(20, 2, 1, 1e-6)).edges == 0);
    CHECK(found_in(shaken(builtin("icosphere", 3), 0)).edges == 0);
    CHECK(found_in({{0, 0, 1, 0, 1, 1e-7}, {0, 1, 2}, 2}).edges == 0);
    // Sheets a thousandth of their size apart.
    TestMesh sheets = flat_grid(3, 3, 1, 1);
    const auto vertices = static_cast<std::uint32_t>(sheets.vertex_count());
    for (std::uint32_t v = 0; v < vertices; ++v) {
        const Vec3 p = sheets.vertex(v);
        sheets.add_vertex({p.x, p.y, 0.001});
    }
    const std::vector<std::uint32_t> triangles = sheets.triangles;
    for (const std::uint32_t v : triangles) {
        sheets.triangles.push_back(v + vertices);
    }
    CHECK(found_in(sheets).edges == 0);
}

TEST_CASE("near seams: the shortest edges that coordinates can have are looked through in time") {
    const double next = std::nextafter(1.0, 2.0);
    CHECK(found_in({{1, 0, next, 0, 1, 1, 2, 0}, {0, 1, 2, 1, 3, 2}, 2}).edges == 0);
    CHECK(found_in({{0, 1e8, 0, 1e-8, 1e8, 0, 0, 1e8 + 1, 0}, {0, 1, 2}, 3}).edges == 0);
}

TEST_CASE("near seams: parts far smaller than the whole have their own measure") {
    // Neighbours in a grid are a hundred thousandth of the box, but not of their edges.
    TestMesh mesh = flat_grid(30, 30, 1e-4, 1e-4);
    mesh = shaken(mesh, 0);
    const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
    mesh.positions.insert(mesh.positions.end(), {1, 0, 0, 2, 0, 0, 1, 1, 0});
    mesh.triangles.insert(mesh.triangles.end(), {first, first + 1, first + 2});
    CHECK(found_in(mesh).edges == 0);
}

TEST_CASE("near seams: of a small part beside a large one, at any scale and place") {
    for (const double scale : {1e-30, 1.0, 1e30}) {
        for (const double body : {1e-3, 1.0, 1e3, 1e9}) {
            for (const double gap : {1e-16, 1e-10, 1e-4}) {
                for (const double offset : {0.0, 1.0}) {
                    CAPTURE(scale);
                    CAPTURE(body);
                    CAPTURE(gap);
                    CAPTURE(offset);
                    TestMesh mesh = plate_beside(body, gap);
                    for (double& x : mesh.positions) {
                        x = scale * (x + offset * body);
                    }
                    const bool is_open = mesh.positions[3] != mesh.positions[9] ||
                                         mesh.positions[5] != mesh.positions[11];
                    const NearSeams seams = found_in(mesh);
                    if (!is_open) { // Rounding closes it.
                        CHECK(seams.edges == 0);
                        continue;
                    }
                    CHECK(seams.edges == 2);
                    CHECK(seams.degenerate_faces == 0);
                    REQUIRE(seams.epsilon > 0);
                    const auto joined = weld(mesh.view(), seams.epsilon);
                    REQUIRE(joined);
                    CHECK(joined->merged_vertices == 2);
                    CHECK(joined->degenerate_faces == 0);
                }
            }
        }
    }
    // No epsilon that weld() takes leaves the plate as it is.
    for (const double body : {1e15, 1e25, 1e99}) {
        const NearSeams seams = found_in(plate_beside(body, 1e-15));
        CHECK(seams.edges == 2);
        CHECK(seams.gap > 0);
        CHECK(seams.epsilon == 0);
        CHECK(seams.degenerate_faces == 0);
    }
}

TEST_CASE("near seams: faces that a chain of many vertices removes are told") {
    // A long triangle beside a seam, and vertices that lead from one of its corners to another.
    for (const std::uint32_t links : {2u, 40u, 400u, 4000u}) {
        CAPTURE(links);
        TestMesh mesh{{0, 0, 1, 0, 1, 1, 0, 1, 1.00002, 0, 2, 0, 2, 1, 1.00002, 1},
                      {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7},
                      2};
        const double step = 1.9e-5, end = links * step;
        const auto add = [&mesh](double x, double y) {
            mesh.triangles.push_back(mesh.vertex_count());
            mesh.positions.insert(mesh.positions.end(), {x, y});
        };
        add(0, 3), add(end, 3), add(0, 4);
        for (std::uint32_t link = 1; link < links; ++link) {
            add(link * step, 3), add(3, link), add(4, link);
        }
        const NearSeams seams = found_in(mesh);
        REQUIRE(seams.edges == 2);
        const auto joined = weld(mesh.view(), seams.epsilon);
        REQUIRE(joined);
        CHECK(seams.degenerate_faces == joined->degenerate_faces);
        CHECK(joined->degenerate_faces == 1);
    }
}

TEST_CASE("near seams: a soup with small gaps surely keeps its faces") {
    const TestMesh soup = shaken(builtin("icosphere", 3), 1e-7);
    CHECK(keeps_all_faces(soup.view(), 1e-6));
    CHECK_FALSE(keeps_all_faces(soup.view(), 1e-2)); // Sides are about 0.15 long.
}
