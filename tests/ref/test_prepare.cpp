// PreparedMesh: frames, edge cycles, the area table, what is rejected, and the statistics.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "engine/domain/tolerances.hpp"
#include "geodisk/params.hpp"
#include "support/meshes.hpp"
#include "support/oracle_geodesic.hpp"
#include "support/stand_in_meshes.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::uint32_t end_of(const PreparedMesh& mesh, std::uint32_t h) {
    return mesh.half_edges()[next_in_face(h)].origin;
}

bool names_vertex_twice(const PreparedMesh& mesh, std::uint32_t face) {
    const auto h = mesh.half_edges().subspan(std::size_t{3} * face, 3);
    return h[0].origin == h[1].origin || h[1].origin == h[2].origin || h[2].origin == h[0].origin;
}

/// The half-edges met by walking around the edge of h once, at most `limit`.
std::vector<std::uint32_t> cycle_of(const PreparedMesh& mesh, std::uint32_t h, std::size_t limit) {
    std::vector<std::uint32_t> cycle{h};
    for (;;) {
        const std::uint32_t next = around_half_edge(mesh.half_edges()[cycle.back()].around);
        if (next == h || cycle.size() > limit) {
            return cycle;
        }
        cycle.push_back(next);
    }
}

/// Every half-edge's cycle holds exactly the half-edges of its edge, and tells their directions.
/// Returns how many edges have one, two and more faces.
std::array<std::uint64_t, 3> check_cycles(const PreparedMesh& mesh) {
    const auto half_edges = mesh.half_edges();
    std::map<Edge, std::vector<std::uint32_t>> edges;
    for (std::uint32_t h = 0; h < half_edges.size(); ++h) {
        if (names_vertex_twice(mesh, h / 3)) {
            REQUIRE(cycle_of(mesh, h, 1).size() == 1);
        } else {
            edges[std::minmax(half_edges[h].origin, end_of(mesh, h))].push_back(h);
        }
    }
    std::array<std::uint64_t, 3> counts{};
    for (const auto& [edge, own] : edges) {
        ++counts[std::min<std::size_t>(own.size(), 3) - 1];
        for (const std::uint32_t h : own) {
            std::vector<std::uint32_t> cycle = cycle_of(mesh, h, own.size());
            std::sort(cycle.begin(), cycle.end());
            REQUIRE(cycle == own);
            const std::uint32_t next = around_half_edge(half_edges[h].around);
            REQUIRE(around_same_way(half_edges[h].around) ==
                    (half_edges[next].origin == half_edges[h].origin));
        }
    }
    return counts;
}

/// Cycles and what the statistics say about them.
void check_edges(const TestMesh& mesh) {
    const PreparedMesh surface = prepared(mesh);
    const auto counts = check_cycles(surface);
    CHECK(surface.statistics().boundary_edges == counts[0]);
    CHECK(surface.statistics().nonmanifold_edges == counts[2]);
}

/// Every third face turned over.
TestMesh flipped(TestMesh mesh) {
    for (std::uint32_t f = 0; f < mesh.face_count(); f += 3) {
        std::swap(mesh.triangles[3 * f + 1], mesh.triangles[3 * f + 2]);
    }
    return mesh;
}

/// The three frames of a face must describe one triangle.
void check_frames(const PreparedMesh& mesh, double exactness) {
    const auto half_edges = mesh.half_edges();
    for (std::uint32_t h = 0; h < half_edges.size(); ++h) {
        const HalfEdge& edge = half_edges[h];
        const double next = half_edges[next_in_face(h)].length;
        const double previous = half_edges[previous_in_face(h)].length;
        const double unit = exactness * std::max({edge.length, next, previous});
        REQUIRE(edge.apex_y >= 0);
        REQUIRE(std::abs(std::hypot(edge.apex_x, edge.apex_y) - previous) <= unit);
        REQUIRE(std::abs(std::hypot(edge.length - edge.apex_x, edge.apex_y) - next) <= unit);
        const auto [cosine, sine] = edge.angle();
        REQUIRE(std::abs(cosine * previous - edge.apex_x) <= unit);
        REQUIRE(std::abs(sine * previous - edge.apex_y) <= unit);
        REQUIRE(std::abs(cosine * cosine + sine * sine - 1) <= 1e-15);
        const double area = edge.length * edge.apex_y;
        REQUIRE(std::abs(area - next * half_edges[next_in_face(h)].apex_y) <=
                unit * unit / exactness);
    }
}

double prepared_face_area(const PreparedMesh& mesh, std::uint32_t face) {
    const HalfEdge& edge = mesh.half_edges()[std::size_t{3} * face];
    return names_vertex_twice(mesh, face) ? 0 : 0.5 * edge.length * edge.apex_y;
}

void check_area(const TestMesh& mesh) {
    const PreparedMesh surface = prepared(mesh);
    double total = 0;
    for (std::uint32_t f = 0; f < surface.face_count(); ++f) {
        total += prepared_face_area(surface, f);
    }
    CHECK(total == doctest::Approx(surface.statistics().area).epsilon(1e-12));
}

Error rejection(const std::vector<double>& positions, const std::vector<std::uint32_t>& triangles,
                std::uint32_t dimension = 3) {
    const auto result = PreparedMesh::prepare({positions, triangles, dimension});
    REQUIRE(!result);
    CHECK(!result.error().message.empty());
    CHECK(result.error().message.find('\n') == std::string::npos);
    return result.error();
}

/// The mesh with each vertex a sum of two orthonormal directions of a higher space, by x and y.
PreparedMesh lifted(const TestMesh& flat, const std::vector<double>& along_x,
                    const std::vector<double>& along_y) {
    std::vector<double> positions;
    for (std::uint32_t v = 0; v < flat.vertex_count(); ++v) {
        for (std::size_t axis = 0; axis < along_x.size(); ++axis) {
            const Vec3 p = flat.vertex(v);
            positions.push_back(p.x * along_x[axis] + p.y * along_y[axis]);
        }
    }
    const auto dimension = static_cast<std::uint32_t>(along_x.size());
    auto result = PreparedMesh::prepare({positions, flat.triangles, dimension});
    REQUIRE(result);
    return std::move(*result);
}

const TestMesh kUnitTriangle{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}};

} // namespace

TEST_CASE("edges: border, manifold, same way, three faces") {
    const PreparedMesh triangle = prepared(kUnitTriangle);
    for (std::uint32_t h = 0; h < 3; ++h) {
        CHECK(triangle.half_edges()[h].around == (h << 1 | 1u));
    }
    // Faces 0 and 1 agree in orientation, 2 is turned over: along 0-2 the half-edges of all three.
    TestMesh book{{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 1, 1}, {0, 1, 2, 0, 2, 3}};
    const PreparedMesh pair = prepared(book);
    CHECK(pair.half_edges()[2].around == (3u << 1));
    CHECK(pair.half_edges()[3].around == (2u << 1));
    CHECK(pair.statistics().boundary_edges == 4);
    const PreparedMesh turned = prepared({book.positions, {0, 1, 2, 0, 3, 2}});
    CHECK(turned.half_edges()[2].around == (5u << 1 | 1u));
    CHECK(turned.half_edges()[5].around == (2u << 1 | 1u));
    book.add_triangle(0, 2, 4);
    const PreparedMesh three = prepared(book);
    CHECK(cycle_of(three, 2, 9) == std::vector<std::uint32_t>{2, 3, 6});
    CHECK(around_same_way(three.half_edges()[3].around));
    CHECK_FALSE(around_same_way(three.half_edges()[6].around));
    CHECK(three.statistics().nonmanifold_edges == 1);
    CHECK(three.statistics().boundary_edges == 6);
}

TEST_CASE("edges: cycles of meshes of every kind") {
    for (const TestMesh& mesh :
         {builtin("cube", 3), builtin("moebius", 3), builtin("lattice", 1), two_sided_square(),
          flat_irregular(8, 1), flipped(builtin("icosphere", 2)), flipped(builtin("moebius", 4))}) {
        check_edges(mesh);
    }
    for (const NamedMesh& one : meshes_like(
             {"bad/warn_nonmanifold_edge.obj", "bad/warn_duplicate_faces.obj",
              "bad/warn_duplicate_flipped.obj", "bad/warn_bowtie_closed.obj",
              "bad/warn_inconsistent_orientation.obj", "bad/warn_unwelded.obj",
              "bad/warn_repeated_index.obj", "meshes/cycloidal_43k.ply", "meshes/teapot_6k.obj"})) {
        INFO(one.name);
        check_edges(one.mesh);
        check_edges(flipped(one.mesh));
    }
}

TEST_CASE("frames: a triangle of sides 3, 4 and 5") {
    const PreparedMesh mesh = prepared({{0, 0, 0, 3, 0, 0, 0, 4, 0}, {0, 1, 2}});
    // Length, apex x and y, cosine and sine.
    const double expected[3][5] = {{3, 0, 4, 0, 1}, {5, 1.8, 2.4, 0.6, 0.8}, {4, 4, 3, 0.8, 0.6}};
    for (std::uint32_t h = 0; h < 3; ++h) {
        const HalfEdge& edge = mesh.half_edges()[h];
        const double found[5] = {edge.length, edge.apex_x, edge.apex_y, edge.angle().cosine,
                                 edge.angle().sine};
        for (std::size_t i = 0; i < 5; ++i) {
            CHECK(std::abs(found[i] - expected[h][i]) <= 1e-15);
        }
        CHECK(edge.origin == h);
    }
    CHECK(mesh.statistics().area == 6);
    CHECK(mesh.statistics().diagonal == 5);
    CHECK(mesh.statistics().longest_edge == 5);
}

TEST_CASE("frames: the three of a face describe one triangle") {
    check_frames(prepared(builtin("icosphere", 3)), 1e-14);
    check_frames(prepared(builtin("torus-knot", 8)), 1e-14);
    check_frames(prepared(flat_irregular(20, 3)), 1e-14);
    for (const NamedMesh& one :
         meshes_like({"meshes/tray_4k5.ply", "meshes/bunny_14k.obj", "meshes/cycloidal_43k.ply",
                      "bad/warn_sliver_fan.obj"})) {
        check_frames(prepared(one.mesh), 1e-13);
    }
}

TEST_CASE("blocks: copies of a surface are prepared alike, whichever thread takes them") {
    constexpr std::uint32_t kCopies = 20;
    const TestMesh one = builtin("icosphere", 4);
    const auto vertices = static_cast<std::uint32_t>(one.positions.size() / 3);
    TestMesh many;
    for (std::uint32_t copy = 0; copy < kCopies; ++copy) {
        many.positions.insert(many.positions.end(), one.positions.begin(), one.positions.end());
        for (const std::uint32_t v : one.triangles) {
            many.triangles.push_back(copy * vertices + v);
        }
        many.add_triangle(0, copy, copy);
    }
    const PreparedMesh alone = prepared(one);
    const PreparedMesh all = prepared(many);
    const auto count = static_cast<std::uint32_t>(alone.half_edges().size());
    REQUIRE(all.face_count() > 100000); // Several blocks of support/blocks.hpp.
    for (std::uint32_t h = 0; h < all.half_edges().size(); ++h) {
        const std::uint32_t first = h / (count + 3) * (count + 3); // Of the copy.
        if (h - first >= count) {
            continue;
        }
        const HalfEdge& expected = alone.half_edges()[h - first];
        const HalfEdge& found = all.half_edges()[h];
        REQUIRE(found.length == expected.length);
        REQUIRE(found.apex_x == expected.apex_x);
        REQUIRE(found.apex_y == expected.apex_y);
        REQUIRE(found.fan_angles == expected.fan_angles);
        REQUIRE(found.around == expected.around + 2 * first);
    }
    const MeshStatistics& statistics = all.statistics();
    CHECK(statistics.repeated_index_faces == kCopies);
    CHECK(statistics.components == kCopies);
    CHECK(statistics.longest_edge == alone.statistics().longest_edge);
    CHECK(statistics.area == doctest::Approx(kCopies * alone.statistics().area).epsilon(1e-12));
}

TEST_CASE("frames: a needle keeps its height") {
    // Along a slanted direction, so that no coordinate is the height itself; the foot lies inside,
    // at an end and beyond it.
    const Vec3 x = normalize(Vec3{2, -3, 5});
    const Vec3 y = normalize(cross(x, Vec3{1, 1, 1}));
    for (const double foot : {0.3, 1e-6, 0.0, -0.4}) {
        for (const double height : {1e-3, 1e-7}) {
            TestMesh needle;
            for (const Vec3& p : {Vec3{}, x, foot * x + height * y}) {
                needle.add_vertex(p);
            }
            needle.add_triangle(0, 1, 2);
            const PreparedMesh mesh = prepared(needle);
            // The coordinates' own rounding moves the corners by 1e-16.
            const double exactness = 1e-15 / height;
            for (std::uint32_t h = 0; h < 3; ++h) {
                const HalfEdge& edge = mesh.half_edges()[h];
                CHECK(edge.length * edge.apex_y == doctest::Approx(height).epsilon(exactness));
            }
            CHECK(mesh.half_edges()[0].apex_y == doctest::Approx(height).epsilon(exactness));
            CHECK(std::abs(mesh.half_edges()[0].apex_x - foot) <= 1e-15);
        }
    }
}

TEST_CASE("area: that of the faces") {
    check_area(kUnitTriangle);
    check_area(builtin("icosphere", 3));
    check_area(flat_grid(7, 5, 1, 1));
    check_area(flat_obtuse_fan(40));
    check_area(flat_lines({0, 1e-9, 1, 1e3}, {0, 1e-7, 1}));
    for (const NamedMesh& one :
         meshes_like({"meshes/fandisk_13k.obj", "meshes/tray_4k5.ply", "meshes/cycloidal_43k.ply",
                      "bad/warn_zero_area_cap.obj", "bad/warn_repeated_index.obj",
                      "bad/warn_coincident_corner.obj", "bad/warn_two_components.obj"})) {
        INFO(one.name);
        check_area(one.mesh);
    }
}

TEST_CASE("area: faces without it are counted") {
    // Face 1 is a line, 2 and 3 name a vertex twice, 4 is tiny.
    const std::vector<double> positions{0, 0, 1, 0, 0, 1, 0.5, 0, 1, 0, 1e-6, 0, 0, 1e-6, 0.5, 0};
    const std::vector<std::uint32_t> triangles{0, 1, 2, 0, 3, 1, 3, 7, 3, 0, 0, 2, 0, 5, 6};
    const auto mesh = PreparedMesh::prepare({positions, triangles, 2});
    REQUIRE(mesh);
    CHECK(mesh->statistics().area == doctest::Approx(0.5 + 0.5e-12).epsilon(1e-15));
    CHECK(mesh->statistics().zero_area_faces == 1);
    CHECK(mesh->statistics().repeated_index_faces == 2);
    CHECK(mesh->statistics().triangles == 5);
}

TEST_CASE("rejected: indices and coordinates, with the element named") {
    const std::vector<double> square{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const Error index = rejection(square, {0, 1, 2, 0, 2, 3, 1, 4, 2});
    CHECK(index.status == Status::mesh_rejected);
    CHECK(index.element == 2);
    CHECK(rejection(square, {0, 1, 2, 0, 0xffffffffu, 3}).element == 1);
    CHECK(rejection({}, {0, 1, 2}).element == 0);
    for (const double bad : {kNan, HUGE_VAL, -HUGE_VAL, 1.01e100, -1e200}) {
        for (const std::size_t axis : {0u, 1u, 2u}) {
            std::vector<double> positions = square;
            positions[9 + axis] = bad;
            const Error error = rejection(positions, {0, 1, 2, 0, 2, 3});
            CHECK(error.status == Status::mesh_rejected);
            CHECK(error.element == 3);
            // The same vertex unused is not looked at.
            const auto unused = PreparedMesh::prepare({positions, std::vector{0u, 1u, 2u}, 3});
            REQUIRE(unused);
            CHECK(unused->statistics().vertices == 3);
            CHECK(unused->statistics().diagonal == std::sqrt(2));
        }
    }
    const std::vector<double> largest{0, 0, 1e100, 0, 0, 1e100};
    CHECK(PreparedMesh::prepare({largest, std::vector{0u, 1u, 2u}, 2}));
}

TEST_CASE("rejected: nothing to sample") {
    const std::vector<double> line{0, 0, 0, 1, 1, 1, 2, 2, 2};
    const std::vector<double> point{5, 6, 7, 5, 6, 7, 5, 6, 7};
    for (const Error& error :
         {rejection(line, {0, 1, 2}), rejection(point, {0, 1, 2}), rejection(line, {0, 1, 1}),
          rejection(kUnitTriangle.positions, {0, 1, 1, 2, 2, 2}), rejection(line, {}),
          rejection({}, {})}) {
        CHECK(error.status == Status::mesh_rejected);
        CHECK(error.element == kNoElement);
    }
    CHECK(rejection({0, 0, 0, 1e-101, 0, 0, 0, 1e-101, 0}, {0, 1, 2}).message ==
          "the mesh is smaller than 1e-100; rescale it");
}

TEST_CASE("rejected: sizes and dimensions") {
    const std::vector<double> ten(10, 1.0);
    CHECK(rejection(ten, {0, 1, 2}).status == Status::invalid_argument);
    CHECK(rejection(kUnitTriangle.positions, {0, 1}).status == Status::invalid_argument);
    CHECK(rejection(kUnitTriangle.positions, {0, 1, 2, 0}).status == Status::invalid_argument);
    for (const std::uint32_t dimension : {0u, 1u, 9u, 0xffffffffu}) {
        const std::vector<double> positions(72, 1.0);
        CHECK(rejection(positions, {0, 1, 2}, dimension).status == Status::invalid_argument);
    }
}

TEST_CASE("dimensions: an isometric lift changes no length") {
    const TestMesh flat = flat_irregular(6, 4);
    const PreparedMesh model = prepared(flat);
    const double r = std::sqrt(0.5);
    const PreparedMesh lifts[] = {
        lifted(flat, {1, 0}, {0, 1}), lifted(flat, {0.5, 0.5, 0.5, 0.5}, {0.5, -0.5, 0.5, -0.5}),
        lifted(flat, {0, 0, r, 0, 0, 0, 0, r}, {0, 0.6, 0, 0, 0.8, 0, 0, 0})};
    for (const PreparedMesh& lift : lifts) {
        for (std::size_t h = 0; h < model.half_edges().size(); ++h) {
            const HalfEdge& a = model.half_edges()[h];
            const HalfEdge& b = lift.half_edges()[h];
            REQUIRE(std::abs(a.length - b.length) <= 1e-15);
            REQUIRE(std::abs(a.apex_x - b.apex_x) <= 2e-15);
            REQUIRE(std::abs(a.apex_y - b.apex_y) <= 2e-15);
            REQUIRE(std::abs(a.angle().cosine - b.angle().cosine) <= 1e-13);
            REQUIRE(std::abs(a.angle().sine - b.angle().sine) <= 1e-13);
            REQUIRE(a.around == b.around);
        }
        CHECK(lift.statistics().area == doctest::Approx(1).epsilon(1e-12));
    }
}

TEST_CASE("faces that name a vertex twice take no part but keep their index") {
    TestMesh mesh{{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 40, 0, 0, 0, 50, 0},
                  {0, 1, 2, 4, 4, 0, 0, 2, 3, 2, 5, 2}};
    const PreparedMesh surface = prepared(mesh);
    const MeshStatistics& statistics = surface.statistics();
    CHECK(surface.face_count() == 4);
    CHECK(statistics.triangles == 4);
    CHECK(statistics.repeated_index_faces == 2);
    CHECK(statistics.zero_area_faces == 0);
    CHECK(statistics.vertices == 4);
    CHECK(statistics.components == 1);
    CHECK(statistics.boundary_edges == 4);
    CHECK(statistics.diagonal == std::sqrt(2));
    CHECK(statistics.longest_edge == std::sqrt(2));
    CHECK(around_half_edge(surface.half_edges()[2].around) == 6);
    check_cycles(surface);
    for (const std::uint32_t corner : surface.corners()) {
        CHECK((corner / 3 == 0 || corner / 3 == 2));
    }
    CHECK(surface.corners().size() == 6);
    check_area(mesh);
}

namespace {

/// A row of the table in the data folder's README.
constexpr KnownMesh kKnownMeshes[] = {
    {"bunny_1k4.obj", 702, 1400, 0, 1, 0, 5.7766, 0.3158, {1.5546, 1.5363, 1.2056}},
    {"bunny_14k.obj", 7002, 14000, 0, 1, 0, 5.7511, 0.1642, {1.5505, 1.5384, 1.1997}},
    {"bunny_69k.ply", 34834, 69451, 223, 1, 0, 0.057129, 0.0049107, {0.1557, 0.15433, 0.12067}},
    {"bunny_144k.ply", 72002, 144000, 0, 1, 0, 5.7171, 0.061188, {1.5491, 1.5354, 1.1979}},
    {"gargoyle_52k.obj", 25953, 51902, 0, 1, 0, 7.5833, 0.026993, {1.5746, 1.9973, 1.3726}},
    {"armadillo_29k.obj", 14587, 29170, 0, 1, 0, 1.6057, 0.015784, {0.83759, 0.99786, 0.75276}},
    {"lucy_100k.ply", 49987, 99970, 0, 1, 0, 2.5578e+06, 101.84, {930.12, 533.77, 1597.2}},
    {"rocker_arm_20k.obj", 10044, 20088, 0, 1, 0, 1.2966, 0.083742, {0.30347, 0.51491, 1}},
    {"boot_40k.obj", 19931, 39906, 0, 1, 0, 0.15055, 0.014067, {0.30701, 0.20233, 0.11031}},
    {"mountain_51k.obj", 25600, 50562, 636, 1, 0, 1502.9, 1.3753, {32.988, 17.856, 32.982}},
    {"fandisk_13k.obj", 6475, 12946, 0, 1, 0, 60.669, 0.2863, {4.8279, 5.2445, 2.6803}},
    {"tray_4k5.ply", 2216, 4520, 0, 1, 0, 2.2441e+05, 79.326, {355.6, 3.175, 355.6}},
    {"cycloidal_43k.ply", 21384, 43368, 0, 100, 242, 48.842, 0.93446, {1.875, 1.8746, 1.1069}},
    {"human_neutral_21k.obj", 10475, 20908, 32, 3, 0, 1.837, 0.058074, {1.6379, 1.7211, 0.294}},
    {"human_man_14k.obj", 6890, 13776, 0, 1, 0, 1.9604, 0.065651, {1.8374, 1.7911, 0.30845}},
    {"human_woman_14k.obj", 6890, 13776, 0, 1, 0, 1.7176, 0.059784, {1.6704, 1.6584, 0.28697}},
    {"spot_pose_a_6k.obj", 2930, 5856, 0, 1, 0, 5.7095, 0.11878, {0.9431, 1.6904, 1.7179}},
    {"spot_pose_b_6k.obj", 2930, 5856, 0, 1, 0, 5.7288, 0.17196, {1.4348, 1.6553, 1.545}},
    {"teapot_6k.obj", 3644, 6320, 1036, 4, 0, 52.661, 0.41436, {6.434, 3.15, 4}},
    {"spot_quads_uv.obj", 188, 372, 0, 1, 0, 8.2496, 0.58866, {1.1719, 1.7432, 1.774}},
    {"negative_indices.obj", 8, 12, 0, 1, 0, 24, 2.8284, {2, 2, 2}},
    {"cornell_box_multimaterial.obj", 72, 36, 72, 18, 0, 1.9896e+06, 788.57, {556, 548.8, 559.2}},
};

void check_statistics(const KnownMesh& known, const TestMesh& mesh) {
    INFO(std::string(known.name));
    const PreparedMesh surface = prepared(mesh);
    const MeshStatistics& statistics = surface.statistics();
    CHECK(statistics.vertices == known.vertices);
    CHECK(statistics.triangles == known.triangles);
    CHECK(statistics.boundary_edges == known.border_edges);
    CHECK(statistics.components == known.components);
    CHECK(statistics.nonmanifold_edges == known.crowded_edges);
    CHECK(statistics.repeated_index_faces == 0);
    CHECK(statistics.zero_area_faces == 0);
    // Tables round to five digits.
    CHECK(statistics.area == doctest::Approx(known.area).epsilon(6e-5));
    CHECK(statistics.longest_edge == doctest::Approx(known.longest_edge).epsilon(6e-5));
    CHECK(statistics.diagonal == doctest::Approx(length(known.box)).epsilon(6e-5));
}

/// A factor between what the bound is and the largest of some CGAL distances.
double looseness(const TestMesh& mesh) {
    const PreparedMesh surface = prepared(mesh);
    const double bound = working_distance(surface, 1e30);
    GeodesicOracle oracle(mesh);
    std::vector<Point> points = random_points(surface, 17, 100);
    for (std::uint32_t v = 0; v < mesh.vertex_count(); v += 1 + mesh.vertex_count() / 50) {
        points.push_back(points_at_vertex(mesh, v).front());
    }
    double largest = 0;
    for (std::size_t source = 0; source < points.size(); source += 15) {
        for (const double distance : oracle.distances(points[source], points)) {
            largest = std::max(largest, std::isfinite(distance) ? distance : 0.0);
        }
    }
    return bound / largest;
}

} // namespace

TEST_CASE("statistics: as the shared data's table has them") {
    for (const KnownMesh& known : kKnownMeshes) {
        const auto mesh = shared_mesh("meshes/" + std::string(known.name));
        if (!mesh) {
            return;
        }
        check_statistics(known, *mesh);
    }
}

TEST_CASE("statistics: as the table of stand-ins has them") {
    for (const StandIn& one : stand_ins()) {
        check_statistics(one.known, stand_in_mesh(one.known.name));
    }
}

TEST_CASE("working distance: the minimum distance itself, up to a bound of all distances") {
    for (const TestMesh& mesh :
         {builtin("icosphere", 3), builtin("plate", 8), flat_grid(9, 2, 5, 1),
          builtin("folded-sheet", 4), builtin("torus-knot", 8), builtin("lattice", 1),
          prism_tube(12, 0.1, 3, 9)}) {
        const double factor = looseness(mesh);
        CHECK(factor >= 1);
        CHECK(factor <= 12);
        const PreparedMesh surface = prepared(mesh);
        const double bound = working_distance(surface, 1e30);
        for (const double distance : {1e-9, 0.5 * surface.statistics().diagonal,
                                      surface.statistics().diagonal, 0.999 * bound}) {
            CHECK(working_distance(surface, distance) == distance);
        }
        CHECK(working_distance(surface, 1e300) == bound);
    }
    // Parts far from each other: no path joins them, so the gap does not count.
    TestMesh apart = kUnitTriangle;
    const std::uint32_t first = apart.add_vertex({1e6, 0, 0});
    apart.add_vertex({1e6 + 1, 0, 0});
    apart.add_vertex({1e6, 1, 0});
    apart.add_triangle(first, first + 1, first + 2);
    CHECK(working_distance(prepared(apart), 1e9) < 10);
    CHECK(working_distance(prepared(apart), 1e5) == 1e5);
}
