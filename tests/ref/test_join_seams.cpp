// Joining border edges that lie on each other, and nothing else.
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "geodisk/radius_field.hpp"
#include "geodisk/weld.hpp"
#include "support/meshes.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

using Faces = std::vector<std::array<std::uint32_t, 3>>;

/// A mesh with vertices of its own for each face, at the places given.
TestMesh soup(const std::vector<double>& places, const Faces& faces, std::uint32_t dimension = 3) {
    TestMesh mesh{{}, {}, dimension};
    for (const auto& face : faces) {
        for (const std::uint32_t place : face) {
            const auto first = places.begin() + std::ptrdiff_t{place} * dimension;
            mesh.positions.insert(mesh.positions.end(), first, first + dimension);
            mesh.triangles.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
        }
    }
    return mesh;
}

/// The mesh after joining, which a second call leaves alone.
struct Joined : WeldedMesh {
    explicit Joined(const TestMesh& mesh) : WeldedMesh(take(mesh, mesh.triangles)) {
        const WeldedMesh again = take(mesh, triangles);
        CHECK(again.joined_edges == 0);
        CHECK(again.triangles == triangles);
        statistics =
            PreparedMesh::prepare({mesh.positions, triangles, mesh.dimension, true})->statistics();
        const auto joins = PreparedMesh::prepare({mesh.positions, mesh.triangles, mesh.dimension});
        REQUIRE(joins);
        CHECK(joins->joined_edges() == joined_edges);
        CHECK(joins->joined_vertices().empty() == (joined_edges == 0));
        CHECK(joins->save().value() ==
              PreparedMesh::prepare({mesh.positions, triangles, mesh.dimension, true})
                  ->save()
                  .value());
        CHECK(statistics.coinciding_border_edges == 0);
    }

    static WeldedMesh take(const TestMesh& mesh, const std::vector<std::uint32_t>& triangles) {
        auto result = join_seams({mesh.positions, triangles, mesh.dimension});
        REQUIRE(result);
        return std::move(*result);
    }

    MeshStatistics statistics;
};

/// Places: a unit square, and what is beside it.
const std::vector<double> kPlaces{0, 0, 0, 1, 0, 0, 1,   1, 0, 0, 1,   0, //
                                  2, 0, 0, 2, 1, 0, 0.5, 0, 1, 1, 0.5, 0};

} // namespace

TEST_CASE("join_seams: a soup becomes the mesh it was made of") {
    for (const TestMesh& mesh :
         {builtin("icosphere", 3), builtin("moebius", 4), builtin("klein-bottle", 6),
          flat_grid(5, 4, 1, 1), tetrahedra(2, 0.1), two_sided_square()}) {
        const Joined joined(soup_of(mesh));
        const MeshStatistics whole = prepared(mesh).statistics();
        CHECK(joined.joined_edges == 3 * mesh.face_count() - whole.boundary_edges);
        CHECK(joined.statistics.vertices == whole.vertices);
        CHECK(joined.statistics.components == whole.components);
        CHECK(joined.statistics.boundary_edges == whole.boundary_edges);
        CHECK(joined.statistics.nonmanifold_edges == whole.nonmanifold_edges);
        CHECK(joined.statistics.area == whole.area);
        CHECK(joined.degenerate_faces == 0);
        CHECK(joined.vertices == weld(soup_of(mesh).view())->vertices);
        CHECK(Joined(mesh).triangles == mesh.triangles);
    }
}

TEST_CASE("join_seams: in 2 to 8 dimensions") {
    for (std::uint32_t dimension = 2; dimension <= 8; ++dimension) {
        std::vector<double> places;
        for (std::uint32_t v = 0; v < 4; ++v) {
            for (std::uint32_t axis = 0; axis < dimension; ++axis) {
                places.push_back(axis < 2 ? (v >> axis & 1) : 0.25 * v);
            }
        }
        places[4 * dimension - 1] = 7;
        CHECK(Joined(soup(places, {{0, 1, 2}, {1, 3, 2}}, dimension)).joined_edges == 2);
        // One of the two ends elsewhere, in the last coordinate.
        TestMesh apart = soup(places, {{0, 1, 2}, {1, 3, 2}}, dimension);
        apart.positions[4 * dimension - 1] += 1e-9;
        CHECK(Joined(apart).joined_edges == 0);
    }
}

TEST_CASE("join_seams: zero has no sign") {
    const TestMesh mesh{{0, 0, 1, 0, 0, 1, -0.0, 0, 1, -0.0, 1, -1}, {0, 1, 2, 4, 3, 5}, 2};
    const Joined joined(mesh);
    CHECK(joined.vertices == std::vector<std::uint32_t>{0, 1, 2, 0, 1, 5});
    CHECK(joined.joined_edges == 2);
}

TEST_CASE("join_seams: a seam that ends inside closes, both ends of each edge") {
    // A fan around a vertex, cut along one spoke: vertices 1 and 5 lie in one place.
    const TestMesh fan{
        {0, 0, 1, 0, 0, 1, -1, 0, 0, -1, 1, 0}, {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5}, 2};
    const Joined joined(fan);
    CHECK(joined.joined_edges == 2);
    CHECK(joined.merged_vertices == 1);
    CHECK(joined.statistics.boundary_edges == 4);
}

TEST_CASE("join_seams: closed parts that touch stay apart") {
    // Two tetrahedra with a common face, edge or vertex, by place alone.
    const Faces sides{{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    for (const std::uint32_t shared : {1u, 2u, 3u}) {
        TestMesh mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {}, 3};
        for (std::uint32_t v = 0; v < 4; ++v) {
            for (std::uint32_t axis = 0; axis < 3; ++axis) {
                const double x = mesh.positions[3 * v + axis];
                mesh.positions.push_back(v < shared ? x : -1 - x);
            }
        }
        for (const std::uint32_t first : {0u, 4u}) {
            for (const auto& side : sides) {
                for (const std::uint32_t v : side) {
                    mesh.triangles.push_back(first + v);
                }
            }
        }
        const Joined joined(mesh);
        CHECK(joined.joined_edges == 0);
        CHECK(joined.triangles == mesh.triangles);
        CHECK(joined.statistics.components == 2);
        CHECK(weld(mesh.view())->merged_vertices == shared);
    }
}

TEST_CASE("join_seams: borders that meet in a point, or overlap in part, do not join") {
    // By a corner; by a vertex on the other's border; by half an edge.
    CHECK(Joined(soup(kPlaces, {{0, 1, 3}, {1, 4, 5}})).joined_edges == 0);
    CHECK(Joined(soup(kPlaces, {{0, 1, 2}, {7, 4, 5}})).joined_edges == 0);
    CHECK(Joined(soup(kPlaces, {{0, 1, 2}, {1, 4, 7}, {7, 5, 2}})).joined_edges == 0);
}

TEST_CASE("join_seams: three borders in one place become an edge of three faces") {
    const Joined joined(soup(kPlaces, {{0, 1, 2}, {1, 0, 6}, {0, 1, 3}}));
    CHECK(joined.joined_edges == 3);
    CHECK(joined.merged_vertices == 4);
    CHECK(joined.statistics.nonmanifold_edges == 1);
    CHECK(joined.statistics.components == 1);
}

TEST_CASE("join_seams: sheets back to back join along their borders") {
    // With other diagonals, a closed surface; with the same, copies.
    const Faces front{{0, 1, 2}, {0, 2, 3}};
    TestMesh mesh{{}, {0, 1, 2, 0, 2, 3, 4, 5, 7, 5, 6, 7}, 3};
    for (int side = 0; side < 2; ++side) {
        mesh.positions.insert(mesh.positions.end(), kPlaces.begin(), kPlaces.begin() + 12);
    }
    const Joined closed(mesh);
    CHECK(closed.joined_edges == 8);
    CHECK(closed.statistics.boundary_edges == 0);
    CHECK(closed.statistics.nonmanifold_edges == 0);
    mesh.triangles = {0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6};
    const Joined copied(mesh);
    CHECK(copied.joined_edges == 8);
    CHECK(copied.triangles == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 0, 2, 1, 0, 3, 2});
}

TEST_CASE("join_seams: a face and its copy have one border") {
    TestMesh mesh = soup(kPlaces, {{0, 1, 2}, {0, 2, 3}});
    mesh.triangles.insert(mesh.triangles.end(), {2, 1, 0});
    const Joined joined(mesh);
    CHECK(joined.joined_edges == 2);
    CHECK(joined.merged_vertices == 2);
}

TEST_CASE("join_seams: faces that take no part have no borders") {
    TestMesh mesh = soup(kPlaces, {{0, 1, 2}, {0, 2, 3}});
    mesh.triangles[3] = mesh.triangles[4];
    CHECK(Joined(mesh).joined_edges == 0);
    // Nor do vertices that no face uses, whatever they are.
    mesh = soup(kPlaces, {{0, 1, 2}, {0, 2, 3}});
    mesh.positions.insert(mesh.positions.end(), 3, std::numeric_limits<double>::quiet_NaN());
    CHECK(Joined(mesh).joined_edges == 2);
}

TEST_CASE("join_seams: an edge without length is a point") {
    // Squares that touch in a corner, each with a flat triangle whose short side is there.
    std::vector<double> places = kPlaces;
    places.insert(places.end(), {1, 1, 0, 1, 1, 0, 2, 2, 0, 1, 2, 0}); // 8 and 9 are where 2 is.
    TestMesh mesh{places, {0, 1, 2, 0, 2, 8, 10, 11, 9, 10, 9, 2}, 3};
    mesh.positions.insert(mesh.positions.end(), {1, 1, 0});
    mesh.triangles[11] = 12;
    const Joined joined(mesh);
    CHECK(joined.joined_edges == 0);
    CHECK(joined.statistics.components == 2);
    // In a soup, what lies on both of their sides is joined.
    const Joined cap(soup(places, {{0, 1, 2}, {0, 2, 8}, {0, 8, 3}}));
    CHECK(cap.joined_edges == 4);
    CHECK(cap.degenerate_faces == 1);
    CHECK(cap.statistics.components == 1);
}

TEST_CASE("join_seams: is no more than welding, and done after one call") {
    // Few places, so that edges and faces lie on each other in every way.
    std::mt19937 random(5);
    const auto below = [&random](std::uint32_t n) {
        return static_cast<std::uint32_t>(random() % n);
    };
    for (int round = 0; round < 300; ++round) {
        CAPTURE(round);
        const std::uint32_t places = 4 + below(6);
        const std::uint32_t vertices = 3 * places;
        TestMesh mesh{{}, {}, 2};
        for (std::uint32_t v = 0; v < vertices; ++v) {
            const std::uint32_t place = below(places);
            mesh.positions.insert(mesh.positions.end(), {place % 4 / 4.0, place * place / 16.0});
        }
        mesh.positions.insert(mesh.positions.end(), {0, 0, 1, 0, 0, 1});
        mesh.triangles = {vertices, vertices + 1, vertices + 2}; // Of some area.
        for (std::uint32_t i = 0; i < 3 * vertices; ++i) {
            mesh.triangles.push_back(below(vertices));
        }
        const Joined joined(mesh);
        const auto all = weld(mesh.view());
        REQUIRE(all);
        for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            REQUIRE(all->vertices[joined.vertices[v]] == all->vertices[v]);
        }
    }
}

TEST_CASE("PreparedMesh joins seams unless the view keeps them") {
    const TestMesh mesh = soup_of(builtin("icosphere", 2));
    const PreparedMesh joined = prepared(mesh);
    const WeldedMesh welded = *join_seams(mesh.view());
    CHECK(std::ranges::equal(joined.joined_vertices(), welded.vertices));
    CHECK(joined.vertex_count() == mesh.vertex_count());
    CHECK(joined.face_count() == mesh.face_count());
    CHECK(joined.statistics().components == 1);
    MeshView view = mesh.view();
    view.keep_seams = true;
    const PreparedMesh kept = *PreparedMesh::prepare(view);
    CHECK(kept.joined_vertices().empty());
    CHECK(kept.joined_edges() == 0);
    CHECK(kept.statistics().components == mesh.face_count());
    CHECK(kept.statistics().coinciding_border_edges == 3 * mesh.face_count());

    // A face and its copy have one border, which a mesh without edges of a single face may have.
    TestMesh twice = soup(kPlaces, {{0, 1, 2}, {0, 2, 3}});
    twice.keep_seams = false;
    for (std::size_t i = 0; i < 6; ++i) {
        twice.triangles.push_back(twice.triangles[i]);
    }
    CHECK(prepared(twice).joined_edges() == 2);
    CHECK(prepared(twice).statistics().components == 1);
}

TEST_CASE("values of joined vertices are means") {
    const TestMesh mesh = soup_of(builtin("icosphere", 2));
    const WeldedMesh welded = *join_seams(mesh.view());
    const PreparedMesh joined = prepared(mesh);
    const PreparedMesh by_hand =
        *PreparedMesh::prepare({mesh.positions, welded.triangles, 3, true});
    std::vector<double> values;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        values.push_back(0.25 + v % 7 / 10.0);
    }
    const std::vector<double> means = *means_of_joined(welded.vertices, values);
    CHECK(*RadiusField::prepare(joined, values)->save() ==
          *RadiusField::prepare(by_hand, means)->save());
    CHECK(*RadiusField::from_density(joined, values)->save() ==
          *RadiusField::from_density(by_hand, means)->save());
    values[40] = -1; // A vertex that is merged into another one.
    REQUIRE(welded.vertices[40] != 40);
    CHECK(RadiusField::prepare(joined, values).error().element == 40);
    CHECK(RadiusField::from_density(joined, values).error().element == 40);
}

TEST_CASE("join_seams: what is refused") {
    const TestMesh mesh = flat_grid(1, 1, 1, 1);
    const auto result = join_seams({mesh.positions, std::vector{0u, 1u, 9u}});
    REQUIRE(!result);
    CHECK(result.error().status == Status::mesh_rejected);
    CHECK(result.error().element == 0);
}

TEST_CASE("means_of_joined: one mean for all that are joined") {
    const std::vector<std::uint32_t> vertices{0, 1, 0, 0, 4};
    const auto means = means_of_joined(vertices, std::vector<double>{1, 5, 2, 6, 7});
    REQUIRE(means);
    CHECK(*means == std::vector<double>{3, 5, 3, 3, 7});
    CHECK(!means_of_joined(vertices, std::vector<double>{1}));
    CHECK(!means_of_joined(std::vector{3u}, std::vector<double>{1}));
}
