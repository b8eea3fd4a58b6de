// Disks that lanes leave to work groups: they change no set. Those that must be trimmed are in
// test_pipeline.cpp.
#include <doctest/doctest.h>

#include "device_run.hpp"
#include "sets.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {
namespace {

/// Leaves disks of more than `after` windows and events to groups.
RunnerOptions leaving_after(std::uint32_t after) {
    RunnerOptions options;
    options.plan.large_groups = 2;
    options.plan.large_after = after;
    return options;
}

void check_same(const PreparedMesh& mesh, const SampleParams& params) {
    const SampleSet base = sample(mesh, params);
    const auto want = points_of(base);
    CHECK(want == float_set(mesh, params, base.report.plan.error_bound));
    for (const std::uint32_t after : {1u, 100u}) {
        CAPTURE(after);
        RunnerOptions options = leaving_after(after);
        CHECK(points_of(sample(mesh, params, options)) == want);
        // Slices that overflow, and steps that end anywhere.
        options.plan.window_capacity = 2;
        options.plan.large_window_capacity = 2;
        options.plan.large_table_capacity = 4;
        options.plan.step_budget = 1;
        const SampleSet tight = sample(mesh, params, options);
        CHECK(points_of(tight) == want);
        CHECK(tight.report.regrown > 0);
    }
}

} // namespace

TEST_SUITE("large disks") {
    TEST_CASE("lanes leave those of many windows, and no others, to groups") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 12));
        for (const std::uint32_t after : {1u, 100u, 1u << 20}) {
            CAPTURE(after);
            RunPlan plan = leaving_after(after).plan;
            DeviceRun run(mesh, params_for(mesh, 300), plan);
            run.follow_all();
            const gpu::ControlRec control = run.control();
            CHECK(control.done == 1);
            CHECK((control.large_disks > 0) == (after <= 100));
            CHECK((control.large_disks == control.disks) == (after == 1));
        }
    }

    // A disk begins with three windows: a slice that had room for two lost the third.
    TEST_CASE("work groups of the least slices lose no window") {
        const PreparedMesh mesh = prepared(builtin("cube", 1));
        const SampleParams params = params_for(mesh, 40);
        RunnerOptions options;
        options.plan.disks_by = DisksBy::groups;
        options.plan.window_capacity = 2;
        const SampleSet set = sample(mesh, params, options);
        CHECK(set.report.plan.window_capacity >= gpu::kMinGroupWindows);
        CHECK(points_of(set) == float_set(mesh, params, set.report.plan.error_bound));
    }

    TEST_CASE("a small pool changes no set of few large disks") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 8));
        const SampleParams params = params_for(mesh, 3);
        const Points want = points_of(sample(mesh, params));
        for (const std::uint64_t pool : {std::uint64_t{1} << 20, std::uint64_t{3} << 16}) {
            CAPTURE(pool);
            RunnerOptions options;
            options.pool_bytes = pool;
            CHECK(points_of(sample(mesh, params, options)) == want);
        }
    }

    TEST_CASE("they change no set") {
        for (const auto& [name, resolution] :
             {std::pair{"lattice", 1}, std::pair{"crossed-sheet", 6}, std::pair{"veronese", 3},
              std::pair{"spike", 5}}) {
            const auto& shown = name; // Before Clang 16 lambdas capture no bindings.
            CAPTURE(shown);
            const PreparedMesh mesh = prepared(builtin(name, resolution));
            check_same(mesh, params_for(mesh, 100));
        }
    }

    TEST_CASE("nor do they where radii vary or samples are given") {
        const TestMesh shape = builtin("torus-knot", 8);
        const PreparedMesh mesh = prepared(shape);
        const RadiusField rough = radius_field(mesh, rough_factors(shape, 0.05));
        check_same(mesh, params_for(mesh, 100, 1, &rough));
        SampleParams params = params_for(mesh, 100);
        const SampleSet first = sample(mesh, params);
        params.existing = std::span(first.samples).first(20);
        CHECK(points_of(sample(mesh, params, leaving_after(40))) ==
              points_of(sample(mesh, params)));
    }
}

} // namespace geodisk::test
