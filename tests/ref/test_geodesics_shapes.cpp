// Curved and closed shapes whose distances are known by unfolding.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "ref/distance_check.hpp"
#include "support/cone_meshes.hpp"
#include "support/oracle_geodesic.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

constexpr double kPi = std::numbers::pi;

double planar(double x, double y) {
    return std::sqrt(x * x + y * y);
}

/// Both points of a two-sided square: straight on the same side, otherwise over the best border.
double two_sided_distance(const TestMesh& mesh, const Point& a, const Point& b, bool same_side) {
    const Vec3 p = mesh.position(a);
    const Vec3 q = mesh.position(b);
    if (same_side) {
        return length(p - q);
    }
    // Folding the back over a border mirrors it; the straight line then crosses that border inside
    // the square or meets a corner, where another border does no worse.
    double best = kUnreachable;
    const auto over = [&](double ax, double ay, double bx, double by) {
        best = std::min(best, planar(ax - bx, ay + by));
    };
    over(p.x, p.y, q.x, q.y);
    over(p.x, 1 - p.y, q.x, 1 - q.y);
    over(p.y, p.x, q.y, q.x);
    over(p.y, 1 - p.x, q.y, 1 - q.x);
    return best;
}

/// Distances of a prism tube by unrolling it.
double tube_distance(const TestMesh& mesh, std::uint32_t sides, double side, const Point& a,
                     const Point& b) {
    const auto along = [&](const Point& p) {
        const std::uint32_t wall = p.face / 2 % sides;
        // The first corner of either triangle of a wall lies on its left edge.
        const Vec3 left = mesh.corner(p.face, 0);
        const Vec3 at = mesh.position(p);
        return side * wall + planar(at.x - left.x, at.y - left.y);
    };
    const double round = side * sides;
    const double apart = std::abs(along(a) - along(b));
    return planar(std::min(apart, round - apart), mesh.position(a).z - mesh.position(b).z);
}

double point_distance(const TestMesh& mesh, const Point& a, const Point& b, double reach) {
    const PreparedMesh surface = prepared(mesh);
    return GeodesicQuery<double>(surface, reach, {b}, tight_tolerances()).from(a).front();
}

/// The point of the surface nearest to p, found by looking at every face: for points that lie on
/// an axis-parallel box.
Point box_point(const TestMesh& mesh, Vec3 p) {
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Vec3 a = mesh.corner(f, 0);
        const Vec3 u = mesh.corner(f, 1) - a;
        const Vec3 v = mesh.corner(f, 2) - a;
        const Vec3 n = cross(u, v);
        const double w1 = dot(cross(p - a, v), n) / dot(n, n);
        const double w2 = dot(cross(u, p - a), n) / dot(n, n);
        if (std::abs(dot(p - a, n)) < 1e-9 && w1 > -1e-9 && w2 > -1e-9 && w1 + w2 < 1 + 1e-9) {
            return face_point(f, w1, w2);
        }
    }
    FAIL("no face holds the point");
    return {};
}

TestMesh box(int resolution, Vec3 size) {
    TestMesh mesh = builtin("cube", resolution);
    double low[3] = {kUnreachable, kUnreachable, kUnreachable};
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        low[i % 3] = std::min(low[i % 3], mesh.positions[i]);
    }
    const double scale[3] = {size.x, size.y, size.z};
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        mesh.positions[i] = (mesh.positions[i] - low[i % 3]) * scale[i % 3];
    }
    return mesh;
}

} // namespace

TEST_CASE("two-sided square: opposite sides are not at distance 0") {
    const TestMesh coarse = two_sided_square();
    for (int times = 0; times < 4; ++times) {
        const TestMesh mesh = subdivided(coarse, times);
        const std::uint32_t front = mesh.face_count() / 2;
        const std::vector<Point> points = random_points(prepared(mesh), 31, 300);
        check_distances(
            {"two-sided square", mesh, 1.6, {points.begin(), points.begin() + 30}, points},
            [&](const Point& a, std::size_t i) {
                const bool same = (a.face < front) == (points[i].face < front);
                return two_sided_distance(mesh, a, points[i], same);
            });
    }
}

TEST_CASE("two-sided square: values by hand") {
    const TestMesh mesh = two_sided_square();
    const Point front = face_point(0, 0.5, 0.25); // (0.75, 0.25)
    // Back faces are (0, 3, 1) and (1, 3, 2).
    const Point behind = face_point(2, 0.25, 0.75); // On the back's diagonal, the same place.
    CHECK(point_distance(mesh, front, behind, 2) == doctest::Approx(0.5).epsilon(1e-12));
    const Point other = face_point(2, 0.5, 0.25); // (0.25, 0.5) on the back
    CHECK(point_distance(mesh, front, other, 2) ==
          doctest::Approx(planar(0.5, 0.75)).epsilon(1e-12));
}

TEST_CASE("cube: distances by unfolding") {
    for (const int resolution : {1, 2, 5}) {
        const TestMesh mesh = box(resolution, {1, 1, 1});
        const auto distance = [&](Vec3 a, Vec3 b) {
            return point_distance(mesh, box_point(mesh, a), box_point(mesh, b), 3);
        };
        CHECK(distance({0, 0, 0}, {1, 1, 1}) == doctest::Approx(std::sqrt(5)).epsilon(1e-7));
        CHECK(distance({0.5, 0.5, 0}, {0.5, 0.5, 1}) == doctest::Approx(2).epsilon(1e-7));
        CHECK(distance({0, 0, 0}, {1, 1, 0}) == doctest::Approx(std::sqrt(2)).epsilon(1e-7));
        CHECK(distance({0.5, 0.5, 0}, {0, 0, 1}) == doctest::Approx(std::sqrt(2.5)).epsilon(1e-7));
        CHECK(distance({0.25, 0.5, 0}, {0, 0.5, 0.25}) == doctest::Approx(0.5).epsilon(1e-7));
        // Over a side wall: unfolded, 1.5 along and 0.75 across.
        CHECK(distance({0.25, 0.125, 0}, {0.875, 0, 0.25}) ==
              doctest::Approx(planar(0.625, 0.375)).epsilon(1e-7));
    }
}

TEST_CASE("box: the spider and the fly are 40 apart, not 42") {
    for (const int resolution : {1, 3}) {
        const TestMesh mesh = box(resolution, {30, 12, 12});
        CHECK(point_distance(mesh, box_point(mesh, {0, 6, 11}), box_point(mesh, {30, 6, 1}), 50) ==
              doctest::Approx(40).epsilon(1e-6));
    }
}

TEST_CASE("cube: random pairs against CGAL") {
    const TestMesh mesh = box(3, {1, 1, 1});
    const std::vector<Point> points = random_points(prepared(mesh), 17, 500);
    GeodesicOracle oracle(mesh);
    for (std::size_t s = 0; s < 10; ++s) {
        const std::vector<double> truth = oracle.distances(points[s], points);
        check_distances({"cube", mesh, 2.6, {points[s]}, points},
                        [&](const Point&, std::size_t i) { return truth[i]; });
    }
}

TEST_CASE("tube: distances by unrolling") {
    for (const std::uint32_t sides : {3u, 4u, 7u, 24u}) {
        const double side = 1.0 / sides;
        const TestMesh mesh = prism_tube(sides, side, 0.7, 5);
        const std::vector<Point> points = random_points(prepared(mesh), 41, 400);
        const auto truth = [&](const Point& a, std::size_t i) {
            return tube_distance(mesh, sides, side, a, points[i]);
        };
        const std::vector<Point> sources(points.begin(), points.begin() + 20);
        check_distances({"tube", mesh, 0.9, sources, points}, truth);
        check_distances({"tube, disk", mesh, 0.3, sources, points}, truth);
    }
}

TEST_CASE("folded sheet and the same sheet unfolded: the same distances") {
    for (const int resolution : {2, 8}) {
        const TestMesh folded = builtin("folded-sheet", resolution);
        const TestMesh flat = builtin("unfolded-sheet", resolution);
        REQUIRE(folded.triangles == flat.triangles);
        const std::vector<Point> points = random_points(prepared(flat), 43, 500);
        const std::vector<Point> sources(points.begin(), points.begin() + 15);
        for (const double reach : {0.2, 5.3}) {
            check_straight({"unfolded sheet", flat, reach, sources, points});
            check_distances({"folded sheet", folded, reach, sources, points},
                            [&](const Point& a, std::size_t i) {
                                return length(flat.position(points[i]) - flat.position(a));
                            });
        }
    }
}

namespace {

void check_cone(const std::string& name, std::uint32_t sectors, double angle, double zigzag) {
    for (const int subdivisions : {0, 2}) {
        const Cone cone(sectors, angle, zigzag, subdivisions);
        const TestMesh& mesh = cone.mesh();
        std::vector<Point> points = random_points(prepared(mesh), 47, 300);
        std::vector<Point> sources(points.begin(), points.begin() + 15);
        // On and near the apex, on spokes, and on the first sector's middle, whose rays through the
        // apex hit the others symmetrically.
        const double small = 0x1p-20;
        for (const Point& p :
             {face_point(0, 0, 0), face_point(0, small, small), face_point(0, 0x1p-12, 0x1p-11),
              face_point(0, 0x1p-8, 0x1p-9), face_point(0, 0.5, 0), face_point(0, 0.25, 0.25)}) {
            sources.push_back(p);
            points.push_back(p);
        }
        for (std::uint32_t f = 0; f < mesh.face_count(); f += 5) {
            points.push_back(face_point(f, 0.5, 0));
            points.push_back(face_point(f, 0.25, 0.25));
        }
        // Beyond the rim lies nothing: the sectors are straight there and stay convex.
        check_distances({name, mesh, 2.1, sources, points},
                        [&](const Point& a, std::size_t i) { return cone.distance(a, points[i]); });
        check_distances({name + ", disk", mesh, 0.6, sources, points},
                        [&](const Point& a, std::size_t i) { return cone.distance(a, points[i]); });
    }
}

} // namespace

TEST_CASE("cone: convex vertices, from sharp to just below 2 pi") {
    for (const double part : {0.1, 0.5, 0.75, 0.95, 0.999, 1 - 2e-4, 1 - 1e-5, 1 - 1e-7}) {
        check_cone("cone of " + std::to_string(part), 8, 2 * kPi * part, 0);
        // A sharp cone has no room for folds.
        if (part >= 0.95) {
            check_cone("folded cone of " + std::to_string(part), 8, 2 * kPi * part, 0.3);
        }
    }
}

TEST_CASE("saddle exactly at 2 pi") {
    check_cone("flat fan", 8, 2 * kPi, 0);
    check_cone("folded fan", 8, 2 * kPi, 0.3);
    check_cone("sharply folded fan", 6, 2 * kPi, 0.5);
}

TEST_CASE("saddle: just above 2 pi and far above") {
    for (const double part : {1 + 1e-7, 1 + 1e-5, 1 + 2e-4, 1.001, 1.05, 1.3, 2.0, 3.0}) {
        check_cone("saddle of " + std::to_string(part), 10, 2 * kPi * part, 0);
    }
    // More than 8 radians is more than the packed angles of a fan hold.
    check_cone("wide saddle", 20, 16 * kPi, 0);
}

TEST_CASE("regular icosphere: many equal distances") {
    const TestMesh mesh = builtin("icosphere", 3);
    double lowest_plane = 1;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Vec3 a = mesh.corner(f, 0);
        const Vec3 n = cross(mesh.corner(f, 1) - a, mesh.corner(f, 2) - a);
        lowest_plane = std::min(lowest_plane, std::abs(dot(n, a)) / length(n));
    }
    std::vector<Point> targets;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        targets.push_back(points_at_vertex(mesh, v).front());
    }
    const PreparedMesh surface = prepared(mesh);
    GeodesicQuery<double> query(surface, 3.3, targets, tight_tolerances());
    GeodesicOracle oracle(mesh);
    for (const std::uint32_t v : {0u, 5u, 12u, 100u}) {
        const std::vector<double> found = query.from(targets[v]);
        const std::vector<double> truth = oracle.distances(targets[v], targets);
        for (std::uint32_t i = 0; i < targets.size(); ++i) {
            // Projecting to the sphere stretches a path by a factor between h and 1 / h.
            const Vec3 a = mesh.vertex(v);
            const Vec3 b = mesh.vertex(i);
            const double arc = std::atan2(length(cross(a, b)), dot(a, b));
            REQUIRE(found[i] >= arc * lowest_plane - 1e-12);
            REQUIRE(found[i] <= arc / lowest_plane + 1e-12);
            CHECK(found[i] == doctest::Approx(truth[i]).epsilon(1e-9));
        }
        check_distances({"icosphere", mesh, 3.3, {targets[v]}, targets},
                        [&](const Point&, std::size_t i) { return truth[i]; });
    }
}

TEST_CASE("disks that share depths find for each point the disk in which it is deepest") {
    constexpr std::uint32_t kDisks = 40;
    for (const bool trims : {false, true}) {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 8));
        const std::vector<Point> targets = random_points(mesh, 3, 500);
        std::vector<Point> centers = random_points(mesh, 4, kDisks);
        centers.back() = centers.front();
        const double unit = mesh.statistics().diagonal / 2;
        const ref::Surface<double> surface(mesh, unit);
        const auto points_of = [](const std::vector<Point>& from) {
            std::vector<ref::FacePoint<double>> points;
            for (const Point& p : from) {
                points.push_back({p.face, p.weight1, p.weight2});
            }
            return points;
        };
        const auto sources = points_of(centers);
        const ref::Bins<double> bins(surface, points_of(targets));
        ref::Detector<double> alone(surface, bins, ref::double_tolerances(), 1);
        ref::Detector<double> together(surface, bins, ref::double_tolerances(), 1);
        together.share_depths();
        if (trims) {
            together.trim_all();
        }
        std::vector<double> expected(targets.size()), found(targets.size());
        std::uint64_t windows_alone = 0, windows_together = 0;
        for (std::uint32_t i = 0; i < kDisks; ++i) {
            const double limit = 0.02 + 0.6 * (i * 7 % kDisks) / kDisks;
            std::vector<double> own(targets.size(), kUnreachable);
            const auto run = [&](ref::Detector<double>& detector, std::vector<double>& depths,
                                 const auto& check) {
                detector.set_limit(limit);
                return detector
                    .run(
                        sources[i], [](std::uint32_t) { return true; },
                        [&](std::uint32_t place, double distance) {
                            check(place, distance);
                            depths[place] = std::max(depths[place], limit - distance);
                        })
                    .windows;
            };
            windows_alone += run(alone, expected, [&](std::uint32_t place, double distance) {
                own[place] = std::min(own[place], distance);
            });
            windows_together += run(together, found, [&](std::uint32_t place, double distance) {
                CHECK(distance >= own[place] - 1e-9);
            });
        }
        std::size_t inside = 0;
        for (std::size_t i = 0; i < targets.size(); ++i) {
            INFO("point ", i);
            CHECK(found[i] == doctest::Approx(expected[i]).epsilon(1e-9));
            inside += expected[i] > 0 ? 1u : 0u;
        }
        CHECK(inside > targets.size() / 2);
        CHECK(windows_together < windows_alone / 2);
    }
}
