// Faces that are seen from outside: nested shells, sheets, boxes with holes, and odd meshes.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "geodisk/outside_faces.hpp"
#include "support/meshes.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

std::vector<std::uint8_t> seen_of(const TestMesh& mesh, double share = kOutsideShare) {
    const auto seen = outside_faces(mesh.view(), share);
    REQUIRE_MESSAGE(seen, seen.error().message);
    REQUIRE(seen->size() == mesh.face_count());
    return *seen;
}

std::size_t count(const std::vector<std::uint8_t>& seen) {
    return static_cast<std::size_t>(std::ranges::count(seen, 1));
}

/// Appends another mesh, scaled and moved.
void append(TestMesh& mesh, const TestMesh& other, double scale, double x = 0) {
    const std::uint32_t first = mesh.vertex_count();
    for (std::size_t i = 0; i < other.positions.size(); ++i) {
        mesh.positions.push_back(scale * other.positions[i] + (i % 3 == 0 ? x : 0));
    }
    for (const std::uint32_t v : other.triangles) {
        mesh.triangles.push_back(first + v);
    }
}

} // namespace

TEST_CASE("of nested shells the outermost is seen, and of separate ones all") {
    const TestMesh ball = builtin("icosphere", 3);
    TestMesh nested;
    append(nested, ball, 1);
    append(nested, ball, 0.9);
    append(nested, ball, 0.2);
    append(nested, ball, 0.5, 5);
    const auto seen = seen_of(nested);
    for (std::size_t f = 0; f < seen.size(); ++f) {
        const bool is_inner = f / ball.face_count() == 1 || f / ball.face_count() == 2;
        CHECK(seen[f] == (is_inner ? 0 : 1));
    }
    // Each face of a convex surface is seen by all rays on its side; beside another not quite.
    CHECK(count(seen_of(ball, 1)) == ball.face_count());
    CHECK(count(seen_of(nested, 1)) < 2 * ball.face_count());
    // What is inside a box along the axes, also where faces lie on each other.
    const TestMesh cube = builtin("cube", 4);
    TestMesh boxes;
    append(boxes, cube, 1);
    append(boxes, cube, 1);
    append(boxes, cube, 0.5);
    const auto of_boxes = seen_of(boxes);
    CHECK(std::all_of(of_boxes.begin(), of_boxes.begin() + 2 * cube.face_count(),
                      [](auto one) { return one == 1; }));
    CHECK(count(of_boxes) == 2 * cube.face_count());
}

TEST_CASE("more of a shell with a hole is seen, the wider the hole and the smaller the share") {
    const TestMesh ball = builtin("icosphere", 3);
    const auto with_hole = [&](double height) {
        TestMesh open{ball.positions, {}, 3};
        for (std::uint32_t f = 0; f < ball.face_count(); ++f) {
            if (ball.corner(f, 0).z < height) {
                open.triangles.insert(open.triangles.end(), &ball.triangles[3 * f],
                                      &ball.triangles[3 * f] + 3);
            }
        }
        const std::uint32_t shell = open.face_count();
        append(open, ball, 0.5);
        const auto seen = seen_of(open);
        CHECK(std::all_of(seen.begin(), seen.begin() + shell, [](auto one) { return one == 1; }));
        return std::count(seen.begin() + shell, seen.end(), 1);
    };
    const auto closed = with_hole(2), narrow = with_hole(0.9), wide = with_hole(0.5);
    CHECK(closed == 0);
    CHECK(narrow > 0);
    CHECK(wide > narrow);
    CHECK(wide < ball.face_count());
}

TEST_CASE("which way faces are turned does not matter, also where rays run along them") {
    TestMesh mesh;
    append(mesh, builtin("cube", 2), 1);
    append(mesh, builtin("cube", 2), 0.3, 0.2);
    TestMesh turned = mesh;
    for (std::uint32_t f = 0; f < turned.face_count(); ++f) {
        std::swap(turned.triangles[3 * f + 1], turned.triangles[3 * f + 2]);
    }
    for (const double share : {0.02, 0.5, 0.97, 1.0}) {
        CAPTURE(share);
        CHECK(seen_of(turned, share) == seen_of(mesh, share));
        CHECK(count(seen_of(mesh, share)) == mesh.face_count() / 2);
    }
}

TEST_CASE("sheets, faces without area and odd scales") {
    TestMesh sheet;
    sheet.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0};
    sheet.triangles = {0, 1, 2, 0, 2, 3, 0, 1, 4, 1, 1, 2};
    CHECK(seen_of(sheet, 1) == std::vector<std::uint8_t>{1, 1, 0, 0});
    for (const double scale : {1e-90, 1e90}) {
        TestMesh scaled;
        append(scaled, builtin("icosphere", 1), scale);
        append(scaled, builtin("icosphere", 1), scale / 2);
        CHECK(count(seen_of(scaled)) == 80);
    }
    TestMesh flat{{0, 0, 1, 0, 1, 1}, {0, 1, 2}, 2};
    CHECK(outside_faces(flat.view()).error().message ==
          "the mesh has 2 coordinates per vertex, and only in space faces are seen");
    CHECK(outside_faces(sheet.view(), 1.5).error().message ==
          "the share of rays is 1.5, not from 0 to 1");
    CHECK(!outside_faces(sheet.view(), std::nan("")));
    sheet.triangles.push_back(7);
    CHECK(!outside_faces(sheet.view()));
}

TEST_CASE("threads change nothing, and a run can be stopped") {
    TestMesh mesh;
    append(mesh, builtin("torus-knot", 24), 1);
    append(mesh, builtin("icosphere", 3), 0.3);
    const auto all = outside_faces(mesh.view(), 0.1, {.max_threads = 1});
    REQUIRE(all);
    CHECK(*all == *outside_faces(mesh.view(), 0.1, {.max_threads = 4}));
    CHECK(count(*all) > 100);
    CHECK(count(*all) < mesh.face_count());
    std::uint32_t told = 0;
    const auto stopped = outside_faces(mesh.view(), 0.1, {}, [&](const Progress& state) {
        told = state.decided;
        return false;
    });
    REQUIRE(!stopped);
    CHECK(stopped.error().status == Status::cancelled);
    CHECK(told > 0);
}
