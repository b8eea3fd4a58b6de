// Flat triangles: a corner on the opposite side, to within rounding or exactly, sends paths on
// beyond that side. Distances are compared with those of unfolding alone, which follows every
// sequence of faces in extended precision.
#include <cmath>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "ref/dart_check.hpp"
#include "support/cap_distances.hpp"
#include "support/cap_meshes.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

/// Compares all ways to compute distances with the truth, from each point to each.
void check_pairs(const TestMesh& mesh, const PreparedMesh& surface,
                 const std::vector<Point>& points, double reach) {
    for (const WrongDistance& wrong : wrong_distances(mesh, surface, points, reach)) {
        FAIL_CHECK(wrong.text());
    }
}

/// Compares distances on the random mesh of a seed. Returns false if no face of it has area.
bool check_random(std::uint64_t seed) {
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    const Choose choose = [&](std::uint32_t below) {
        return static_cast<std::uint32_t>(random() % below);
    };
    const TestMesh mesh = cap_mesh(choose);
    const auto surface = PreparedMesh::prepare(mesh.view(), ThreadOptions{1});
    if (!surface) {
        return false;
    }
    std::vector<Point> points;
    for (int i = 0; i < 8; ++i) {
        points.push_back(point_of(mesh, choose));
    }
    const double part = 0.1 + choose(256) / 256.0;
    check_pairs(mesh, *surface, points, part * surface->statistics().diagonal);
    return true;
}

} // namespace

TEST_CASE("caps: distances on random meshes of flat triangles are those of unfolding, both ways") {
    for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
        check_random(seed);
    }
}

TEST_CASE(
    "caps: windows from a source close to an edge are not trimmed for one that lights beside") {
    // Vertices 10 and 6 are 1.4e-7 of the reach apart. Light from 10 that passes 6 on the other
    // side was dropped: a distance of 0.104 was 0.270.
    CHECK(check_random(132480));
}

TEST_CASE("caps: samples keep their distance along a path through a corner on the opposite side") {
    // Corner 4 of face 6 lies on its side from 8 to 3. Samples were 0.329 apart.
    const TestMesh mesh = shared_mesh("cases/cap_8.obj").value();
    SampleParams params;
    params.min_distance = 0.633;
    for (params.seed = 0; params.seed < 40; ++params.seed) {
        CAPTURE(params.seed);
        const std::vector<Point> samples = thrown<float>(prepared(mesh), params).samples();
        REQUIRE(samples.size() > 4);
        const DistanceTable truth = unfolded_distances(mesh, samples, params.min_distance);
        for (std::size_t a = 0; a < samples.size(); ++a) {
            for (std::size_t b = 0; b < samples.size(); ++b) {
                CHECK((a == b || truth[a][b] >= params.min_distance));
            }
        }
    }
}

TEST_CASE("caps: distances past a corner on the opposite side are equal both ways") {
    const TestMesh mesh = shared_mesh("cases/cap_8.obj").value();
    const PreparedMesh surface = prepared(mesh);
    for (const double reach : {0.633, 2.0}) {
        check_pairs(mesh, surface, random_points(surface, 3, 60), reach);
    }
}

TEST_CASE("caps: a corner on both sides of an edge, at every height, lights what lies beyond") {
    // Two rectangles that bend along an edge, with a cap on each side of it: paths go through both.
    for (int digits = 2; digits <= 19; ++digits) {
        for (const double beside : {0.0, 0.25}) {
            CAPTURE(digits);
            CAPTURE(beside);
            const double height = digits == 19 ? 0 : std::pow(10.0, -digits);
            TestMesh mesh;
            for (const Vec3& p :
                 {Vec3{-1, 0, 0}, Vec3{1, 0, 0}, Vec3{0, height, 0}, Vec3{beside, -height, 0},
                  Vec3{-1, 1, 0.5}, Vec3{0, 1, -0.5}, Vec3{1, 1, 0.5}, Vec3{-1, -1, 0.75},
                  Vec3{beside, -1, -0.5}, Vec3{1, -1, 0.25}}) {
                mesh.add_vertex(p);
            }
            const std::vector<std::uint32_t> triangles{0, 1, 2, 0, 3, 1, 0, 2, 4, 2, 5, 4, 2, 6, 5,
                                                       2, 1, 6, 0, 7, 3, 3, 7, 8, 3, 8, 9, 3, 9, 1};
            mesh.triangles = triangles;
            std::vector<Point> points;
            for (std::uint32_t face = 2; face < mesh.face_count(); ++face) {
                points.push_back(face_point(face, 0.3, 0.4));
                points.push_back(face_point(face, 0.6, 0.1));
            }
            for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
                points.push_back(points_at_vertex(mesh, v).front());
            }
            check_pairs(mesh, prepared(mesh), points, 2.5);
        }
    }
}
