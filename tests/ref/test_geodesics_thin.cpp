// Surfaces where windows become very many: thin tubes, tips and needles, which paths can wind
// around, edges of many faces, and triangles that lie on each other; and a surface of lengths that
// no space holds, where a shortest path may enter a face twice.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "lib/frame.hpp"
#include "ref/distance_check.hpp"
#include "support/oracle_geodesic.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

/// In each face, however small.
std::vector<Point> points_in_faces(const TestMesh& mesh) {
    std::vector<Point> points;
    for (std::uint32_t f = 0; f < prepared(mesh).face_count(); ++f) {
        points.push_back(face_point(f, 0.25, 0.4));
    }
    return points;
}

} // namespace

TEST_CASE("thin surfaces against CGAL, with few windows") {
    struct Case {
        const char* name;
        int resolution;
        // Without trimming up to 440; without turns_back() either, tens of thousands on the cone.
        std::uint32_t max_windows_per_face;
    };
    for (const Case& c : {Case{"tube", 6, 50}, {"cone", 8, 55}, {"spike", 6, 40}}) {
        const TestMesh mesh = builtin(c.name, c.resolution);
        const PreparedMesh surface = prepared(mesh);
        const std::vector<Point> points = points_in_faces(mesh);
        GeodesicOracle oracle(mesh);
        for (std::size_t s = 0; s < points.size(); s += 7) {
            const std::vector<double> truth = oracle.distances(points[s], points);
            const Truth lookup = [&](const Point&, std::size_t i) { return truth[i]; };
            for (const double reach : {0.05, 0.4, 1.0}) {
                CAPTURE(reach);
                check_distances({c.name, mesh, reach, {points[s]}, points, 1e-7}, lookup);
                GeodesicQuery<float> query(surface, reach, points,
                                           ref::frame_of(surface, reach).tolerances());
                query.from(points[s]);
                CHECK(query.count().windows <= c.max_windows_per_face * surface.face_count());
            }
        }
    }
}

TEST_CASE("in planes of a grid of tetrahedra straight lines are shortest, with few windows") {
    const TestMesh mesh = tetrahedra(6, 0);
    const PreparedMesh surface = prepared(mesh);
    std::vector<Point> in_plane;
    for (const Point& point : points_in_faces(mesh)) {
        if (mesh.position(point).z == 3) {
            in_plane.push_back(point);
        }
    }
    REQUIRE(in_plane.size() == 72);
    const Truth straight = [&](const Point& source, std::size_t i) {
        return length(mesh.position(in_plane[i]) - mesh.position(source));
    };
    check_distances({"tetrahedra", mesh, 2.5, {in_plane[5], in_plane[40]}, in_plane, 1e-8},
                    straight);
    GeodesicQuery<float> query(surface, 2.5, in_plane, ref::frame_of(surface, 2.5).tolerances());
    query.from(in_plane[40]);
    CHECK(query.count().windows > gpu::kUntrimmedWindows);
    CHECK(query.count().windows < 20000); // 90,000 without trimming.
}

TEST_CASE("across edges where seven sheets meet, with few windows") {
    TestMesh mesh = flat_grid(2, 1, 2, 1);
    const std::vector<std::uint32_t> once = mesh.triangles;
    for (int copy = 0; copy < 6; ++copy) {
        // Turned, so that each copy computes in frames of its own.
        for (std::size_t i = 0; i < once.size(); i += 3) {
            for (std::size_t k = 0; k < 3; ++k) {
                mesh.triangles.push_back(once[i + (k + static_cast<std::size_t>(copy)) % 3]);
            }
        }
    }
    const PreparedMesh surface = prepared(mesh);
    std::vector<Point> sources,
        targets; // Straight ways between them cross an edge, where all meet.
    for (const Point& point : points_in_faces(mesh)) {
        (point.face % 4 == 0 ? sources : targets).push_back(point);
    }
    REQUIRE(sources.size() == 7);
    check_straight({"copies", mesh, 3, sources, targets});
    GeodesicQuery<float> query(surface, 3, targets, ref::frame_of(surface, 3).tolerances());
    query.from(sources[0]);
    CHECK(query.count().windows > gpu::kUntrimmedWindows);
    CHECK(query.count().windows < 5000);
}

TEST_CASE("disks that begin to trim late, among many vertices, end") {
    const PreparedMesh surface = prepared(tetrahedra_beyond_sheet(3, 0.15, 40));
    const double reach = 60;
    const std::vector<Point> points = random_points(surface, 1, 12);
    const ref::Tolerances tolerances = ref::frame_of(surface, reach).tolerances();
    GeodesicQuery<float> query(surface, reach, points, tolerances);
    GeodesicQuery<double> exact(surface, reach, points, tolerances);
    std::uint32_t many = 0;
    for (const Point& source : points) {
        const auto found = query.from(source);
        const auto wanted = exact.from(source);
        many +=
            query.count().windows > gpu::kMaxWindows / 4 && query.count().vertices > 1000 ? 1u : 0u;
        for (std::size_t i = 0; i < points.size(); ++i) {
            CHECK((found[i] == doctest::Approx(wanted[i]).epsilon(tolerances.guard) ||
                   std::min(found[i], wanted[i]) > reach * (1 - tolerances.guard)));
        }
    }
    CHECK(many > 0);
}

TEST_CASE("sheets of needles upon each other take few windows") {
    const PreparedMesh surface = prepared(needle_sheets());
    const double reach = 3 * surface.statistics().diagonal;
    const std::vector<Point> points = random_points(surface, 1, 20);
    GeodesicQuery<double> query(surface, reach, points, ref::frame_of(surface, reach).tolerances());
    for (const Point& source : points) {
        query.from(source);
        CHECK(query.count().windows < 5000);
    }
}

TEST_CASE("disks among faces on top of each other end, wherever they begin") {
    const std::pair<const char*, double> cases[] = {{"layers_flat", 90}, {"layers_18", 4.55}};
    for (const auto& [name, distance] : cases) {
        const std::string file = std::string("cases/") + name + ".obj";
        CAPTURE(file);
        const PreparedMesh surface = prepared(shared_mesh(file).value());
        const std::vector<Point> points = random_points(surface, 1, 300);
        GeodesicQuery<float> query(surface, distance, points,
                                   ref::frame_of(surface, distance).tolerances());
        // The command verify looks somewhat farther.
        GeodesicQuery<double> exact(surface, 1.25 * distance, points, ref::double_tolerances());
        for (const Point& source : points) {
            query.from(source);
            exact.from(source);
            CHECK(query.count().windows < 5000);
            CHECK(exact.count().windows < 5000);
        }
    }
}

TEST_CASE("trimming leaves all distances, among triangles of many faces per edge") {
    const PreparedMesh surface = prepared(all_triangles(7));
    const double reach = 0.8;
    const std::vector<Point> points = random_points(surface, 1, 40);
    GeodesicQuery<double> all(surface, reach, points, ref::double_tolerances());
    GeodesicQuery<double> trimming(surface, reach, points, ref::double_tolerances());
    trimming.trim_all();
    std::uint32_t windows = 0, trimmed = 0;
    for (const Point& source : points) {
        const auto wanted = all.from(source);
        const auto found = trimming.from(source);
        windows += all.count().windows;
        trimmed += trimming.count().windows;
        for (std::size_t i = 0; i < points.size(); ++i) {
            CHECK((found[i] == wanted[i] || found[i] == doctest::Approx(wanted[i]).epsilon(1e-9)));
        }
    }
    CHECK(trimmed < windows / 2);
}

TEST_CASE("a disk that does not end is an error, and the next one is as ever") {
    const PreparedMesh surface = prepared(all_triangles(24));
    const double reach = 0.8;
    const std::vector<Point> points = random_points(surface, 1, 12);
    GeodesicQuery<double> query(surface, reach, points, ref::frame_of(surface, reach).tolerances());
    std::uint32_t endless = 0;
    for (const Point& source : points) {
        try {
            query.from(source);
        } catch (const ref::EndlessDisk& error) {
            const std::string face = "face " + std::to_string(source.face) + " ";
            CHECK(std::string(error.what()).find(face) != std::string::npos);
            ++endless;
        }
    }
    CHECK(endless > 0);
    CHECK(endless < points.size());
}

TEST_CASE("needles on a border that turns by a millionth: no path is lost") {
    // Two triangles along one line, found by a fuzzer; paths bend at vertex 1.
    TestMesh mesh;
    for (const Vec3& p : {Vec3{3, 3.00001, 0}, Vec3{5, 5, 0}, Vec3{0, 0, 0}, Vec3{7, 7.00001, 0}}) {
        mesh.add_vertex(p);
    }
    mesh.add_triangle(0, 2, 1);
    mesh.add_triangle(2, 1, 3);
    const std::vector<Point> points{face_point(0, 0, 0), face_point(1, 0.375, 0.625)};
    const PreparedMesh surface = prepared(mesh);
    for (const double reach : {5.0, 30.0}) {
        GeodesicQuery<double> query(surface, reach, points, ref::double_tolerances());
        const double expected = std::sqrt(8.0) + 0.625 * std::sqrt(8.0);
        CHECK(query.from(points[0])[1] == doctest::Approx(expected).epsilon(1e-5));
        CHECK(query.from(points[1])[0] == doctest::Approx(expected).epsilon(1e-5));
    }
}

TEST_CASE("a face of given lengths is entered twice where that is shorter") {
    // Around vertex 0 a wide face and two narrow ones, which are the shorter way from one side of
    // the wide one to the other: no space holds three triangles like these.
    constexpr double kSide = 1, kWide = 1.8, kNarrow = 0.2;
    const std::vector<std::uint32_t> triangles{0, 1, 2, 0, 2, 3, 0, 3, 1};
    const std::vector<double> lengths{kSide, kWide, kSide,   kSide, kNarrow,
                                      kSide, kSide, kNarrow, kSide};
    const PreparedMesh surface = PreparedMesh::prepare({triangles, lengths, 4}).value();
    // Both halfway out, at the same small angle from the sides of the wide face.
    constexpr double kInside = 0.05, kOut = 0.5;
    const Point source = face_point(0, kOut * (1 - kInside), kOut * kInside);
    const Point target = face_point(0, kOut * kInside, kOut * (1 - kInside));
    const double half = std::asin(kWide / 2 / kSide);
    const double x = kSide * std::cos(half), y = kWide / 2; // Vertices 1 and 2, from vertex 0.
    const double px = kOut * x, py = kOut * (1 - 2 * kInside) * y;
    const double from_side = half - std::atan2(py, px);
    const double turn = 2 * from_side + 4 * std::asin(kNarrow / 2 / kSide);
    const double expected = 2 * std::hypot(px, py) * std::sin(turn / 2);
    REQUIRE(expected < 2 * py);
    GeodesicQuery<double> query(surface, 1, {target}, tight_tolerances());
    CHECK(query.from(source).front() == doctest::Approx(expected).epsilon(1e-6));
}
