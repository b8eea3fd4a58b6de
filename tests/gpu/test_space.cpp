// Surfaces sampled by straight-line distance: sets against sequential dart throwing, with the
// twin's grid and by brute force over double coordinates.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "baselines/space_disks.hpp"
#include "device_run.hpp"
#include "kernels/pool.hpp"
#include "kernels/space.hpp"
#include "sets.hpp"
#include "support/device_abilities.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {
namespace {

SampleSet sample_space(const TestMesh& mesh, const SampleParams& params, Metric metric,
                       const RunnerOptions& options = {},
                       const Context& context = shared_context()) {
    Runner runner = expect(Runner::create(context.device(), context.queue(), options));
    const PreparedMesh surface = prepared(mesh);
    return expect(runner.sample_and_wait(
        expect(Domain::surface_in_space(mesh.view(), surface, params, metric))));
}

/// In dart order.
std::vector<Point> candidates_of(const PreparedMesh& mesh, const SampleParams& params) {
    return ref::draw_pool(ref::Surface<double>(mesh, params), params).by_rank();
}

Points points_at(const std::vector<Point>& candidates, const std::vector<std::uint32_t>& ranks) {
    Points points;
    for (const std::uint32_t rank : ranks) {
        const Point& c = candidates[rank];
        points.push_back({c.face, static_cast<float>(c.weight1), static_cast<float>(c.weight2)});
    }
    return points;
}

Points twin_set(const TestMesh& mesh, const SampleParams& params, Metric metric) {
    const PreparedMesh surface = prepared(mesh);
    const ref::SpacePoints points = ref::draw_in_space(mesh.view(), surface, params);
    const bool is_curved = metric == Metric::approximate;
    return points_at(candidates_of(surface, params),
                     ref::throw_darts(ref::space_pool<float>(points, is_curved)));
}

/// Every candidate against all samples before it.
Points plain_set(const TestMesh& mesh, const SampleParams& params, double guard) {
    const auto candidates = candidates_of(prepared(mesh), params);
    const double limit = params.min_distance * (1 + guard);
    std::vector<std::uint32_t> ranks;
    std::vector<Vec3> samples;
    for (std::uint32_t rank = 0; rank < candidates.size(); ++rank) {
        const Vec3 at = mesh.position(
            {candidates[rank].face, candidates[rank].weight1, candidates[rank].weight2});
        bool is_free = true;
        for (std::size_t i = 0; i < samples.size() && is_free; ++i) {
            is_free = glm::length(samples[i] - at) >= limit;
        }
        if (is_free) {
            ranks.push_back(rank);
            samples.push_back(at);
        }
    }
    return points_at(candidates, ranks);
}

void check_sets(const TestMesh& mesh, double count) {
    const SampleParams params = params_for(prepared(mesh), count);
    const SampleSet set = sample_space(mesh, params, Metric::euclidean);
    CHECK(points_of(set) == twin_set(mesh, params, Metric::euclidean));
    CHECK(points_of(set) == plain_set(mesh, params, set.report.guard));
    const SampleSet curved = sample_space(mesh, params, Metric::approximate);
    CHECK(points_of(curved) == twin_set(mesh, params, Metric::approximate));
}

} // namespace

TEST_SUITE("space") {
    TEST_CASE("sets equal sequential dart throwing by straight-line distance") {
        const std::pair<const char*, int> shapes[] = {
            {"cube", 1},     {"icosphere", 4}, {"torus-knot", 12}, {"folded-sheet", 16},
            {"terrain", 48}, {"moebius", 8},   {"plate", 8}};
        for (const auto& [name, resolution] : shapes) {
            const auto& shown = name; // Before Clang 16 lambdas capture no bindings.
            CAPTURE(shown);
            for (const double count : {1.0, 30.0, 1500.0}) {
                CAPTURE(count);
                check_sets(builtin(name, resolution), count);
            }
        }
    }

    TEST_CASE("a surface far from the origin, and a flat one") {
        TestMesh far = builtin("icosphere", 3);
        for (double& x : far.positions) {
            x += 1e7;
        }
        check_sets(far, 300);
        check_sets(builtin("unfolded-sheet", 8), 500);
    }

    TEST_CASE("the folded sheet loses samples that geodesic distance keeps") {
        const TestMesh mesh = builtin("folded-sheet", 16);
        SampleParams params = params_for(prepared(mesh), 1000);
        const SampleSet straight = sample_space(mesh, params, Metric::euclidean);
        const SampleSet geodesic = sample(prepared(mesh), params);
        CHECK(straight.report.candidates == geodesic.report.candidates);
        CHECK(straight.samples.size() < geodesic.samples.size());
        // Faces and weights are those of the same candidates.
        CHECK(points_of(straight)[0] == points_of(geodesic)[0]);
        CHECK(points_of(straight)[0] == points_at(candidates_of(prepared(mesh), params), {0})[0]);
    }

    // The reference of the baselines: double precision, and asin of the C library.
    TEST_CASE("approximate samples keep their distance by the closed form, and leave no gap") {
        constexpr double kRounding = 1e-4;
        const TestMesh mesh = builtin("torus-knot", 16);
        const PreparedMesh surface = prepared(mesh);
        const SampleParams params = params_for(surface, 300);
        const auto candidates = candidates_of(surface, params);
        std::map<SamplePoint, std::uint32_t> ranks;
        for (std::uint32_t rank = 0; rank < candidates.size(); ++rank) {
            ranks[points_at(candidates, {rank})[0]] = rank;
        }
        REQUIRE(ranks.size() == candidates.size());
        std::vector<std::uint32_t> set;
        for (const SamplePoint& point :
             points_of(sample_space(mesh, params, Metric::approximate))) {
            set.push_back(ranks.at(point));
        }
        const auto points = ref::oriented_points(mesh.view(), candidates);
        const auto length = [&](std::uint32_t a, std::uint32_t b) {
            return ref::curve_length(points[a], points[b]) / params.min_distance;
        };
        std::uint32_t too_close = 0, free = 0;
        for (std::uint32_t rank = 0; rank < points.size(); ++rank) {
            double nearest = 1e9;
            for (std::size_t i = 0; i < set.size() && set[i] < rank; ++i) {
                nearest = std::min(nearest, length(set[i], rank));
            }
            const bool is_sample = std::binary_search(set.begin(), set.end(), rank);
            too_close += is_sample && nearest < 1 - kRounding;
            free += !is_sample && nearest > 1 + kRounding;
        }
        CHECK(too_close == 0);
        CHECK(free == 0);
    }

    TEST_CASE("no tuning changes the set, and lists grow") {
        const TestMesh mesh = builtin("torus-knot", 16);
        const SampleParams params = params_for(prepared(mesh), 500);
        const auto want = twin_set(mesh, params, Metric::approximate);
        for (const Reads reads : reads_of(shared_context().report())) {
            RunnerOptions options;
            options.sampler.tuning.reads = reads;
            options.sampler.rounding = Rounding::emulated;
            options.plan.slots = kMinSlots;
            options.plan.list_capacity = 4;
            options.plan.step_budget = 5;
            const SampleSet set = sample_space(mesh, params, Metric::approximate, options);
            CHECK(points_of(set) == want);
            CHECK(set.report.regrown > 0);
        }
    }

    TEST_CASE("darts in chunks give the same set, and stop at a count") {
        const TestMesh mesh = builtin("torus-knot", 16);
        SampleParams params = params_for(prepared(mesh), 500);
        for (const Metric metric : {Metric::euclidean, Metric::approximate}) {
            const auto want = twin_set(mesh, params, metric);
            RunnerOptions options;
            for (const std::uint32_t stages : {1u, 3u}) {
                options.plan.stages = stages;
                const SampleSet set = sample_space(mesh, params, metric, options);
                CHECK(set.report.chunks > 1);
                CHECK(points_of(set) == want);
            }
            SampleParams darts = params;
            darts.stop_count = static_cast<std::uint32_t>(want.size() / 2);
            const SampleSet set = sample_space(mesh, darts, metric);
            CHECK(points_of(set) == std::vector(want.begin(), want.begin() + darts.stop_count));
            // All up to the last sample.
            const auto candidates = candidates_of(prepared(mesh), darts);
            const std::uint32_t last = set.report.candidates - 1;
            REQUIRE(last < candidates.size());
            CHECK(points_at(candidates, {last})[0] == points_of(set).back());
        }
    }

    TEST_CASE("what has no straight-line distance is refused") {
        const TestMesh cube = builtin("cube", 4);
        const TestMesh ball = builtin("icosphere", 1);
        const PreparedMesh mesh = prepared(cube);
        const SampleParams params = params_for(mesh, 100);
        const auto in_space = [&](const MeshView& view, const SampleParams& of) {
            return Domain::surface_in_space(view, mesh, of, Metric::euclidean);
        };
        CHECK(!in_space(ball.view(), params));
        CHECK(!in_space({cube.positions, cube.triangles, 4}, params));
        CHECK(!in_space(cube.view(), SampleParams{}));
        CHECK(in_space(cube.view(), params));
        const RadiusField radii = radius_field(mesh, wavy_factors(cube, 0.5));
        const auto refused = in_space(cube.view(), params_for(mesh, 100, 1, &radii));
        REQUIRE_FALSE(refused);
        CHECK(refused.error().message ==
              "metric and radii exclude each other: distances through space do not vary");
    }

    TEST_CASE("the validation layer has nothing to say about a run in space") {
        ContextOptions options;
        options.validation = true;
        Context context = expect(Context::create(options));
        const TestMesh mesh = builtin("torus-knot", 8);
        const SampleParams params = params_for(prepared(mesh), 200);
        for (const Reads reads : reads_of(context.report())) {
            RunnerOptions run;
            run.sampler.tuning.reads = reads;
            run.plan.stages = 1;
            for (const Metric metric : {Metric::euclidean, Metric::approximate}) {
                CHECK(points_of(sample_space(mesh, params, metric, run, context)) ==
                      twin_set(mesh, params, metric));
            }
        }
        CHECK(context.validation_message_count() == 0);
    }
}

} // namespace geodisk::test
