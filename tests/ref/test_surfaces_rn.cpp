// Surfaces with more than three coordinates: distances of the flat torus by formula and of the
// others by unfolding, and the spacing of samples by both.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <doctest/doctest.h>

#include "files/meshes/mesh_file.hpp"
#include "geometry/lift.hpp"
#include "ref/dart_check.hpp"
#include "ref/distance_check.hpp"
#include "support/replay.hpp"
#include "support/unfolding.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

/// builtin:clifford-torus in the plane: its squares are flat and stay side by side.
class FlatTorus {
  public:
    explicit FlatTorus(int around)
        : around_(static_cast<std::uint32_t>(around)),
          step_(2 * std::sin(std::numbers::pi / around)) {}

    double distance(const Point& a, const Point& b) const {
        const auto p = place(a);
        const auto q = place(b);
        return std::hypot(apart(p[0] - q[0]), apart(p[1] - q[1]));
    }

  private:
    std::array<double, 2> place(const Point& p) const {
        const std::uint32_t i = p.face / 2 / around_;
        const std::uint32_t j = p.face / 2 % around_;
        // Corners (0, 0) (1, 0) (1, 1) and (0, 0) (1, 1) (0, 1).
        const bool is_first = p.face % 2 == 0;
        return {step_ * (i + p.weight1 + (is_first ? p.weight2 : 0)),
                step_ * (j + p.weight2 + (is_first ? 0 : p.weight1))};
    }
    double apart(double d) const {
        const double whole = step_ * around_;
        return std::min(std::abs(d), whole - std::abs(d));
    }

    std::uint32_t around_;
    double step_;
};

/// All points are sources and targets.
void check_by_unfolding(const std::string& name, const TestMesh& mesh, double reach) {
    const std::vector<Point> points = random_points(prepared(mesh), 5, 40);
    const Unfolding unfolding(mesh);
    const Point* current = nullptr;
    std::vector<double> distances;
    check_distances({name, mesh, reach, points, points},
                    [&](const Point& source, std::size_t target) {
                        if (current != &source) {
                            distances = unfolding.distances(source, points, 1.1 * reach);
                            current = &source;
                        }
                        return distances[target];
                    });
}

double smallest_distance(const TestMesh& mesh, const std::vector<Point>& samples, double reach) {
    const Unfolding unfolding(mesh);
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const auto distances = unfolding.distances(samples[i], samples, reach);
        for (std::size_t j = 0; j < samples.size(); ++j) {
            smallest = j == i ? smallest : std::min(smallest, distances[j]);
        }
    }
    return smallest;
}

void check_sampled(const std::string& name, const TestMesh& mesh, double count) {
    INFO(name << " at " << count);
    const PreparedMesh surface = prepared(mesh);
    const SampleParams params = params_for(surface, count);
    const Darts darts = thrown<float>(surface, params);
    CHECK(static_cast<double>(darts.ranks.size()) > 0.7 * count);
    const double smallest = smallest_distance(mesh, darts.samples(), 1.5 * params.min_distance);
    CHECK(smallest >= params.min_distance);
    CHECK(smallest < 1.1 * params.min_distance); // Found at all.
    check_maximal(surface, darts);
    const ReplayReport judged = replay(surface, params, darts.tolerances.error_bound);
    CHECK(judged.wrong == 0);
    CHECK(judged.accepted == darts.ranks.size());
    check_deviation(name, judged);
}

TestMesh lifted(const char* name, int resolution, const char* lift) {
    const tools::MeshFile mesh =
        tools::read_mesh(std::string("builtin:") + name + ":" + std::to_string(resolution));
    const std::vector<tools::Lift> lifts{tools::parse_lift("--lift", lift)};
    tools::LiftedPositions positions = tools::lifted_positions(name, mesh, lifts);
    return {std::move(positions.positions), mesh.triangles, positions.dimension};
}

} // namespace

TEST_CASE("R^n: distances on the Clifford torus are those of the flat torus") {
    const TestMesh mesh = builtin("clifford-torus", 16);
    const FlatTorus torus(16);
    const std::vector<Point> points = random_points(prepared(mesh), 3, 150);
    check_distances({"clifford torus", mesh, 4, {points.begin(), points.begin() + 20}, points},
                    [&](const Point& source, std::size_t target) {
                        return torus.distance(source, points[target]);
                    });
    const Unfolding unfolding(mesh);
    const auto found = unfolding.distances(points[0], points, 1.5);
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double truth = torus.distance(points[0], points[i]);
        CHECK((truth > 1.5) == (found[i] == HUGE_VAL));
        CHECK((truth > 1.5 || std::abs(found[i] - truth) < 1e-12));
    }
}

TEST_CASE("R^n: distances on one-sided and lifted surfaces are those of the unfolded triangles") {
    check_by_unfolding("klein bottle", builtin("klein-bottle", 12), 1.2);
    check_by_unfolding("veronese", builtin("veronese", 3), 0.8);
    check_by_unfolding("lifted terrain", lifted("terrain", 12, "normals:0.3"), 0.4);
}

TEST_CASE("R^n: samples of the Clifford torus keep their distance by formula") {
    const TestMesh mesh = builtin("clifford-torus", 24);
    const FlatTorus torus(24);
    for (const double count : {50.0, 1000.0}) {
        const PreparedMesh surface = prepared(mesh);
        const SampleParams params = params_for(surface, count);
        const std::vector<Point> samples = thrown<float>(surface, params).samples();
        double smallest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < samples.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                smallest = std::min(smallest, torus.distance(samples[i], samples[j]));
            }
        }
        CHECK(smallest >= params.min_distance);
        CHECK(smallest < 1.1 * params.min_distance);
    }
}

TEST_CASE("R^n: samples keep their distance by unfolding and leave no gap") {
    check_sampled("clifford torus", builtin("clifford-torus", 16), 300);
    check_sampled("klein bottle", builtin("klein-bottle", 16), 300);
    check_sampled("klein bottle", builtin("klein-bottle", 16), 1000);
    check_sampled("veronese", builtin("veronese", 3), 300);
    check_sampled("veronese", builtin("veronese", 4), 1000);
    check_sampled("lifted terrain", lifted("terrain", 20, "normals:0.3"), 300);
}
