// The table that pictures are drawn by: the distance a pixel shows is the exact one.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "picture/flat_box.hpp"
#include "picture/nearest_windows.hpp"
#include "picture/window_table.hpp"
#include "support/meshes.hpp"
#include "support/oracle_geodesic.hpp"
#include "unit/test_files.hpp"

using namespace geodisk;
using namespace geodisk::test;
using tools::SurfaceDisk;
using tools::picture::FaceRec;
using tools::picture::make_window_table;
using tools::picture::WindowRec;
using tools::picture::WindowTable;

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
/// Error as a part of the unit: what float makes of faces many units long, and the width of kSeam.
constexpr double kError = 5e-4;

/// As surface.frag looks a place up: the distance of each sample there, in mesh units.
std::vector<double> look_up(const WindowTable& table, const Point& point, std::size_t samples) {
    const FaceRec& face = table.faces[point.face];
    const double weights[3] = {1 - point.weight1 - point.weight2, point.weight1, point.weight2};
    const auto next = static_cast<float>(weights[(face.base + 1) % 3]);
    const auto apex = static_cast<float>(weights[(face.base + 2) % 3]);
    const float x = next * face.longest + apex * face.apex_x;
    const float y = apex * face.apex_y;
    const auto cell_at = [&](float at, std::uint32_t count) {
        return static_cast<std::uint32_t>(
            std::clamp(at * face.cells_per_unit, 0.0f, static_cast<float>(count) - 0.5f));
    };
    const std::uint32_t cell =
        face.first_cell + cell_at(y, face.rows) * face.columns + cell_at(x, face.columns);
    std::vector<double> distances(samples, kFar);
    constexpr float kSeam = 2e-4f;
    for (std::uint32_t i = table.starts[cell]; i < table.starts[cell + 1]; ++i) {
        const WindowRec& window = table.windows[i];
        const float dx = x - window.x, dy = y - window.y;
        if (window.left_x * dx + window.left_y * dy >= -kSeam &&
            window.right_x * dx + window.right_y * dy >= -kSeam) {
            double& distance = distances[window.sample_index];
            distance = std::min(
                distance, table.unit * static_cast<double>(window.sigma + std::hypot(dx, dy)));
        }
    }
    return distances;
}

/// All distances up to `reach` are those of CGAL, and none is missing.
void check_table(const std::string& name, const TestMesh& mesh, double reach, std::uint32_t samples,
                 std::uint32_t probes) {
    INFO(name);
    const PreparedMesh surface = prepared(mesh);
    const std::vector<Point> sources = random_points(surface, 5, samples);
    const std::vector<Point> points = random_points(surface, 6, probes);
    std::vector<SurfaceDisk> disks;
    disks.reserve(sources.size());
    for (const Point& source : sources) {
        disks.push_back({source.face, source.weight1, source.weight2, reach});
    }
    const WindowTable table = make_window_table(surface, disks, reach, {});
    GeodesicOracle oracle(mesh);
    std::vector<std::vector<double>> shown; // By probe.
    shown.reserve(points.size());
    for (const Point& point : points) {
        shown.push_back(look_up(table, point, samples));
    }
    std::size_t wrong = 0, near = 0;
    double worst = 0;
    for (std::size_t s = 0; s < sources.size(); ++s) {
        const std::vector<double> truth = oracle.distances(sources[s], points);
        for (std::size_t p = 0; p < points.size(); ++p) {
            const double distance = shown[p][s];
            if (truth[p] < reach * (1 - kError)) {
                ++near;
                const double error = std::abs(distance - truth[p]) / table.unit;
                worst = std::max(worst, error);
                wrong += !(error <= kError);
            } else {
                wrong += distance < reach * (1 - kError);
            }
        }
    }
    INFO("worst error ", worst, " of the unit in ", near, " distances");
    CHECK(near > probes);
    CHECK(wrong == 0);
}

} // namespace

TEST_CASE("distances in pictures are exact") {
    check_table("icosphere", builtin("icosphere", 3), 0.6, 40, 400);
    check_table("torus-knot", builtin("torus-knot", 8), 1.0, 20, 400);
    check_table("terrain", builtin("terrain", 24), 0.3, 40, 400);
    // Faces of many cells.
    check_table("cube", builtin("cube", 1), 0.4, 60, 400);
    check_table("cube, small disks", builtin("cube", 1), 0.05, 2000, 300);
    check_table("two-sided square", builtin("plate", 1), 0.3, 60, 400);
    check_table("obtuse fan", flat_obtuse_fan(8), 0.3, 40, 400);
}

TEST_CASE("windows of far samples are dropped, those of the nearest kept") {
    constexpr double kReach = 3, kMargin = 0.05;
    struct Case {
        const char* name;
        TestMesh mesh;
        double size; ///< Largest radius.
    };
    for (const Case& one :
         {Case{"icosphere", builtin("icosphere", 3), 0.3},
          Case{"terrain", builtin("terrain", 24), 0.2}, Case{"cube", builtin("cube", 1), 0.3},
          Case{"obtuse fan", flat_obtuse_fan(8), 0.2}}) {
        INFO(one.name);
        const PreparedMesh surface = prepared(one.mesh);
        std::vector<SurfaceDisk> disks;
        std::vector<double> radii;
        for (const Point& point : random_points(surface, 3, 150)) { // As three classes.
            const double radius = one.size / static_cast<double>(1 + disks.size() % 3);
            disks.push_back({point.face, point.weight1, point.weight2, kReach * radius});
            radii.push_back(radius);
        }
        const WindowTable whole = make_window_table(surface, disks, one.size, {});
        WindowTable table = whole;
        std::vector<double> in_units = radii;
        std::ranges::for_each(in_units, [&](double& radius) { radius /= table.unit; });
        tools::picture::keep_nearest(table, in_units, kReach, kMargin);
        CHECK(table.windows.size() < whole.windows.size() / 2);
        CHECK(table.starts.back() == table.windows.size());
        std::size_t wrong = 0, seen = 0;
        for (const Point& point : random_points(surface, 4, 1000)) {
            const auto in_radii = [&](const WindowTable& from) {
                std::vector<double> distances = look_up(from, point, disks.size());
                for (std::size_t i = 0; i < distances.size(); ++i) {
                    distances[i] /= radii[i];
                }
                return distances;
            };
            const std::vector<double> all = in_radii(whole), kept = in_radii(table);
            const double nearest = std::ranges::min(all);
            for (std::size_t i = 0; i < all.size() && nearest < kFar; ++i) {
                if (all[i] <= nearest + kMargin) {
                    wrong += kept[i] != all[i];
                    ++seen;
                }
            }
        }
        CHECK(seen > 500);
        CHECK(wrong == 0);
    }
}

TEST_CASE("windows in a cell are in the order of their samples") {
    const PreparedMesh mesh = prepared(builtin("icosphere", 3));
    std::vector<SurfaceDisk> disks;
    for (const Point& point : random_points(mesh, 1, 500)) { // More than one thread takes at once.
        disks.push_back({point.face, point.weight1, point.weight2, 0.4});
    }
    double told = 0;
    const WindowTable table =
        make_window_table(mesh, disks, 0.4, [&](double part) { told = part; });
    CHECK(told == 1);
    CHECK(table.starts.back() == table.windows.size());
    for (std::size_t cell = 0; cell + 1 < table.starts.size(); ++cell) {
        CHECK(std::is_sorted(table.windows.begin() + table.starts[cell],
                             table.windows.begin() + table.starts[cell + 1],
                             [](const WindowRec& a, const WindowRec& b) {
                                 return a.sample_index < b.sample_index;
                             }));
    }
}

TEST_CASE("what a picture cannot hold is an error, and so is what its progress throws") {
    const PreparedMesh mesh = prepared(builtin("icosphere", 4));
    std::vector<SurfaceDisk> disks;
    for (const Point& point : random_points(mesh, 1, 200)) {
        disks.push_back({point.face, point.weight1, point.weight2, 0.2});
    }
    const std::size_t windows = make_window_table(mesh, disks, 0.2, {}).windows.size();
    CHECK(make_window_table(mesh, disks, 0.2, {}, windows).windows.size() == windows);
    const auto error =
        tools::error_of([&] { make_window_table(mesh, disks, 0.2, {}, windows - 1); });
    REQUIRE(error);
    CHECK(error->code() == tools::ExitCode::out_of_memory);
    struct Stop {};
    CHECK_THROWS_AS(make_window_table(mesh, disks, 0.2, [](double) { throw Stop(); }), Stop);
}

TEST_CASE("a flat box is its plane, and a torus where its sides are periodic") {
    BoxParams box;
    box.extents = {2, 0.7};
    box.min_distance = 0.3;
    for (const bool is_periodic : {false, true}) {
        CAPTURE(is_periodic);
        box.is_periodic = is_periodic;
        const tools::picture::FlatBox flat(box);
        const double places[][2] = {{0, 0},     {0.03, 0.02}, {1.97, 0.69}, {1, 0.35}, {2, 0.7},
                                    {0.7, 0.1}, {1.9, 0.01},  {0.1, 0.65},  {1.2, 0.5}};
        std::vector<SurfaceDisk> disks;
        for (const auto& at : places) {
            disks.push_back(flat.disk(at[0], at[1], 0.3));
        }
        const WindowTable table = make_window_table(flat.mesh(), disks, 0.3, {});
        for (const auto& at : places) {
            const SurfaceDisk point = flat.disk(at[0], at[1], 0);
            const auto shown =
                look_up(table, {point.face, point.weight1, point.weight2}, disks.size());
            for (std::size_t s = 0; s < disks.size(); ++s) {
                double away[2];
                for (std::size_t axis = 0; axis < 2; ++axis) {
                    const double straight = std::abs(at[axis] - places[s][axis]);
                    away[axis] =
                        is_periodic ? std::min(straight, box.extents[axis] - straight) : straight;
                }
                const double distance = std::hypot(away[0], away[1]);
                if (distance < 0.299) {
                    CHECK(shown[s] == doctest::Approx(distance).epsilon(0.001).scale(0.3));
                } else {
                    CHECK(shown[s] > 0.298);
                }
            }
        }
    }
}
