// Surfaces that are no manifolds, have several parts, or hold faces without area.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "lib/frame.hpp"
#include "ref/distance_check.hpp"
#include "support/oracle_geodesic.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

double distance(const TestMesh& mesh, const Point& a, const Point& b, double reach) {
    const PreparedMesh surface = prepared(mesh);
    const double found =
        GeodesicQuery<double>(surface, reach, {b}, tight_tolerances()).from(a).front();
    const ref::Tolerances documented = ref::frame_of(surface, reach).tolerances();
    const double twin = GeodesicQuery<float>(surface, reach, {b}, documented).from(a).front();
    if (found == kUnreachable) {
        CHECK(twin == kUnreachable);
    } else {
        CHECK(std::abs(twin - found) <= documented.guard * reach);
    }
    return found;
}

Point at_vertex(const TestMesh& mesh, std::uint32_t v) {
    return points_at_vertex(mesh, v).front();
}

/// Sheets of 1 x 1 joined along the edge x = 0, like the pages of a book.
struct Book {
    TestMesh mesh;
    std::uint32_t faces_per_page;

    Book(std::uint32_t pages, std::uint32_t parts) : faces_per_page(2 * parts * parts) {
        for (std::uint32_t j = 0; j <= parts; ++j) {
            mesh.add_vertex({0, 0, static_cast<double>(j) / parts});
        }
        for (std::uint32_t page = 0; page < pages; ++page) {
            add_page(page, 0.1 + 0.9 * page, parts);
        }
    }

    void add_page(std::uint32_t page, double angle, std::uint32_t parts) {
        const std::uint32_t first = mesh.vertex_count();
        for (std::uint32_t i = 1; i <= parts; ++i) {
            for (std::uint32_t j = 0; j <= parts; ++j) {
                const double out = static_cast<double>(i) / parts;
                mesh.add_vertex(
                    {out * std::cos(angle), out * std::sin(angle), static_cast<double>(j) / parts});
            }
        }
        const auto vertex = [=](std::uint32_t i, std::uint32_t j) {
            return i == 0 ? j : first + (i - 1) * (parts + 1) + j;
        };
        for (std::uint32_t i = 0; i < parts; ++i) {
            for (std::uint32_t j = 0; j < parts; ++j) {
                const std::uint32_t q[4] = {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1),
                                            vertex(i, j + 1)};
                // Pages in turns oriented one way and the other.
                const std::uint32_t k = page % 2 == 0 ? 1 : 3;
                mesh.add_triangle(q[0], q[k], q[2]);
                mesh.add_triangle(q[0], q[2], q[4 - k]);
            }
        }
    }

    double truth(const Point& a, const Point& b) const {
        const Vec3 p = mesh.position(a);
        const Vec3 q = mesh.position(b);
        if (a.face / faces_per_page == b.face / faces_per_page) {
            return length(p - q);
        }
        return std::hypot(std::hypot(p.x, p.y) + std::hypot(q.x, q.y), p.z - q.z);
    }
};

} // namespace

TEST_CASE("zero-area cap: paths cross it") {
    const auto cap = shared_mesh("bad/warn_zero_area_cap.obj");
    if (!cap) {
        return;
    }
    CHECK(distance(*cap, at_vertex(*cap, 1), at_vertex(*cap, 3), 2) ==
          doctest::Approx(std::sqrt(2)).epsilon(1e-12));
    const std::vector<Point> points = random_points(prepared(*cap), 3, 200);
    check_straight({"zero-area cap", *cap, 1.5, {points.begin(), points.begin() + 40}, points});
    const TestMesh finer = subdivided(*cap, 2);
    const std::vector<Point> more = random_points(prepared(finer), 3, 200);
    check_straight({"zero-area caps", finer, 1.5, {more.begin(), more.begin() + 40}, more});
}

TEST_CASE("zero-length edges: a vertex split into coincident ones keeps all distances") {
    // Vertex 0 of a small fan becomes two at the same place, joined by two faces without area.
    const TestMesh whole{{0, 0, 1, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0},
                         {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1}};
    TestMesh split = whole;
    const std::uint32_t twin = split.add_vertex(whole.vertex(0));
    split.triangles = {0, 1, 2, 0, 2, 3, twin, 3, 4, twin, 4, 1, 0, 3, twin, 0, twin, 1};
    for (const int times : {0, 2}) {
        const TestMesh mesh = subdivided(split, times);
        const TestMesh model = subdivided(whole, times);
        std::vector<Point> points = random_points(prepared(model), 9, 300);
        std::vector<Point> sources(points.begin(), points.begin() + 20);
        // As near to the apex as a candidate can be.
        sources.push_back(face_point(0, 0x1p-13, 0x1p-13));
        sources.push_back(face_point(0, 0x1p-24, 0x1p-12));
        points.push_back(points_at_vertex(model, 0).front());
        GeodesicQuery<double> query(prepared(model), 4, points, tight_tolerances());
        for (const Point& source : sources) {
            const std::vector<double> truth = query.from(source);
            check_distances({"split apex", mesh, 4, {source}, points},
                            [&](const Point&, std::size_t i) { return truth[i]; });
        }
    }
}

TEST_CASE("bow-tie vertex: a path passes through it") {
    const auto tie = shared_mesh("bad/warn_bowtie_vertex.obj");
    if (!tie) {
        return;
    }
    // (1, 0) is the middle of the side opposite to the tie.
    CHECK(distance(*tie, face_point(0, 0.5, 0.5), face_point(1, 0.5, 0.5), 3) ==
          doctest::Approx(2).epsilon(1e-12));
    for (const int times : {0, 3}) {
        const TestMesh mesh = subdivided(*tie, times);
        const std::uint32_t half = mesh.face_count() / 2;
        const std::vector<Point> points = random_points(prepared(mesh), 13, 200);
        check_distances({"bow-tie", mesh, 3, {points.begin(), points.begin() + 40}, points},
                        [&](const Point& a, std::size_t i) {
                            const Vec3 p = mesh.position(a);
                            const Vec3 q = mesh.position(points[i]);
                            return (a.face < half) == (points[i].face < half)
                                       ? length(p - q)
                                       : length(p) + length(q);
                        });
    }
}

TEST_CASE("bow-tie of closed parts: through the common vertex") {
    const auto tie = shared_mesh("bad/warn_bowtie_closed.obj");
    if (!tie) {
        return;
    }
    const PreparedMesh surface = prepared(*tie);
    std::vector<Point> points = random_points(surface, 13, 300);
    const auto fan =
        static_cast<std::uint32_t>(std::max_element(surface.fans().begin(), surface.fans().end(),
                                                    [](const VertexFan& a, const VertexFan& b) {
                                                        return a.corner_count < b.corner_count;
                                                    }) -
                                   surface.fans().begin());
    points.push_back(at_vertex(*tie, fan));
    GeodesicQuery<double> query(surface, 6, points, tight_tolerances());
    const std::vector<double> from_tie = query.from(points.back());
    for (std::size_t s = 0; s < 20; ++s) {
        const std::vector<double> found = query.from(points[s]);
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (points[s].face / 4 != points[i].face / 4) {
                CHECK(found[i] == doctest::Approx(from_tie[s] + from_tie[i]).epsilon(1e-9));
            }
        }
    }
}

TEST_CASE("three triangles on an edge: paths between any two sheets") {
    const auto file = shared_mesh("bad/warn_nonmanifold_edge.obj");
    if (file) {
        // Middles of the far sides of sheets 0 and 1, unfolded about the z axis: the sheets' third
        // vertices are 1 and sqrt(0.25 + 0.875^2) away from it.
        const double far = std::hypot(0.5, 0.875);
        CHECK(distance(*file, face_point(0, 0, 1), face_point(1, 0, 1), 4) ==
              doctest::Approx(1 + far).epsilon(1e-12));
        CHECK(distance(*file, face_point(1, 0, 1), face_point(2, 0, 1), 4) ==
              doctest::Approx(2 * far).epsilon(1e-12));
    }
    for (const std::uint32_t pages : {3u, 4u, 7u}) {
        for (const std::uint32_t parts : {1u, 4u}) {
            const Book book(pages, parts);
            const std::vector<Point> points = random_points(prepared(book.mesh), 19, 300);
            const std::vector<Point> sources(points.begin(), points.begin() + 30);
            const auto truth = [&](const Point& a, std::size_t i) {
                return book.truth(a, points[i]);
            };
            check_distances({"book", book.mesh, 2.3, sources, points}, truth);
            check_distances({"book, disk", book.mesh, 0.6, sources, points}, truth);
        }
    }
}

namespace {

/// The point at the given distances from a, b and c, on the side of their plane that `side` tells.
Vec3 trilaterated(Vec3 a, Vec3 b, Vec3 c, double from_a, double from_b, double from_c,
                  double side) {
    const Vec3 x = normalize(b - a);
    const Vec3 along = dot(c - a, x) * x;
    const Vec3 y = normalize(c - a - along);
    const double ab = length(b - a);
    const double cx = dot(c - a, x);
    const double cy = dot(c - a, y);
    const double px = (from_a * from_a - from_b * from_b + ab * ab) / (2 * ab);
    const double py =
        (from_a * from_a - from_c * from_c + cx * cx + cy * cy - 2 * px * cx) / (2 * cy);
    const double height2 = from_a * from_a - px * px - py * py;
    REQUIRE(height2 > 0);
    return a + px * x + py * y + side * std::sqrt(height2) * cross(x, y);
}

/// Two sheets of different shape lead from a point s to the edge a b, a third goes on from it.
///
/// Sheet A (faces 0, 1) and sheet B (2, 3) are flat but for folds; s lies nearer to the edge in A.
/// Sheet C is the triangle b a v (4), and face 5 lies beyond its side v a. All coordinates here are
/// those of C's plane, with every sheet unfolded into it.
struct TwoWays {
    Vec3 a{-1.9, -2.02, 0}, b{1, 0.3, 0}, v{0, 0, 0}, q{-2.5, -1, 0};
    Vec3 s_in_a{-0.01, -1, 0}, s_in_b{0, -1.15, 0};
    TestMesh mesh;

    TwoWays() {
        const Vec3 m = 0.5 * (a + s_in_a);
        const Vec3 k{0.6, -0.5, 0};
        // A is folded along m b until s is as near to a as B has it.
        double low = 0;
        double high = std::numbers::pi;
        for (int step = 0; step < 60; ++step) {
            const double angle = 0.5 * (low + high);
            (length(folded(m, angle) - a) > length(s_in_b - a) ? low : high) = angle;
        }
        const Vec3 s = folded(m, low);
        const Vec3 k_at =
            trilaterated(a, b, s, length(k - a), length(k - b), length(k - s_in_b), 1);
        for (const Vec3& p : {a, b, s, m, k_at, v, q}) {
            mesh.add_vertex(p);
        }
        mesh.triangles = {0, 1, 3, 3, 1, 2, 0, 1, 4, 0, 4, 2, 1, 0, 5, 5, 0, 6};
    }

    /// s after turning by `angle` around m b.
    Vec3 folded(Vec3 m, double angle) const {
        const Vec3 axis = normalize(b - m);
        const Vec3 along = dot(s_in_a - m, axis) * axis;
        const Vec3 out = s_in_a - m - along;
        return m + along + std::cos(angle) * out + std::sin(angle) * cross(axis, out);
    }
};

} // namespace

TEST_CASE("three triangles on an edge: two sheets lead into the third by different ways") {
    // From s, v is nearer through A, and points beyond the side v a are nearer through B. No vertex
    // lies between the two ways, so which ray to v crosses the edge further left does not tell
    // which window serves which side: both must go on to both sides.
    const TwoWays ways;
    const Point s = points_at_vertex(ways.mesh, 2).front();
    const double found_v = distance(ways.mesh, s, points_at_vertex(ways.mesh, 5).front(), 3);
    CHECK(found_v == doctest::Approx(length(ways.s_in_a - ways.v)).epsilon(1e-9));
    for (const double across : {0.01, 0.02, 0.05}) {
        const Point p = face_point(5, 0.97 - across, across);
        const Vec3 at = ways.mesh.position(p);
        REQUIRE(length(at - ways.s_in_b) < length(at - ways.s_in_a) - 0.03);
        CHECK(distance(ways.mesh, s, p, 3) ==
              doctest::Approx(length(at - ways.s_in_b)).epsilon(1e-9));
    }
}

TEST_CASE("moebius strip: distances through its double cover, against CGAL") {
    for (const int resolution : {1, 4}) {
        const TestMesh strip = builtin("moebius", resolution);
        const TestMesh cover = moebius_double_cover(resolution);
        const std::uint32_t faces = strip.face_count();
        const std::vector<Point> points = random_points(prepared(strip), 23, 200);
        std::vector<Point> lifts = points;
        for (const Point& p : points) {
            lifts.push_back({p.face + faces, p.weight2, p.weight1});
        }
        GeodesicOracle oracle(cover);
        for (std::size_t source = 0; source < 8; ++source) {
            const std::vector<double> lifted = oracle.distances(points[source], lifts);
            check_distances({"moebius", strip, 4, {points[source]}, points},
                            [&](const Point&, std::size_t i) {
                                return std::min(lifted[i], lifted[i + points.size()]);
                            });
        }
    }
}

TEST_CASE("inconsistent orientation: flipped faces change no distance") {
    TestMesh mesh = builtin("icosphere", 2);
    const std::vector<Point> points = random_points(prepared(mesh), 29, 300);
    GeodesicQuery<double> query(prepared(mesh), 3.3, points, tight_tolerances());
    std::vector<Point> flipped = points;
    for (std::uint32_t f = 0; f < mesh.face_count(); f += 3) {
        std::swap(mesh.triangles[3 * f + 1], mesh.triangles[3 * f + 2]);
    }
    for (Point& p : flipped) {
        if (p.face % 3 == 0) {
            std::swap(p.weight1, p.weight2);
        }
    }
    for (std::size_t s = 0; s < 10; ++s) {
        const std::vector<double> truth = query.from(points[s]);
        check_distances({"flipped faces", mesh, 3.3, {flipped[s]}, flipped},
                        [&](const Point&, std::size_t i) { return truth[i]; });
    }
}

TEST_CASE("unwelded soup: distances stop at edges") {
    const auto soup = shared_mesh("bad/warn_unwelded.obj");
    if (!soup) {
        return;
    }
    const std::vector<Point> points = random_points(prepared(*soup), 37, 500);
    check_distances({"soup", *soup, 4, {points.begin(), points.begin() + 60}, points},
                    [&](const Point& a, std::size_t i) {
                        return a.face == points[i].face
                                   ? length(soup->position(a) - soup->position(points[i]))
                                   : kUnreachable;
                    });
}

TEST_CASE("unreachable targets: infinite, never 0") {
    TestMesh mesh = two_sided_square();
    const TestMesh other = two_sided_square();
    mesh.add_vertex({0.5, 0.5, 0}); // Isolated, on the surface.
    const std::uint32_t first = mesh.vertex_count();
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    for (const std::uint32_t v : other.triangles) {
        mesh.triangles.push_back(first + v);
    }
    const PreparedMesh surface = prepared(mesh);
    CHECK(surface.statistics().components == 2);
    CHECK(surface.statistics().vertices == 8);
    const std::vector<Point> points = random_points(surface, 53, 300);
    GeodesicQuery<double> query(surface, 3, points, tight_tolerances());
    GeodesicQuery<float> twin(surface, 3, points, ref::frame_of(surface, 3).tolerances());
    for (const Point& source : points) {
        const std::vector<double> found = query.from(source);
        const std::vector<double> found_twin = twin.from(source);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const bool together = (source.face < 4) == (points[i].face < 4);
            REQUIRE((found[i] < kUnreachable) == together);
            REQUIRE((found_twin[i] < kUnreachable) == together);
        }
    }
}

TEST_CASE("isolated vertices change nothing") {
    const auto with = shared_mesh("bad/warn_isolated_vertices.obj");
    const auto without = shared_mesh("bad/good_plain.obj");
    if (!with || !without) {
        return;
    }
    REQUIRE(with->face_count() == without->face_count());
    const std::vector<Point> points = random_points(prepared(*without), 59, 200);
    GeodesicQuery<double> query(prepared(*without), 6, points, tight_tolerances());
    for (std::size_t s = 0; s < 5; ++s) {
        const std::vector<double> truth = query.from(points[s]);
        check_distances({"isolated", *with, 6, {points[s]}, points},
                        [&](const Point&, std::size_t i) { return truth[i]; });
    }
}

TEST_CASE("far from the origin: nothing is lost but the coordinates' own rounding") {
    const auto far = shared_mesh("bad/warn_far_from_origin.obj");
    const auto near = shared_mesh("bad/good_plain.obj");
    if (!far || !near) {
        return;
    }
    const std::vector<Point> points = random_points(prepared(*near), 61, 200);
    GeodesicQuery<double> query(prepared(*near), 6, points, tight_tolerances());
    for (std::size_t s = 0; s < 5; ++s) {
        const std::vector<double> truth = query.from(points[s]);
        check_distances({"far away", *far, 6, {points[s]}, points, 1e-7},
                        [&](const Point&, std::size_t i) { return truth[i]; });
    }
}
