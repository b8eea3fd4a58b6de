// Statistics of samples: against sums over all pairs in the plane, and what chance must give.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

#include "analysis/surface_statistics.hpp"
#include "support/meshes.hpp"

using namespace geodisk;
using namespace geodisk::test;
using tools::SurfaceDisk;
using tools::analysis::measure;
using tools::analysis::SurfaceStatistics;

namespace {

std::vector<SurfaceDisk> with_radius(const std::vector<Point>& points, double radius) {
    std::vector<SurfaceDisk> samples;
    samples.reserve(points.size());
    for (const Point& point : points) {
        samples.push_back({point.face, point.weight1, point.weight2, radius});
    }
    return samples;
}

double sum_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) {
        sum += value;
    }
    return sum;
}

} // namespace

TEST_CASE("nearest distances are those of all pairs in the plane") {
    const TestMesh mesh = flat_irregular(12, 3);
    const PreparedMesh surface = prepared(mesh);
    const std::vector<Point> points = random_points(surface, 8, 300);
    const double distance = 0.05;
    const SurfaceStatistics result =
        measure(surface, {}, with_radius(points, distance / 2), 2000, 1, {});
    double smallest = 10, sum = 0;
    std::uint64_t lonely = 0;
    std::vector<double> histogram(result.nearest.counts.size(), 0);
    for (std::size_t i = 0; i < points.size(); ++i) {
        double nearest = 10;
        for (std::size_t k = 0; k < points.size(); ++k) {
            if (k != i) {
                nearest =
                    std::min(nearest, length(mesh.position(points[i]) - mesh.position(points[k])));
            }
        }
        smallest = std::min(smallest, nearest);
        if (nearest < result.reach * distance) {
            sum += nearest / distance;
            histogram[static_cast<std::size_t>(nearest / distance / result.nearest.width)] += 1;
        } else {
            ++lonely;
        }
    }
    CHECK(result.reach == 4);
    CHECK(result.smallest == doctest::Approx(smallest / distance).epsilon(1e-9));
    CHECK(result.mean_nearest ==
          doctest::Approx(sum / static_cast<double>(points.size() - lonely)).epsilon(1e-9));
    CHECK(result.lonely == lonely);
    CHECK(result.nearest.counts == histogram);
}

TEST_CASE("what one disk leaves uncovered is the rest of the area") {
    const TestMesh mesh = flat_grid(4, 4, 1, 1);
    const PreparedMesh surface = prepared(mesh);
    const std::vector<SurfaceDisk> one = with_radius({point_at(mesh, 0.5, 0.5)}, 0.15);
    const SurfaceStatistics result = measure(surface, {}, one, 40000, 1, {});
    CHECK(result.uncovered == doctest::Approx(1 - std::numbers::pi * 0.3 * 0.3).epsilon(0.01));
    // The farthest places are the corners.
    CHECK(result.largest_gap == doctest::Approx(std::sqrt(0.5) / 0.3).epsilon(0.02));
    CHECK(result.largest_gap <= std::sqrt(0.5) / 0.3);
    CHECK(result.lonely == 1);
    CHECK(result.smallest == result.reach);
    CHECK(sum_of(result.nearest.counts) == 0);
}

TEST_CASE("random points know nothing of each other, on any surface") {
    // Bends and borders cancel.
    for (const TestMesh& mesh :
         {builtin("icosphere", 3), builtin("terrain", 20), flat_grid(2, 2, 1, 0.2)}) {
        const PreparedMesh surface = prepared(mesh);
        const double count = 3000;
        const double distance = distance_for_count(surface.statistics().area, count);
        const auto samples =
            with_radius(random_points(surface, 4, static_cast<std::uint32_t>(count)), distance / 2);
        const SurfaceStatistics result = measure(surface, {}, samples, 30000, 2, {});
        const auto& g = result.pair_correlation.counts;
        REQUIRE(g.size() == 80);
        for (std::size_t bin = 0; bin + 10 <= g.size(); bin += 10) { // Half a distance each.
            double mean = 0;
            for (std::size_t k = bin; k < bin + 10; ++k) {
                mean += g[k] / 10;
            }
            CHECK(mean == doctest::Approx(1).epsilon(bin == 0 ? 0.25 : 0.08));
        }
    }
}

TEST_CASE("radii that vary are taken in pairs") {
    const TestMesh mesh = flat_grid(4, 4, 1, 1);
    const PreparedMesh surface = prepared(mesh);
    std::vector<SurfaceDisk> samples =
        with_radius({point_at(mesh, 0.3, 0.5), point_at(mesh, 0.5, 0.5)}, 0.05);
    samples[1].radius = 0.2;
    const SurfaceStatistics result = measure(surface, {}, samples, 1000, 1, {});
    CHECK(result.smallest == doctest::Approx(0.8).epsilon(1e-6));
    CHECK(result.lonely == 0);
    CHECK(result.pair_correlation.counts.empty());
}

TEST_CASE("samples of classes are taken by the distances of their classes") {
    const TestMesh mesh = flat_grid(4, 4, 1, 1);
    const PreparedMesh surface = prepared(mesh);
    std::vector<SurfaceDisk> samples =
        with_radius({point_at(mesh, 0.4, 0.5), point_at(mesh, 0.6, 0.5)}, 0.2);
    samples[1].radius = 0.05;
    samples[0].kind = 1;
    samples[1].kind = 2;
    const tools::ClassDistances classes{2, {0.4, 0.16, 0.16, 0.1}};
    const SurfaceStatistics result = measure(surface, {}, samples, 40000, 1, {}, classes);
    CHECK(result.smallest == doctest::Approx(0.2 / 0.16).epsilon(1e-6));
    CHECK(result.pair_correlation.counts.empty());
    REQUIRE(result.rooms.size() == 2);
    // One of the first class keeps 0.4 from the first sample and 0.16 from the second, which is
    // all within the larger disk; one of the second class 0.16 and 0.1.
    CHECK(result.rooms[0].uncovered == doctest::Approx(1 - 3.14159 * 0.16).epsilon(0.02));
    const double both = 3.14159 * (0.16 * 0.16 + 0.1 * 0.1);
    CHECK(result.rooms[1].uncovered > 1 - both);
    CHECK(result.rooms[1].uncovered < 1 - 3.14159 * 0.16 * 0.16);
    CHECK(result.uncovered == doctest::Approx(result.rooms[1].uncovered).epsilon(1e-9));
}
