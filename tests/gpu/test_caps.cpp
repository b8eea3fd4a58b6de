// Meshes with flat triangles, whose corners lie on the opposite sides: the sets are those of the
// twin, whether lanes or groups compute the disks, and trim them or not.
#include <array>
#include <random>

#include <doctest/doctest.h>

#include "sets.hpp"
#include "support/cap_meshes.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {
namespace {

Runner runner_of_plan(const RunPlan& plan) {
    RunnerOptions options;
    options.plan = plan;
    const Context& context = shared_context();
    return expect(Runner::create(context.device(), context.queue(), options));
}

/// Runners that compute disks in all ways.
std::array<Runner, 3> all_runners() {
    RunPlan trimming, groups;
    trimming.trims = true;
    groups.disks_by = DisksBy::groups;
    return {runner_of_plan({}), runner_of_plan(trimming), runner_of_plan(groups)};
}

void check_with_all(std::array<Runner, 3>& runners, const PreparedMesh& mesh,
                    const SampleParams& params) {
    for (Runner& runner : runners) {
        const SampleSet set = expect(runner.sample_and_wait(mesh, params));
        CHECK(points_of(set) == float_set(mesh, params, set.report.plan.error_bound));
    }
}

} // namespace

TEST_SUITE("caps") {
    TEST_CASE("sets on flat triangles are those of the twin") {
        std::array<Runner, 3> runners = all_runners();
        SampleParams params;
        params.min_distance = 0.633;
        params.seed = 11;
        check_with_all(runners, prepared(shared_mesh("cases/cap_8.obj").value()), params);
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            CAPTURE(seed);
            std::mt19937_64 random(seed);
            const TestMesh mesh = cap_mesh(
                [&](std::uint32_t below) { return static_cast<std::uint32_t>(random() % below); });
            const PreparedMesh surface = prepared(mesh);
            params.seed = seed;
            params.min_distance = 0.2 * surface.statistics().diagonal;
            check_with_all(runners, surface, params);
        }
    }
}

} // namespace geodisk::test
