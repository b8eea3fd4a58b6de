// Random pairs on meshes of every kind against CGAL, and what holds for any distance.
#include <cmath>

#include <doctest/doctest.h>

#include "lib/frame.hpp"
#include "ref/distance_check.hpp"
#include "support/oracle_geodesic.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

/// CGAL works in double throughout; long chains of windows cost it some of the last digits.
constexpr double kOracleError = 1e-7;

void check_against_oracle(const std::string& name, const TestMesh& mesh, std::size_t sources,
                          double reach_of_diagonal) {
    const PreparedMesh surface = prepared(mesh);
    const double reach = reach_of_diagonal * surface.statistics().diagonal;
    const std::vector<Point> points = random_points(surface, 67, 400);
    GeodesicOracle oracle(mesh);
    for (std::size_t s = 0; s < sources; ++s) {
        const std::vector<double> truth = oracle.distances(points[s], points);
        const Truth lookup = [&](const Point&, std::size_t i) { return truth[i]; };
        check_distances({name, mesh, reach, {points[s]}, points, kOracleError}, lookup);
        check_distances({name + ", disk", mesh, 0.2 * reach, {points[s]}, points, kOracleError},
                        lookup);
    }
}

void check_shared_mesh(const std::string& name, std::size_t sources) {
    for (const auto& [shown, mesh] : meshes_like({"meshes/" + name})) {
        check_against_oracle(shown, mesh, sources, 1.0);
    }
}

/// d(a, b) = d(b, a) and d(a, c) <= d(a, b) + d(b, c), in double and, up to the guard, in float.
void check_metric(const std::string& name, const TestMesh& mesh) {
    const PreparedMesh surface = prepared(mesh);
    const double reach = 3 * surface.statistics().diagonal;
    const std::vector<Point> points = random_points(surface, 71, 60);
    const ref::Tolerances documented = ref::frame_of(surface, reach).tolerances();
    GeodesicQuery<double> query(surface, reach, points, tight_tolerances());
    GeodesicQuery<float> twin(surface, reach, points, documented);
    std::vector<std::vector<double>> d;
    std::vector<std::vector<double>> t;
    for (const Point& p : points) {
        d.push_back(query.from(p));
        t.push_back(twin.from(p));
    }
    const double exact = 1e-9 * reach;
    const double guard = documented.guard * reach;
    INFO(name);
    for (std::size_t a = 0; a < points.size(); ++a) {
        REQUIRE(d[a][a] <= exact);
        for (std::size_t b = 0; b < points.size(); ++b) {
            if (d[a][b] == kUnreachable) {
                REQUIRE(d[b][a] == kUnreachable);
                continue;
            }
            REQUIRE(std::abs(d[a][b] - d[b][a]) <= exact);
            REQUIRE(std::abs(t[a][b] - t[b][a]) <= 2 * guard);
            for (std::size_t c = 0; c < points.size(); ++c) {
                REQUIRE(d[a][c] <= d[a][b] + d[b][c] + exact);
                REQUIRE(t[a][c] <= t[a][b] + t[b][c] + 3 * guard);
            }
        }
    }
}

} // namespace

TEST_CASE("oracle: CGAL on values known by hand") {
    const TestMesh square = two_sided_square();
    GeodesicOracle oracle(square);
    CHECK(oracle.distance(face_point(0, 0.5, 0.25), face_point(2, 0.25, 0.75)) ==
          doctest::Approx(0.5).epsilon(1e-12));
    const TestMesh cube = builtin("cube", 1);
    GeodesicOracle on_cube(cube);
    std::uint32_t opposite = 0;
    for (std::uint32_t v = 0; v < 8; ++v) {
        const Vec3 apart = cube.vertex(v) - cube.vertex(0);
        opposite = dot(apart, apart) > 2.5 ? v : opposite;
    }
    for (const Point& from : points_at_vertex(cube, 0)) {
        for (const Point& to : points_at_vertex(cube, opposite)) {
            CHECK(on_cube.distance(from, to) == doctest::Approx(std::sqrt(5)).epsilon(1e-9));
        }
    }
}

TEST_CASE("random pairs against CGAL: built-in shapes") {
    check_against_oracle("icosphere", builtin("icosphere", 3), 4, 1.0);
    check_against_oracle("torus-knot", builtin("torus-knot", 8), 4, 2.0);
    check_against_oracle("plate", builtin("plate", 8), 4, 1.2);
    check_against_oracle("terrain", builtin("terrain", 24), 4, 1.5);
    check_against_oracle("lattice", builtin("lattice", 1), 2, 1.0);
}

TEST_CASE("random pairs against CGAL: bunny") {
    check_shared_mesh("bunny_1k4.obj", 5);
}

TEST_CASE("random pairs against CGAL: spot") {
    check_shared_mesh("spot_pose_a_6k.obj", 3);
}

TEST_CASE("random pairs against CGAL: tray with slivers") {
    check_shared_mesh("tray_4k5.ply", 3);
}

TEST_CASE("random pairs against CGAL: fandisk") {
    check_shared_mesh("fandisk_13k.obj", 2);
}

TEST_CASE("symmetry d(a,b) = d(b,a) and triangle inequality") {
    check_metric("icosphere", builtin("icosphere", 2));
    check_metric("moebius", builtin("moebius", 4));
    check_metric("two-sided square", subdivided(two_sided_square(), 2));
    for (const auto& [name, mesh] :
         meshes_like({"meshes/bunny_1k4.obj", "meshes/tray_4k5.ply", "meshes/teapot_6k.obj",
                      "bad/warn_nonmanifold_edge.obj", "bad/warn_bowtie_closed.obj",
                      "bad/warn_sliver_fan.obj"})) {
        check_metric(name, mesh);
    }
}
