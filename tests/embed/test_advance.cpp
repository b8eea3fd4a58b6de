// Next steps that a job asks for, step by step, and when it is asked too early, too late or twice.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/domain/stages.hpp"
#include "engine/job/plan.hpp"
#include "gpu/device_run.hpp"
#include "gpu/sets.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {
namespace {

/// Follows the advice, asking twice for each, until the run is complete.
/// Returns what was advised, without repeats.
std::vector<Next> follow(DeviceRun& run, Advice& last) {
    std::vector<Next> steps;
    for (std::uint32_t i = 0; i < 10'000; ++i) {
        const gpu::ControlRec control = run.control();
        last = expect(run.job().advance(control));
        const Advice again = expect(run.job().advance(control));
        REQUIRE(again.next == last.next);
        REQUIRE(again.plan.pool_bytes() == last.plan.pool_bytes());
        if (steps.empty() || steps.back() != last.next) {
            steps.push_back(last.next);
        }
        if (!run.follow(last)) {
            return steps;
        }
    }
    throw std::runtime_error("the advice leads nowhere");
}

bool has(const std::vector<Next>& steps, Next next) {
    return std::find(steps.begin(), steps.end(), next) != steps.end();
}

struct Knot {
    PreparedMesh mesh = prepared(builtin("torus-knot", 12));
    SampleParams params = params_for(mesh, 60);
};

} // namespace

TEST_SUITE("advance") {
    TEST_CASE("from the first stages to the samples") {
        const Knot knot;
        RunPlan plan;
        plan.stages = 1;
        DeviceRun run(knot.mesh, knot.params, plan);
        Advice last;
        const std::vector<Next> steps = follow(run, last);
        CHECK(last.next == Next::complete);
        REQUIRE(stages_of(knot.mesh, knot.params).pool_stages() == 4);
        CHECK(std::count(steps.begin(), steps.end(), Next::begin) == 4);
        CHECK(std::count(steps.begin(), steps.end(), Next::finish) == 4);
        CHECK(ready_points(run) == float_set(knot.mesh, knot.params, run.plan().error_bound));
        // Nothing more comes, and the run may begin anew.
        CHECK(expect(run.job().advance(run.control())).next == Next::complete);
        run.job().set_seed(knot.params.seed);
        CHECK(follow(run, last) == steps);
    }

    TEST_CASE("larger slices, lists and buffers of samples") {
        const Knot knot;
        RunPlan plan;
        plan.slots = kMinSlots;
        plan.sample_capacity = 20;
        DeviceRun run(knot.mesh, knot.params, plan);
        run.set_plan(tightened(run.plan()));
        Advice last;
        const std::vector<Next> steps = follow(run, last);
        CHECK(last.next == Next::complete);
        CHECK(has(steps, Next::larger_pool));
        CHECK(has(steps, Next::larger_samples));
        CHECK(ready_points(run) == float_set(knot.mesh, knot.params, run.plan().error_bound));
    }

    TEST_CASE("records that are not there yet, or of before, say nothing") {
        const Knot knot;
        DeviceRun run(knot.mesh, knot.params);
        const auto next = [&](const gpu::ControlRec& control) {
            return expect(run.job().advance(control)).next;
        };
        CHECK(next({}) == Next::begin);
        run.begin(1);
        CHECK(next({}) == Next::begin); // What is left of it.
        CHECK(next(run.control()) == Next::begin);
        run.begin();
        CHECK(next({}) == Next::go_on);
        gpu::ControlRec garbage;
        std::memset(&garbage, 0x5b, sizeof garbage);
        CHECK(next(garbage) == Next::go_on);
        while (run.control().done == 0) {
            run.rounds(1);
        }
        const gpu::ControlRec done = run.control();
        CHECK(next(done) == Next::finish);
        run.rewind();
        CHECK(next(done) == Next::go_on);
        CHECK(next(run.control()) == Next::finish);
        run.finish(1);
        CHECK(next(run.control()) == Next::finish); // What is left of it.
        run.finish();
        CHECK(next(run.control()) == Next::complete);
    }

    TEST_CASE("what no memory helps against is an error, however often it is asked") {
        const Knot knot;
        DeviceRun run(knot.mesh, knot.params);
        run.begin();
        const gpu::ControlRec good = run.control();
        const auto check = [&](const gpu::ControlRec& control, Status status, const char* text) {
            for (int i = 0; i < 2; ++i) {
                const auto advice = run.job().advance(control);
                REQUIRE_FALSE(advice);
                CHECK(advice.error().status == status);
                CHECK(advice.error().message.find(text) != std::string::npos);
            }
        };
        gpu::ControlRec bad = good;
        bad.abi = gpu::kAbi + 1;
        check(bad, Status::internal, "control record");
        bad = good;
        bad.overflow = gpu::kOverflowEndless;
        bad.endless_face = 8;
        check(bad, Status::mesh_rejected, "on face 7 could not be computed");
        bad.overflow = gpu::kOverflowCandidates;
        check(bad, Status::internal, "candidates");
        bad.overflow = gpu::kOverflowSamples;
        bad.accepted = 0xfffffff0;
        check(bad, Status::job_too_large, "binds at most");
        bad.overflow = gpu::kOverflowWindows;
        const auto advice = run.job().advance(bad, 1);
        REQUIRE_FALSE(advice);
        CHECK(advice.error().status == Status::workspace_too_small);
        CHECK(advice.error().message.find("bytes") != std::string::npos);
        // It all changes nothing.
        Advice last;
        follow(run, last);
        CHECK(last.next == Next::complete);
    }
}

} // namespace geodisk::test
