// geodesic_distances() and geodesic_path(): what they ask for and return. That distances are right
// is checked by distance_check.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <geodisk/geodesics.hpp>
#include <geodisk/neighbours.hpp>

#include <doctest/doctest.h>

#include "support/meshes.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Sample sample_of(const Point& p) {
    return {p.face,
            {static_cast<float>(1 - p.weight1 - p.weight2), static_cast<float>(p.weight1),
             static_cast<float>(p.weight2)}};
}

std::vector<Sample> some_points(const PreparedMesh& mesh, std::uint64_t seed, std::uint32_t count) {
    std::vector<Sample> samples;
    for (const Point& point : random_points(mesh, seed, count)) {
        samples.push_back(sample_of(point));
    }
    return samples;
}

Sample at_vertex(const TestMesh& mesh, std::uint32_t v) {
    return sample_of(points_at_vertex(mesh, v).front());
}

std::vector<double> distances_to_nearest(const PreparedMesh& mesh,
                                         std::span<const Sample> sources) {
    DistanceQuery query;
    query.sources = sources;
    return geodesic_distances(mesh, query)->distances;
}

Vec3 position_of(const TestMesh& mesh, const PathPoint& point) {
    Vec3 place{0, 0, 0};
    for (std::uint32_t k = 0; k < 3; ++k) {
        place = place + point.weights[k] * mesh.corner(point.face, k);
    }
    return place;
}

/// Checks that a path of the mesh joins two points, in legs that sum up to its length, each within
/// one face.
void check_path(const TestMesh& mesh, const GeodesicPath& path, const Sample& from,
                const Sample& to) {
    REQUIRE(path.points.size() >= 2);
    const auto is_at = [](const PathPoint& point, const Sample& end) {
        bool is_same = point.face == end.face;
        for (int k = 0; k < 3; ++k) {
            is_same = is_same && std::abs(point.weights[k] - double{end.weights[k]}) < 1e-7;
        }
        return is_same;
    };
    CHECK(is_at(path.points.front(), from));
    CHECK(is_at(path.points.back(), to));
    double sum = 0;
    for (std::size_t i = 1; i < path.points.size(); ++i) {
        sum += length(position_of(mesh, path.points[i]) - position_of(mesh, path.points[i - 1]));
    }
    CHECK(sum == doctest::Approx(path.length).epsilon(1e-9));
}

bool is_refused(const Result<GeodesicDistances>& result, Status status, const std::string& text) {
    return !result && result.error().status == status &&
           result.error().message.find(text) != std::string::npos;
}

} // namespace

TEST_CASE("distances: around a cube's corner they go by the unfolded faces") {
    const TestMesh cube = builtin("cube", 1);
    const PreparedMesh mesh = prepared(cube);
    const std::vector<Sample> source{at_vertex(cube, 0)};
    std::vector<double> found = distances_to_nearest(mesh, source);
    std::ranges::sort(found);
    const double diagonal = std::numbers::sqrt2;
    const std::vector<double> truth{0, 1, 1, 1, diagonal, diagonal, diagonal, std::sqrt(5)};
    for (std::size_t i = 0; i < truth.size(); ++i) {
        CHECK(found[i] == doctest::Approx(truth[i]).epsilon(1e-14));
    }
}

TEST_CASE("distances: to the nearest of sources they are the least of those to each") {
    for (const TestMesh& shape : {builtin("torus-knot", 8), builtin("moebius", 12)}) {
        const PreparedMesh mesh = prepared(shape);
        std::vector<Sample> sources = some_points(mesh, 5, 6);
        sources.push_back(at_vertex(shape, 3));
        sources.push_back({0, {0.5f, 0.5f, 0}}); // On an edge.
        DistanceQuery query;
        query.sources = sources;
        const auto nearest = geodesic_distances(mesh, query);
        query.each = true;
        const auto rows = geodesic_distances(mesh, query);
        REQUIRE(nearest);
        REQUIRE(rows);
        CHECK(rows->nearest.empty());
        const std::size_t width = mesh.vertex_count();
        REQUIRE(rows->distances.size() == width * sources.size());
        for (std::size_t v = 0; v < width; ++v) {
            double least = kInfinity;
            for (std::size_t i = 0; i < sources.size(); ++i) {
                least = std::min(least, rows->distances[i * width + v]);
            }
            REQUIRE(nearest->distances[v] == doctest::Approx(least).epsilon(1e-12));
            const double own = rows->distances[nearest->nearest[v] * width + v];
            REQUIRE(own == doctest::Approx(least).epsilon(1e-12));
        }
    }
}

TEST_CASE("distances: they do not depend on threads") {
    const PreparedMesh mesh = prepared(builtin("torus-knot", 12));
    const std::vector<Sample> sources = some_points(mesh, 6, 9);
    DistanceQuery query;
    query.sources = sources;
    query.each = true;
    const auto one = geodesic_distances(mesh, query, ThreadOptions{1});
    const auto many = geodesic_distances(mesh, query, ThreadOptions{4});
    REQUIRE(one);
    REQUIRE(many);
    CHECK(one->distances == many->distances);
}

TEST_CASE("distances: a limit leaves out what is farther, and changes nothing else") {
    const PreparedMesh mesh = prepared(builtin("torus-knot", 12));
    const std::vector<Sample> sources = some_points(mesh, 7, 2);
    const std::vector<double> all = distances_to_nearest(mesh, sources);
    DistanceQuery query;
    query.sources = sources;
    query.within = 0.5 * *std::ranges::max_element(all);
    const auto near = geodesic_distances(mesh, query);
    REQUIRE(near);
    std::size_t left_out = 0;
    for (std::size_t v = 0; v < all.size(); ++v) {
        const bool is_near = all[v] <= query.within;
        left_out += is_near ? 0 : 1;
        REQUIRE(near->distances[v] == (is_near ? all[v] : kInfinity));
        REQUIRE((near->nearest[v] == GeodesicDistances::kNone) == !is_near);
    }
    CHECK(left_out > 0);
    CHECK(left_out < all.size());
}

TEST_CASE("distances: joined vertices have one, unused and unreached ones none") {
    TestMesh apart = two_sided_square(); // Two parts, and a vertex that no face uses.
    apart.add_vertex({9, 9, 9});
    const std::uint32_t first = apart.vertex_count();
    for (const Vec3& corner : {Vec3{5, 0, 0}, Vec3{6, 0, 0}, Vec3{5, 1, 0}}) {
        apart.add_vertex(corner);
    }
    apart.add_triangle(first, first + 1, first + 2);
    const std::vector<Sample> source{at_vertex(apart, 0)};
    const std::vector<double> found = distances_to_nearest(prepared(apart), source);
    CHECK(found[first - 1] == kInfinity);
    CHECK(found[first] == kInfinity);
    CHECK(found[1] < kInfinity);

    TestMesh soup = soup_of(builtin("cube", 2));
    soup.keep_seams = false;
    const PreparedMesh mesh = prepared(soup);
    REQUIRE(!mesh.joined_vertices().empty());
    const std::vector<Sample> point = some_points(mesh, 8, 1);
    const std::vector<double> joined = distances_to_nearest(mesh, point);
    for (std::size_t v = 0; v < joined.size(); ++v) {
        CHECK(joined[v] < kInfinity);
        CHECK(joined[v] == joined[mesh.joined_vertices()[v]]);
    }
}

TEST_CASE("paths: they join their ends in straight legs as long as the distance") {
    for (const char* const name : {"cube", "moebius", "folded-sheet", "spike", "drilled-plate"}) {
        INFO(name);
        const TestMesh shape = builtin(name, 4);
        const PreparedMesh mesh = prepared(shape);
        std::vector<Sample> ends = some_points(mesh, 9, 6);
        ends.push_back(at_vertex(shape, 2));
        ends.push_back(at_vertex(shape, shape.vertex_count() - 1));
        ends.push_back({1, {0, 0.25f, 0.75f}}); // On an edge.
        for (const Sample& from : ends) {
            DistanceQuery query;
            query.sources = std::span(&from, 1);
            query.targets = ends;
            const auto distances = geodesic_distances(mesh, query);
            REQUIRE(distances);
            for (std::size_t i = 0; i < ends.size(); ++i) {
                const auto path = geodesic_path(mesh, from, ends[i]);
                REQUIRE(path);
                check_path(shape, *path, from, ends[i]);
                CHECK(path->length == doctest::Approx(distances->distances[i]).epsilon(1e-11));
                const auto back = geodesic_path(mesh, ends[i], from);
                REQUIRE(back);
                CHECK(back->length == doctest::Approx(path->length).epsilon(1e-9));
            }
        }
    }
}

TEST_CASE("paths: over a vertex that two triangles share, whatever the rounding") {
    // The path to the second end was once lost where its parts summed up to one bit more.
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> coordinate(0, 1);
    for (int i = 0; i < 300; ++i) {
        CAPTURE(i);
        TestMesh mesh;
        for (int v = 0; v < 5; ++v) {
            mesh.add_vertex({coordinate(random), coordinate(random), coordinate(random)});
        }
        mesh.add_triangle(0, 1, 2);
        mesh.add_triangle(0, 3, 4);
        const Sample from = at_vertex(mesh, 1), to = at_vertex(mesh, 4);
        const auto path = geodesic_path(prepared(mesh), from, to);
        REQUIRE(path);
        CHECK(path->points.size() == 3);
        check_path(mesh, *path, from, to);
    }
}

TEST_CASE("distances: windows do not wind around long needles without end") {
    for (const double far : {1e3, 1e6, 1e12}) {
        CAPTURE(far);
        TestMesh mesh = builtin("icosphere", 2);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            mesh.positions[3 * 50 + axis] *= far;
        }
        const std::vector<Sample> ends{at_vertex(mesh, 0), at_vertex(mesh, 50)};
        DistanceQuery query;
        query.sources = ends;
        query.each = true;
        const auto found = geodesic_distances(prepared(mesh), query);
        REQUIRE(found);
        const std::size_t width = mesh.vertex_count();
        CHECK(found->distances[50] == doctest::Approx(found->distances[width]).epsilon(1e-12));
        CHECK(std::ranges::all_of(found->distances, [](double d) { return d < kInfinity; }));
    }
}

TEST_CASE("paths: across edges of three faces") {
    TestMesh book;
    for (const Vec3& corner :
         {Vec3{0, 0, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0.5}, Vec3{-1, 0, 0.5}, Vec3{0, 1, 0.5}}) {
        book.add_vertex(corner);
    }
    book.add_triangle(0, 1, 2);
    book.add_triangle(0, 1, 3);
    book.add_triangle(1, 0, 4);
    const PreparedMesh mesh = prepared(book);
    for (std::uint32_t a = 2; a < 5; ++a) {
        for (std::uint32_t b = 2; b < 5; ++b) {
            const Sample from = at_vertex(book, a), to = at_vertex(book, b);
            const auto path = geodesic_path(mesh, from, to);
            REQUIRE(path);
            check_path(book, *path, from, to);
            CHECK(path->length == doctest::Approx(a == b ? 0 : 2));
        }
    }
}

TEST_CASE("distances: bad queries are refused, and a caller can stop") {
    const TestMesh shape = builtin("icosphere", 4);
    const PreparedMesh mesh = prepared(shape);
    DistanceQuery query;
    CHECK(is_refused(geodesic_distances(mesh, query), Status::invalid_argument,
                     "there is no source"));
    std::vector<Sample> sources = some_points(mesh, 10, 2);
    query.sources = sources;
    for (const double within : {0.0, -1.0, std::nan("")}) {
        query.within = within;
        CHECK(is_refused(geodesic_distances(mesh, query), Status::invalid_argument, "limit"));
    }
    query.within = kInfinity;
    query.targets = sources;
    sources[1].face = mesh.face_count();
    CHECK(is_refused(geodesic_distances(mesh, query), Status::invalid_argument, "source 1"));
    const Sample good = sources[0];
    query.sources = std::span(&good, 1);
    CHECK(is_refused(geodesic_distances(mesh, query), Status::invalid_argument, "target 1"));
    CHECK(!geodesic_path(mesh, good, sources[1]));

    query.targets = {};
    for (const bool each : {false, true}) {
        query.each = each;
        int calls = 0;
        const auto stopped = geodesic_distances(mesh, query, {}, [&](const Progress& progress) {
            CHECK(progress.decided <= progress.candidates);
            return ++calls < 2;
        });
        CHECK(is_refused(stopped, Status::cancelled, ""));
        CHECK(calls == 2);
    }
}

TEST_CASE("paths: there is none between parts") {
    TestMesh apart = builtin("cube", 1);
    const std::uint32_t first = apart.vertex_count();
    for (const Vec3& corner : {Vec3{5, 0, 0}, Vec3{6, 0, 0}, Vec3{5, 1, 0}}) {
        apart.add_vertex(corner);
    }
    apart.add_triangle(first, first + 1, first + 2);
    const auto path = geodesic_path(prepared(apart), at_vertex(apart, 0), at_vertex(apart, first));
    REQUIRE(!path);
    CHECK(path.error().status == Status::invalid_argument);
    CHECK(path.error().message == "no path leads from one end to the other");
}

TEST_CASE("distances: too many edges of many faces are an error, not an endless search") {
    const auto endless = shared_mesh("cases/endless_by_batches.obj");
    REQUIRE(endless);
    const PreparedMesh mesh = prepared(*endless);
    const std::vector<Sample> sources = some_points(mesh, 11, 1);
    DistanceQuery query;
    query.sources = sources;
    CHECK(is_refused(geodesic_distances(mesh, query), Status::mesh_rejected,
                     "edges of more than two faces"));
}
