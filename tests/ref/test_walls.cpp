// Cutting meshes along walls: connected as without the faces, and as cut by hand along edges.
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "geodisk/geodesics.hpp"
#include "geodisk/walls.hpp"
#include "support/meshes.hpp"
#include "support/same_mesh.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

using Edge = std::array<std::uint32_t, 2>;
using Edges = std::vector<Edge>;

CutMesh cut_along(const TestMesh& mesh, const Walls& walls) {
    auto made = cut(mesh.triangles, mesh.vertex_count(), walls);
    REQUIRE_MESSAGE(made, made.error().message);
    return std::move(*made);
}

/// Returns the mesh that a cut makes.
TestMesh mesh_of(const TestMesh& mesh, const CutMesh& made) {
    TestMesh result{mesh.positions, made.triangles, mesh.dimension};
    for (const std::uint32_t v : made.copied) {
        const auto first = mesh.positions.begin() + std::ptrdiff_t{v} * mesh.dimension;
        const std::vector<double> point(first, first + mesh.dimension);
        result.positions.insert(result.positions.end(), point.begin(), point.end());
    }
    return result;
}

/// A square of 4 x 4 cells of two triangles; vertex x + 5 y is at (x, y).
TestMesh square() {
    TestMesh mesh;
    for (std::uint32_t y = 0; y <= 4; ++y) {
        for (std::uint32_t x = 0; x <= 4; ++x) {
            mesh.add_vertex({static_cast<double>(x), static_cast<double>(y), 0});
        }
    }
    for (std::uint32_t y = 0; y < 4; ++y) {
        for (std::uint32_t x = 0; x < 4; ++x) {
            const std::uint32_t v = x + 5 * y;
            mesh.add_triangle(v, v + 1, v + 6);
            mesh.add_triangle(v, v + 6, v + 5);
        }
    }
    return mesh;
}

double distance(const PreparedMesh& mesh, const Sample& from, const Sample& to) {
    DistanceQuery query;
    query.sources = std::span(&from, 1);
    query.targets = std::span(&to, 1);
    const auto found = geodesic_distances(mesh, query);
    REQUIRE(found);
    return found->distances[0];
}

/// The column of edges from (2, 0) to (2, `end`).
Edges column(std::uint32_t end) {
    Edges edges;
    for (std::uint32_t y = 0; y < end; ++y) {
        edges.push_back({2 + 5 * (y + 1), 2 + 5 * y}); // Either end may come first.
    }
    return edges;
}

std::string message_of(const TestMesh& mesh, const Walls& walls) {
    const auto made = cut(mesh.triangles, mesh.vertex_count(), walls);
    REQUIRE(!made);
    return made.error().message;
}

} // namespace

TEST_CASE("faces that are walls leave the mesh as if it never had them") {
    for (const auto& [name, whole] :
         meshes_like({"meshes/bunny_1k4.obj", "meshes/fandisk_13k.obj"})) {
        const std::string shown = name; // Lambdas of Clang 14 capture no bindings.
        CAPTURE(shown);
        std::vector<std::uint8_t> walls(whole.face_count());
        std::vector<std::uint32_t> others;
        for (std::uint32_t f = 0; f < whole.face_count(); ++f) {
            walls[f] = whole.corner(f, 0).x > whole.corner(0, 0).x ? 1 : 0;
            if (walls[f] == 0) {
                others.push_back(f);
            }
        }
        REQUIRE(others.size() < walls.size());
        const CutMesh made = cut_along(whole, {walls, {}});
        CHECK(made.copied.empty());
        const PreparedMesh cut_mesh = prepared(mesh_of(whole, made));
        TestMesh without{whole.positions, {}, 3};
        for (const std::uint32_t f : others) {
            without.triangles.insert(without.triangles.end(), &whole.triangles[3 * f],
                                     &whole.triangles[3 * f] + 3);
        }
        const PreparedMesh plain = prepared(without);
        CHECK(cut_mesh.statistics().area == plain.statistics().area);
        CHECK(cut_mesh.statistics().components == plain.statistics().components);
        CHECK(cut_mesh.statistics().boundary_edges == plain.statistics().boundary_edges);
        auto part = cut_mesh.part(others);
        std::vector<std::uint32_t> all(others.size());
        std::iota(all.begin(), all.end(), 0u);
        auto whole_part = plain.part(all);
        REQUIRE((part && whole_part));
        CHECK(same_mesh(*part, *whole_part));
    }
}

TEST_CASE("a wall of edges that ends in a face lets paths around its end alone") {
    const TestMesh whole = square();
    const Edges walls = column(3);
    const CutMesh made = cut_along(whole, {{}, walls});
    CHECK(made.copied == std::vector<std::uint32_t>{2, 7, 12});
    const PreparedMesh mesh = prepared(mesh_of(whole, made));
    CHECK(mesh.statistics().components == 1);
    CHECK(mesh.statistics().boundary_edges == 16 + 6);
    // The middles of the hypotenuses of two lower cells, at (1.5, 0.5) and (2.5, 0.5).
    const Sample left{2, {0.5f, 0, 0.5f}}, right{4, {0.5f, 0, 0.5f}};
    CHECK(distance(prepared(whole), left, right) == doctest::Approx(1));
    CHECK(distance(mesh, left, right) == doctest::Approx(2 * std::hypot(0.5, 2.5)));
}

TEST_CASE("walls of edges from border to border part a mesh, and closed ones enclose a room") {
    const TestMesh whole = square();
    const Edges across = column(4);
    const CutMesh parted = cut_along(whole, {{}, across});
    CHECK(parted.copied.size() == 5);
    CHECK(prepared(mesh_of(whole, parted)).statistics().components == 2);

    const Edges room{{6, 7}, {7, 12}, {12, 11}, {11, 6}}; // The cell at (1, 1).
    const CutMesh closed = cut_along(whole, {{}, room});
    CHECK(closed.copied.size() == 4);
    const PreparedMesh mesh = prepared(mesh_of(whole, closed));
    CHECK(mesh.statistics().components == 2);
    CHECK(mesh.statistics().boundary_edges == 16 + 8);
    CHECK(mesh.statistics().vertices == 25 + 4);
}

TEST_CASE("no path leads through a vertex that walls pass, also between other faces there") {
    TestMesh mesh; // Two quads and a triangle that touch in vertex 0 alone.
    mesh.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 0, 0, -1, -1, 0};
    mesh.triangles = {0, 1, 2, 0, 2, 3, 0, 4, 5};
    CHECK(prepared(mesh).statistics().components == 1);
    const Edges walls{{0, 2}};
    const CutMesh made = cut_along(mesh, {{}, walls});
    CHECK(made.copied == std::vector<std::uint32_t>{0, 0, 2});
    CHECK(prepared(mesh_of(mesh, made)).statistics().components == 3);
}

TEST_CASE("walls along borders part faces that touch in a vertex, unless they end there") {
    TestMesh bow;
    bow.positions = {0, 0, 0, 1, -1, 0, 1, 1, 0, 2, 0, 0, 2, 2, 0};
    bow.triangles = {0, 1, 2, 2, 3, 4};
    const Edges through{{0, 2}, {2, 4}}, end{{0, 2}};
    const CutMesh parted = cut_along(bow, {{}, through});
    CHECK(parted.copied == std::vector<std::uint32_t>{2});
    CHECK(prepared(mesh_of(bow, parted)).statistics().components == 2);
    CHECK(cut_along(bow, {{}, end}).copied.empty());
}

TEST_CASE("walls at an edge of three faces part all of them") {
    TestMesh mesh; // Three pages of a book, each of two triangles.
    mesh.positions = {0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, -1, -1, 0};
    mesh.triangles = {0, 1, 2, 0, 1, 3, 0, 1, 4};
    const Edges walls{{1, 0}};
    const CutMesh made = cut_along(mesh, {{}, walls});
    CHECK(made.copied == std::vector<std::uint32_t>{0, 0, 1, 1});
    CHECK(prepared(mesh_of(mesh, made)).statistics().components == 3);
}

TEST_CASE("walls that are nowhere are refused") {
    const TestMesh mesh = square();
    const std::vector<std::uint8_t> few(3);
    CHECK(message_of(mesh, {few, {}}) == "there are 3 bytes for walls, and 32 faces");
    const Edges outside{{0, 1}, {3, 25}}, none{{0, 1}, {0, 7}}, point{{6, 6}};
    CHECK(message_of(mesh, {{}, outside}) == "wall 1 names vertex 25, the mesh has 25");
    CHECK(message_of(mesh, {{}, none}) == "wall 1 is no edge: no face has the vertices 0 and 7");
    CHECK(message_of(mesh, {{}, point}) == "wall 0 is no edge: no face has the vertices 6 and 6");
    const auto wrong = cut(mesh.triangles, 24, {});
    REQUIRE(!wrong);
    CHECK(wrong.error().status == Status::mesh_rejected);
    CHECK(wrong.error().message == "face 30 names vertex 24, the mesh has 24");
    CHECK(cut_along(mesh, {}).triangles == mesh.triangles);
}
