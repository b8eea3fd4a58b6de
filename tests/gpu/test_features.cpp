// Samples on corners and curves, before those on faces.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <geodisk/features.hpp>

#include "device_run.hpp"
#include "engine/domain/feature_darts.hpp"
#include "sets.hpp"
#include "support/geodesic_query.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {
namespace {

Features found(const TestMesh& shape, const PreparedMesh& mesh, double degrees = 30) {
    return expect(Features::find(shape.view(), mesh, degrees));
}

SampleSet sample_features(const PreparedMesh& mesh, const SampleParams& params,
                          const Features& features) {
    Runner runner = expect(Runner::create(shared_context().device(), shared_context().queue()));
    return expect(runner.sample_and_wait(expect(feature_domain(mesh, params, features))));
}

std::size_t count_of(const std::vector<Sample>& samples, FeatureKind kind) {
    return static_cast<std::size_t>(std::ranges::count_if(
        samples, [kind](const Sample& sample) { return feature_of(sample) == kind; }));
}

double smallest_distance(const TestMesh& shape, const std::vector<Sample>& samples, double reach) {
    std::vector<Point> points;
    for (const Sample& s : samples) {
        points.push_back({s.face, s.weights[1], s.weights[2]});
    }
    GeodesicQuery<double> query(prepared(shape), reach, points, tight_tolerances());
    double smallest = kUnreachable;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::vector<double> distances = query.from(points[i]);
        for (std::size_t k = 0; k < points.size(); ++k) {
            smallest = k == i ? smallest : std::min(smallest, distances[k]);
        }
    }
    return smallest;
}

} // namespace

TEST_SUITE("features") {
    TEST_CASE("of a cube, a sphere and a square") {
        const TestMesh cube = builtin("cube", 3);
        const PreparedMesh of_cube = prepared(cube);
        const double side = std::sqrt(of_cube.statistics().area / 6);
        for (const double degrees : {1.0, 30.0, 89.0}) {
            const Features features = found(cube, of_cube, degrees);
            CHECK(features.corners().size() == 8);
            CHECK(features.length() == doctest::Approx(12 * side));
        }
        CHECK(found(cube, of_cube, 90).edges().empty());
        const TestMesh sphere = builtin("icosphere", 3);
        CHECK(found(sphere, prepared(sphere)).edges().empty());
        TestMesh square;
        square.positions = {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0};
        square.triangles = {0, 1, 2, 0, 2, 3};
        const Features border = found(square, prepared(square));
        CHECK(border.edges().size() == 4);
        CHECK(border.corners().size() == 4);
        CHECK(border.length() == doctest::Approx(8));
        for (const double wrong : {0.0, 0.5, 181.0, std::nan("")}) {
            CHECK_FALSE(Features::find(square.view(), prepared(square), wrong));
        }
        CHECK_FALSE(Features::find(square.view(), of_cube, 30));
    }

    TEST_CASE("they are sampled first, as the twin does, and the faces with them as given") {
        const TestMesh shape = builtin("cube", 6);
        const PreparedMesh mesh = prepared(shape);
        const Features features = found(shape, mesh);
        SampleParams params = params_for(mesh, 300, 5);
        const SampleSet set = sample_features(mesh, params, features);
        CHECK(test::points_of(set) == listed_set(mesh, params, set.report.plan.error_bound,
                                                 points_of(feature_darts(mesh, params, features))));
        CHECK(count_of(set.samples, FeatureKind::corner) == 8);
        CHECK(
            std::ranges::all_of(set.samples.begin(), set.samples.begin() + 8, [](const Sample& s) {
                return feature_of(s) == FeatureKind::corner;
            }));
        // Rényi's parking constant, for 12 edges that end in corners.
        const double most = features.length() / params.min_distance;
        const auto on_curves = static_cast<double>(count_of(set.samples, FeatureKind::curve));
        CHECK(on_curves > 0.6 * most - 12);
        CHECK(on_curves < 0.85 * most);
        params.existing = set.samples;
        const SampleSet all = sample(mesh, params);
        CHECK(all.existing == set.samples.size());
        CHECK(all.samples.size() > 250);
        CHECK(smallest_distance(shape, all.samples, 1.1 * params.min_distance) >=
              params.min_distance);
    }

    TEST_CASE("corners too close to others are left out") {
        const TestMesh shape = builtin("cube", 6);
        const PreparedMesh mesh = prepared(shape);
        SampleParams params;
        params.min_distance = 1.2 * std::sqrt(mesh.statistics().area / 6);
        const SampleSet set = sample_features(mesh, params, found(shape, mesh));
        const std::size_t corners = count_of(set.samples, FeatureKind::corner);
        CHECK(corners > 1);
        CHECK(corners < 8);
        CHECK(smallest_distance(shape, set.samples, 2 * params.min_distance) >=
              params.min_distance);
    }

    TEST_CASE("with radii that vary, masks, existing samples and keys") {
        const TestMesh shape = builtin("cube", 6);
        const PreparedMesh mesh = prepared(shape);
        const Features features = found(shape, mesh);
        const RadiusField radii = radius_field(mesh, wavy_factors(shape, 0.4));
        SampleParams params = params_for(mesh, 300, 5, &radii);
        std::vector<std::uint32_t> keys(mesh.face_count());
        for (std::uint32_t face = 0; face < keys.size(); ++face) {
            keys[face] = 7 * face + 3;
        }
        params.face_keys = keys;
        const std::vector<std::uint8_t> mask = mask_above(shape, 0);
        params.face_mask = mask;
        const std::vector<Sample> given{{0, {0.5f, 0.25f, 0.25f}}};
        params.existing = given;
        const SampleSet set = sample_features(mesh, params, features);
        CHECK(set.existing == 1);
        CHECK(test::points_of(set) == listed_set(mesh, params, set.report.plan.error_bound,
                                                 points_of(feature_darts(mesh, params, features))));
        CHECK(std::all_of(set.samples.begin() + 1, set.samples.end(),
                          [&](const Sample& s) { return mask[s.face] != 0; }));
        CHECK(set.samples.size() > 20);
    }

    TEST_CASE("what takes no features") {
        const TestMesh shape = builtin("cube", 2);
        const PreparedMesh mesh = prepared(shape);
        const Features features = found(shape, mesh);
        SampleParams params = params_for(mesh, 100);
        const auto refuses = [&](const PreparedMesh& on, const char* part) {
            const auto domain = feature_domain(on, params, features);
            REQUIRE_FALSE(domain);
            CHECK(domain.error().status == Status::invalid_argument);
            CHECK(domain.error().message.find(part) != std::string::npos);
        };
        const PreparedMesh other = prepared(builtin("cube", 2));
        refuses(other, "of another mesh");
        params.darts = 10;
        refuses(mesh, "no darts");
        params.darts = 0;
        const RadiusField density = density_field(mesh, rough_density(shape));
        params.radii = &density;
        refuses(mesh, "features and density");
        params.radii = nullptr;
        const TestMesh sphere = builtin("icosphere", 2);
        const PreparedMesh smooth = prepared(sphere);
        const auto none = feature_domain(smooth, params, found(sphere, smooth, 60));
        REQUIRE_FALSE(none);
        CHECK(none.error().message == "no feature lies on a face that takes samples");
    }
}

} // namespace geodisk::test
