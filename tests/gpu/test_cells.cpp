// Cells: areas by other means, duals that are known, and what has no cells.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include <geodisk/cells.hpp>
#include <geodisk/nearest.hpp>

#include "device_run.hpp"
#include "support/geodesic_query.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

Runner& cells_runner() {
    static Runner runner =
        expect(Runner::create(shared_context().device(), shared_context().queue()));
    return runner;
}

Sample sample_at(const Point& p) {
    return {p.face,
            {static_cast<float>(1 - p.weight1 - p.weight2), static_cast<float>(p.weight1),
             static_cast<float>(p.weight2)}};
}

std::vector<Sample> samples_at(const std::vector<Point>& points) {
    std::vector<Sample> samples;
    for (const Point& point : points) {
        samples.push_back(sample_at(point));
    }
    return samples;
}

/// Finds the cells, and checks what holds of all.
SurfaceCells cells_of(const PreparedMesh& mesh, std::span<const Sample> samples) {
    const SurfaceCells cells = expect(find_cells(cells_runner(), mesh, samples));
    const double area = mesh.statistics().area;
    const double sum = std::accumulate(cells.areas.begin(), cells.areas.end(), 0.0);
    CHECK(cells.areas.size() == samples.size());
    CHECK(std::abs(sum + cells.unreached - area) < 1e-9 * area);
    CHECK(std::ranges::is_sorted(cells.edges));
    CHECK(cells.dual.edges == cells.edges.size());
    CHECK(cells.dual.triangles == cells.triangles.size());
    return cells;
}

/// Returns the distances of all points from each sample, by the twin in double precision.
std::vector<std::vector<double>> twin_distances(const PreparedMesh& mesh,
                                                const std::vector<Point>& samples,
                                                const std::vector<Point>& points, double reach) {
    GeodesicQuery<double> twin(mesh, reach, points, tight_tolerances());
    std::vector<std::vector<double>> distances;
    for (const Point& sample : samples) {
        distances.push_back(twin.from(sample));
    }
    return distances;
}

/// Returns the sample that is nearest to each point.
std::vector<std::uint32_t> nearest_of(const std::vector<std::vector<double>>& distances) {
    std::vector<std::uint32_t> nearest(distances.front().size(), ~0u);
    for (std::size_t p = 0; p < nearest.size(); ++p) {
        double least = kUnreachable;
        for (std::uint32_t i = 0; i < distances.size(); ++i) {
            if (distances[i][p] < least) {
                least = distances[i][p];
                nearest[p] = i;
            }
        }
    }
    return nearest;
}

/// Checks that two searches have found the same, to the bit.
void check_same(const SurfaceCells& a, const SurfaceCells& b) {
    CHECK(a.areas == b.areas);
    CHECK(a.area_error == b.area_error);
    CHECK(a.distance_error == b.distance_error);
    CHECK(a.unreached == b.unreached);
    CHECK(a.edges == b.edges);
    CHECK(a.triangles == b.triangles);
    CHECK(a.dual.manifold == b.dual.manifold);
    CHECK(a.dual.euler == b.dual.euler);
}

/// Checks the nearest samples of random points against the twin.
void check_nearest(const PreparedMesh& mesh, std::uint32_t count, std::uint32_t points_per_sample) {
    const std::vector<Point> samples = random_points(mesh, 4, count);
    const std::vector<Point> points = random_points(mesh, 12, points_per_sample * count);
    const auto found = expect(NearestSamples::create(cells_runner(), mesh, samples_at(samples)));
    const auto nearest = expect(found.of(samples_at(points)));
    const double scale = std::sqrt(mesh.statistics().area / count);
    const auto distances = twin_distances(mesh, samples, points, 2.5 * scale);
    const auto by_twin = nearest_of(distances);
    REQUIRE(nearest.size() == points.size());
    CHECK(found.error() < 1e-3 * scale);
    std::size_t others = 0;
    double worst = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        REQUIRE(by_twin[p] != ~0u);
        REQUIRE(nearest[p].sample < count);
        const double least = distances[by_twin[p]][p];
        worst = std::max({worst, std::abs(double{nearest[p].distance} - least),
                          distances[nearest[p].sample][p] - least});
        others += std::size_t{nearest[p].sample != by_twin[p]};
    }
    // Floats round both distances and the weights of points.
    CHECK(worst < 2e-5 * scale);
    CHECK(others <= points.size() / 200);
    check_same(expect(found.cells()), cells_of(mesh, samples_at(samples)));
}

/// Checks areas against the part of random points that are nearest to each sample.
void check_areas(const PreparedMesh& mesh, std::uint32_t count) {
    const std::vector<Point> samples = random_points(mesh, 4, count);
    const std::vector<Point> points = random_points(mesh, 11, 200 * count);
    const SurfaceCells cells = cells_of(mesh, samples_at(samples));
    CHECK(cells.unreached == 0);
    const double reach = 2.5 * std::sqrt(mesh.statistics().area / count);
    const auto nearest = nearest_of(twin_distances(mesh, samples, points, reach));
    std::vector<double> counts(count, 0);
    for (const std::uint32_t sample : nearest) {
        REQUIRE(sample != ~0u);
        ++counts[sample];
    }
    double worst = 0, chi_square = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double expected =
            cells.areas[i] / mesh.statistics().area * static_cast<double>(points.size());
        const double off = counts[i] - expected;
        worst = std::max(worst, std::abs(off) / std::sqrt(expected + 1));
        chi_square += off * off / expected;
    }
    CHECK(worst < 5);
    CHECK(chi_square < count + 5 * std::sqrt(2.0 * count));
}

Triangle turned(Triangle t) {
    std::rotate(t.begin(), std::ranges::min_element(t), t.end());
    return t;
}

/// The triangles, each beginning with its lowest corner, ascending.
std::vector<Triangle> sorted(std::vector<Triangle> triangles) {
    for (Triangle& triangle : triangles) {
        triangle = turned(triangle);
    }
    std::ranges::sort(triangles);
    return triangles;
}

std::vector<Sample> vertices_of(const TestMesh& mesh) {
    std::vector<Sample> samples;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        samples.push_back(sample_at(points_at_vertex(mesh, v).front()));
    }
    return samples;
}

TestMesh octahedron() {
    TestMesh mesh;
    for (const Vec3& p : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{-1, 0, 0},
                          Vec3{0, -1, 0}, Vec3{0, 0, -1}}) {
        mesh.add_vertex(p);
    }
    for (std::uint32_t a : {0u, 3u}) {
        for (std::uint32_t b : {1u, 4u}) {
            for (std::uint32_t c : {2u, 5u}) {
                const bool turns = (a == 3) != ((b == 4) != (c == 5));
                turns ? mesh.add_triangle(a, c, b) : mesh.add_triangle(a, b, c);
            }
        }
    }
    return mesh;
}

/// A polygon of the plane, cut by lines.
class Polygon {
  public:
    Polygon() : corners_{{0, 0}, {1, 0}, {1, 1}, {0, 1}} {}
    /// Keeps what is nearer to `a` than to `b`.
    void keep_nearer(Vec3 a, Vec3 b) {
        const auto side = [&](const std::array<double, 2>& p) {
            return std::hypot(p[0] - b.x, p[1] - b.y) - std::hypot(p[0] - a.x, p[1] - a.y);
        };
        const double mx = (a.x + b.x) / 2, my = (a.y + b.y) / 2;
        const auto linear = [&](const std::array<double, 2>& p) {
            return (p[0] - mx) * (a.x - b.x) + (p[1] - my) * (a.y - b.y);
        };
        std::vector<std::array<double, 2>> kept;
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const auto& p = corners_[i];
            const auto& q = corners_[(i + 1) % corners_.size()];
            if (side(p) >= 0) {
                kept.push_back(p);
            }
            if ((side(p) >= 0) != (side(q) >= 0)) {
                const double t = linear(p) / (linear(p) - linear(q));
                kept.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])});
            }
        }
        corners_ = kept;
    }
    double area() const {
        double sum = 0;
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const auto& p = corners_[i];
            const auto& q = corners_[(i + 1) % corners_.size()];
            sum += p[0] * q[1] - p[1] * q[0];
        }
        return sum / 2;
    }

  private:
    std::vector<std::array<double, 2>> corners_;
};

/// The Delaunay triangles in the plane whose circles have their centers in the unit square.
std::vector<Triangle> plane_triangles(const std::vector<Vec3>& at) {
    std::vector<Triangle> triangles;
    const auto count = static_cast<std::uint32_t>(at.size());
    for (std::uint32_t a = 0; a < count; ++a) {
        for (std::uint32_t b = a + 1; b < count; ++b) {
            for (std::uint32_t c = b + 1; c < count; ++c) {
                const double bx = at[b].x - at[a].x, by = at[b].y - at[a].y;
                const double cx = at[c].x - at[a].x, cy = at[c].y - at[a].y;
                const double d = 2 * (bx * cy - by * cx);
                const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
                const double x = (cy * b2 - by * c2) / d, y = (bx * c2 - cx * b2) / d;
                const double ux = at[a].x + x, uy = at[a].y + y, square = x * x + y * y;
                const bool is_empty = std::ranges::none_of(at, [&](const Vec3& p) {
                    return (p.x - ux) * (p.x - ux) + (p.y - uy) * (p.y - uy) < square * (1 - 1e-12);
                });
                if (is_empty && ux > 0 && ux < 1 && uy > 0 && uy < 1) {
                    triangles.push_back(d > 0 ? Triangle{a, b, c} : Triangle{a, c, b});
                }
            }
        }
    }
    return triangles;
}

/// Checks cells in a mesh of the unit square against polygons, and the triangulation of the plane.
/// Areas are known up to a part of a mean cell.
void check_plane(const TestMesh& square, double known) {
    const PreparedMesh mesh = prepared(square);
    const std::vector<Point> samples = random_points(mesh, 5, 40);
    std::vector<Vec3> at;
    for (const Point& sample : samples) {
        at.push_back(square.position(sample));
    }
    const SurfaceCells cells = cells_of(mesh, samples_at(samples));
    for (std::size_t i = 0; i < at.size(); ++i) {
        Polygon polygon;
        for (std::size_t j = 0; j < at.size(); ++j) {
            if (i != j) {
                polygon.keep_nearer(at[i], at[j]);
            }
        }
        CHECK(std::abs(cells.areas[i] - polygon.area()) < 1e-4 / 40);
    }
    CHECK(cells.area_error < known / 40);
    CHECK(sorted(cells.triangles) == sorted(plane_triangles(at)));
    CHECK(cells.dual.euler == 1);
}

} // namespace

TEST_SUITE("cells") {
    TEST_CASE("have the areas that random points tell") {
        check_areas(prepared(builtin("torus-knot", 8)), 60);
        check_areas(prepared(builtin("cube", 3)), 40);
        check_areas(prepared(builtin("plate", 4)), 30);
        check_areas(prepared(builtin("moebius", 4)), 20);
        check_areas(prepared(tetrahedra(2, 0.2)), 50);
    }

    TEST_CASE("are alike around the corners of a regular solid, which is their dual") {
        const TestMesh solid = octahedron();
        const PreparedMesh mesh = prepared(solid);
        const SurfaceCells cells = cells_of(mesh, vertices_of(solid));
        for (const double area : cells.areas) {
            CHECK(area == doctest::Approx(mesh.statistics().area / 6).epsilon(1e-6));
        }
        std::vector<Triangle> faces;
        for (std::uint32_t f = 0; f < solid.face_count(); ++f) {
            const std::size_t at = std::size_t{3} * f;
            faces.push_back(
                {solid.triangles[at], solid.triangles[at + 1], solid.triangles[at + 2]});
        }
        CHECK(sorted(cells.triangles) == sorted(faces));
        CHECK(cells.edges.size() == 12);
        CHECK(cells.dual.manifold == 8);
        CHECK(cells.dual.euler == 2);
        CHECK(cells.dual.mesh_euler == 2);
    }

    TEST_CASE("make fans where four meet") {
        const TestMesh cube = builtin("cube", 1);
        const PreparedMesh mesh = prepared(cube);
        REQUIRE(cube.vertex_count() == 8);
        const SurfaceCells cells = cells_of(mesh, vertices_of(cube));
        for (const double area : cells.areas) {
            CHECK(area == doctest::Approx(mesh.statistics().area / 8).epsilon(1e-5));
        }
        CHECK(cells.dual.triangles == 12);
        CHECK(cells.dual.manifold == 12);
        CHECK(cells.dual.euler == 2);
    }

    TEST_CASE("are those of the plane") {
        check_plane(flat_irregular(6, 3), 0.01);
    }

    TEST_CASE("are those of the plane where it is cut into slivers") {
        TestMesh strips;
        constexpr std::uint32_t kStrips = 90;
        for (std::uint32_t i = 0; i <= kStrips; ++i) {
            const double x = static_cast<double>(i) / kStrips;
            strips.add_vertex({x, 0, 0});
            strips.add_vertex({x, 1, 0});
        }
        for (std::uint32_t v = 0; v < 2 * kStrips; v += 2) {
            strips.add_triangle(v, v + 2, v + 1);
            strips.add_triangle(v + 2, v + 3, v + 1);
        }
        check_plane(strips, 0.1);
    }

    TEST_CASE("end on slivers around holes") {
        check_areas(prepared(builtin("drilled-plate", 4)), 20);
    }

    TEST_CASE("give a torus where there are enough of them") {
        const PreparedMesh torus = prepared(builtin("torus-knot", 12));
        const std::vector<Sample> samples = samples_at(random_points(torus, 5, 700));
        const SurfaceCells cells = cells_of(torus, samples);
        CHECK(cells.dual.mesh_euler == 0);
        CHECK(cells.dual.euler == 0);
        CHECK(cells.dual.manifold == cells.dual.triangles);
        CHECK(cells_of(torus, samples).areas == cells.areas); // Whatever the order of records.
    }

    TEST_CASE("of few samples, of equal ones and of parts without any") {
        const TestMesh sphere = builtin("icosphere", 2);
        const PreparedMesh mesh = prepared(sphere);
        const double area = mesh.statistics().area;
        const std::vector<Sample> three = samples_at(random_points(mesh, 9, 3));
        const SurfaceCells one = cells_of(mesh, std::span(three).first(1));
        CHECK(one.areas[0] == doctest::Approx(area));
        CHECK(one.edges.empty());
        CHECK(one.dual.euler == 1);
        const SurfaceCells two = cells_of(mesh, std::span(three).first(2));
        CHECK(two.edges.size() == 1);
        CHECK(two.triangles.empty());
        // Two places, whose triangles have the same corners and turn against each other.
        const SurfaceCells all = cells_of(mesh, three);
        CHECK(all.edges.size() == 3);
        CHECK(sorted(all.triangles) == std::vector<Triangle>{{0, 1, 2}, {0, 2, 1}});
        CHECK(all.dual.manifold == 2);
        CHECK(all.dual.euler == 2);
        const std::vector<Sample> equal{three[0], three[1], three[0], three[0]};
        const SurfaceCells same = cells_of(mesh, equal);
        CHECK(same.areas[0] == two.areas[0]);
        CHECK(same.areas[2] == 0);
        CHECK(same.edges == two.edges);

        TestMesh pair = sphere;
        const std::uint32_t first = pair.vertex_count(), faces = pair.face_count();
        for (std::uint32_t v = 0; v < first; ++v) {
            const Vec3 p = pair.vertex(v);
            pair.add_vertex({2 * p.x + 9, 2 * p.y, 2 * p.z});
        }
        for (std::uint32_t f = 0; f < faces; ++f) {
            const std::size_t at = std::size_t{3} * f;
            pair.add_triangle(pair.triangles[at] + first, pair.triangles[at + 1] + first,
                              pair.triangles[at + 2] + first);
        }
        const SurfaceCells part = cells_of(prepared(pair), three);
        CHECK(part.unreached == doctest::Approx(4 * area));
        CHECK(part.areas[0] == doctest::Approx(all.areas[0]).epsilon(1e-5));
        CHECK(part.triangles == all.triangles);
        CHECK(part.dual.mesh_euler == 4);
    }

    TEST_CASE("do not depend on memory or lanes") {
        const PreparedMesh knot = prepared(builtin("torus-knot", 8));
        const std::vector<Sample> samples = samples_at(random_points(knot, 5, 150));
        const SurfaceCells cells = cells_of(knot, samples);
        RunnerOptions narrow;
        narrow.plan.slots = 16;
        narrow.plan.window_capacity = 8;
        narrow.plan.table_capacity = 16;
        narrow.device_bytes = 4 << 20;
        narrow.threads.max_threads = 1;
        Runner runner =
            expect(Runner::create(shared_context().device(), shared_context().queue(), narrow));
        const SurfaceCells other = expect(find_cells(runner, knot, samples));
        check_same(other, cells);
        CellParams areas_alone;
        areas_alone.has_dual = false;
        const SurfaceCells less = expect(find_cells(runner, knot, samples, areas_alone));
        CHECK(less.areas == cells.areas);
        CHECK(less.edges.empty());
    }

    TEST_CASE("of a mesh that the device cannot hold are found in parts") {
        const PreparedMesh terrain = prepared(builtin("terrain", 200));
        const std::vector<Sample> samples = samples_at(random_points(terrain, 5, 1500));
        RunnerOptions little; // Less than the faces and their fans take.
        little.device_bytes = 8 << 20;
        Runner runner =
            expect(Runner::create(shared_context().device(), shared_context().queue(), little));
        CellParams areas_alone;
        areas_alone.has_dual = false;
        const SurfaceCells cells =
            expect(find_cells(cells_runner(), terrain, samples, areas_alone));
        const SurfaceCells other = expect(find_cells(runner, terrain, samples, areas_alone));
        CHECK(other.areas == cells.areas);
        CHECK(other.report.device_bytes <= little.device_bytes);
        const std::vector<Sample> few(samples.begin(), samples.begin() + 2);
        const auto wide = find_cells(runner, terrain, few, areas_alone); // As wide as the mesh.
        REQUIRE_FALSE(wide);
        CHECK(wide.error().status == Status::out_of_device_memory);
    }

    TEST_CASE("know the nearest sample of points") {
        check_nearest(prepared(builtin("torus-knot", 8)), 60, 100);
        check_nearest(prepared(builtin("cube", 1)), 200, 50); // Many in each face.
        check_nearest(prepared(builtin("plate", 4)), 30, 100);
        check_nearest(prepared(builtin("moebius", 4)), 20, 100);
        check_nearest(prepared(tetrahedra(2, 0.2)), 50, 40);
        check_nearest(prepared(builtin("icosphere", 3)), 2, 500);
    }

    TEST_CASE("know of nearest samples at ties and where there are none") {
        const TestMesh solid = octahedron();
        TestMesh pair = solid;
        for (std::uint32_t v = 0; v < 6; ++v) {
            const Vec3 p = solid.vertex(v);
            pair.add_vertex({p.x + 9, p.y, p.z});
        }
        for (std::uint32_t f = 0; f < 8; ++f) {
            const std::size_t at = std::size_t{3} * f;
            pair.add_triangle(solid.triangles[at] + 6, solid.triangles[at + 1] + 6,
                              solid.triangles[at + 2] + 6);
        }
        const PreparedMesh mesh = prepared(pair);
        const std::vector<Sample> corners = vertices_of(solid);
        const std::vector<Sample> samples{corners[4], corners[0], corners[4], corners[1]};
        Runner& runner = cells_runner();
        const auto found = expect(NearestSamples::create(runner, mesh, samples));
        // Vertex 2 is as far from all of them, face 8 is one of the other solid.
        const auto nearest = expect(
            found.of(std::vector<Sample>{corners[4], corners[2], corners[0], {8, {1, 0, 0}}}));
        CHECK(nearest[0].sample == 0);
        CHECK(nearest[0].distance <= found.error());
        CHECK(nearest[1].sample == 0);
        CHECK(nearest[1].distance == doctest::Approx(std::sqrt(2.0)));
        CHECK(nearest[2].sample == 1);
        CHECK(nearest[3].sample == NearestSample::kNone);
        CHECK(std::isinf(nearest[3].distance));
        CHECK(expect(found.of({})).empty());
        // The third is where the first is. Half of the progress is that of the disks.
        check_same(expect(found.cells()), cells_of(mesh, samples));
        std::vector<std::uint32_t> told;
        const auto stopped_cells = found.cells([&](const Progress& now) {
            told.push_back(now.candidates);
            return false;
        });
        REQUIRE_FALSE(stopped_cells);
        CHECK(stopped_cells.error().status == Status::cancelled);
        REQUIRE(told.size() == 1);
        CHECK(told[0] > 3);
        // Inside of a face without area, which is the diagonal of a square.
        TestMesh square;
        for (const Vec3& p :
             {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.5, 0.5, 0}, Vec3{0, 1, 0}, Vec3{1, 1, 0}}) {
            square.add_vertex(p);
        }
        square.add_triangle(0, 1, 3);
        square.add_triangle(1, 2, 3);
        square.add_triangle(1, 4, 2);
        square.add_triangle(2, 4, 3);
        const PreparedMesh flat = prepared(square);
        const std::vector<Sample> corner{{0, {1, 0, 0}}};
        const auto beside = expect(NearestSamples::create(runner, flat, corner));
        const auto inside = expect(beside.of(std::vector<Sample>{{1, {0.25f, 0.5f, 0.25f}}}));
        CHECK(inside[0].sample == 0);
        CHECK(inside[0].distance == doctest::Approx(std::sqrt(0.5)));
        CHECK(found.of(std::vector<Sample>{{99, {1, 0, 0}}}).error().message ==
              "point 0 is in face 99, but there are 16");
        CHECK(NearestSamples::create(runner, mesh, {}).error().message == "there is no sample");
        const auto stopped = NearestSamples::create(runner, mesh, samples, 1 << 20,
                                                    [](const Progress&) { return false; });
        REQUIRE_FALSE(stopped);
        CHECK(stopped.error().status == Status::cancelled);
    }

    TEST_CASE("have the areas of the faces that a mask takes, as if others had none") {
        const PreparedMesh knot = prepared(builtin("torus-knot", 8));
        const std::vector<Sample> samples = samples_at(random_points(knot, 3, 60));
        std::vector<std::uint8_t> mask(knot.face_count());
        double taken = 0;
        for (std::uint32_t face = 0; face < knot.face_count(); ++face) {
            mask[face] = face % 3 == 0 ? 2 : 0;
            const HalfEdge& edge = knot.half_edges()[std::size_t{3} * face];
            taken += mask[face] != 0 ? 0.5 * edge.length * edge.apex_y : 0;
        }
        CellParams params;
        params.face_mask = mask;
        const SurfaceCells some = expect(find_cells(cells_runner(), knot, samples, params));
        CHECK(std::accumulate(some.areas.begin(), some.areas.end(), 0.0) ==
              doctest::Approx(taken).epsilon(1e-5));
        for (std::uint8_t& byte : mask) {
            byte = byte == 0;
        }
        const SurfaceCells others = expect(find_cells(cells_runner(), knot, samples, params));
        const SurfaceCells all = expect(find_cells(cells_runner(), knot, samples));
        for (std::size_t i = 0; i < samples.size(); ++i) {
            CHECK(some.areas[i] + others.areas[i] == doctest::Approx(all.areas[i]).epsilon(1e-9));
        }
        const std::vector<std::uint8_t> none(mask.size(), 0);
        params.face_mask = none;
        CHECK_FALSE(find_cells(cells_runner(), knot, samples, params));
        params.face_mask = std::span(mask).first(mask.size() - 1);
        CHECK_FALSE(find_cells(cells_runner(), knot, samples, params));
    }

    TEST_CASE("that cannot be found are refused") {
        const PreparedMesh cube = prepared(builtin("cube", 2));
        std::vector<Sample> samples = samples_at(random_points(cube, 1, 100));
        Runner& runner = cells_runner();
        CHECK(find_cells(runner, cube, {}).error().message == "there is no sample");
        CellParams few;
        few.max_records = 10;
        const auto large = find_cells(runner, cube, samples, few);
        REQUIRE_FALSE(large);
        CHECK(large.error().status == Status::job_too_large);
        CHECK(large.error().message.find("more than the 10 that are allowed") != std::string::npos);
        const auto stopped =
            find_cells(runner, cube, samples, {}, [](const Progress&) { return false; });
        REQUIRE_FALSE(stopped);
        CHECK(stopped.error().status == Status::cancelled);
        samples[7].face = 1000;
        CHECK(find_cells(runner, cube, samples).error().message ==
              "sample 7 is in face 1000, but there are 48");
    }
}

} // namespace geodisk::test
