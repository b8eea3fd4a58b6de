// Darts thrown chunk by chunk: the set of one chunk, of the pool they make, and of sequential dart
// throwing, whatever the chunks; and runs that stop at a count.
#include <doctest/doctest.h>

#include <utility>
#include <vector>

#include "constants.h"
#include "device_run.hpp"
#include "lib/frame.hpp"
#include "sets.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {
namespace {

RunnerOptions by_stages(std::uint32_t stages) {
    RunnerOptions options;
    options.plan.stages = stages;
    return options;
}

SampleParams darts_for(const PreparedMesh& mesh, double count, std::uint32_t darts,
                       std::uint32_t stop_count = 0) {
    SampleParams params = params_for(mesh, count);
    params.darts = darts;
    params.stop_count = stop_count;
    return params;
}

Points first_of(const Points& points, std::size_t count) {
    return {points.begin(), points.begin() + static_cast<std::ptrdiff_t>(count)};
}

} // namespace

TEST_SUITE("darts") {
    TEST_CASE("the set is that of sequential dart throwing, and just as many are thrown") {
        const PreparedMesh meshes[] = {
            prepared(builtin("torus-knot", 12)), prepared(builtin("cube", 1)),
            prepared(builtin("folded-sheet", 16)), prepared(builtin("moebius", 8))};
        for (const PreparedMesh& mesh : meshes) {
            for (const std::uint32_t darts : {1u, 7u, 1'400u, 10'000u, 33'333u}) {
                CAPTURE(darts);
                const SampleParams params = darts_for(mesh, 300, darts);
                const SampleSet set = sample(mesh, params);
                CHECK(set.report.candidates == darts);
                CHECK(set.report.chunks == (darts < 1'450 ? 1 : darts < 11'000 ? 3 : 5));
                CHECK(points_of(set) == double_set(mesh, params, set.report.plan.error_bound));
            }
        }
    }

    TEST_CASE("more darts keep the samples of fewer") {
        const PreparedMesh mesh = prepared(builtin("lattice", 1));
        const Points few = points_of(sample(mesh, darts_for(mesh, 800, 9'000)));
        const Points more = points_of(sample(mesh, darts_for(mesh, 800, 25'000)));
        REQUIRE(more.size() > few.size());
        CHECK(first_of(more, few.size()) == few);
    }

    TEST_CASE("one dart is one sample") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 2));
        const SampleSet set = sample(mesh, darts_for(mesh, 300, 1));
        CHECK(set.samples.size() == 1);
        CHECK(set.report.candidates == 1);
    }

    TEST_CASE("a pool is the same stage by stage") {
        for (const char* const name : {"lattice", "cube", "moebius"}) {
            const PreparedMesh mesh = prepared(builtin(name, 1));
            const SampleParams params = params_for(mesh, 800);
            const SampleSet whole = sample(mesh, params);
            CHECK(whole.report.chunks == 1);
            for (const std::uint32_t stages : {1u, 2u, 3u}) {
                const SampleSet parts = sample(mesh, params, by_stages(stages));
                CHECK(parts.report.chunks == (4 + stages - 1) / stages);
                CHECK(points_of(parts) == points_of(whole));
                CHECK(parts.report.candidates == whole.report.candidates);
            }
        }
    }

    TEST_CASE("one, two and seven chunks give one set") {
        const TestMesh knot = builtin("torus-knot", 8);
        const PreparedMesh mesh = prepared(knot);
        const RadiusField radii = radius_field(mesh, wavy_factors(knot, 0.3));
        for (const RadiusField* const field : {static_cast<const RadiusField*>(nullptr), &radii}) {
            SampleParams params = params_for(mesh, 150, 1, field);
            params.pool_ratio = 35;
            const Points whole = points_of(sample(mesh, params));
            for (const auto& [stages, chunks] : {std::pair{7u, 1u}, {4u, 2u}, {1u, 7u}}) {
                const SampleSet parts = sample(mesh, params, by_stages(stages));
                CHECK(parts.report.chunks == chunks);
                CHECK(points_of(parts) == whole);
            }
        }
    }

    TEST_CASE("a run stops at exactly the count asked for, with the first samples") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 12));
        const SampleParams all = darts_for(mesh, 400, 12'000);
        const SampleSet whole = sample(mesh, all);
        const Points points = points_of(whole);
        const auto size = static_cast<std::uint32_t>(points.size());
        for (const std::uint32_t count : {1u, 2u, 100u, size - 1, size}) {
            CAPTURE(count);
            const SampleParams params = darts_for(mesh, 400, 12'000, count);
            const Points want = first_of(points, count);
            std::vector<RunnerOptions> ways{{}};
            for (const std::uint32_t slots : {kMinSlots, 37u, 1'000u}) {
                ways.emplace_back().plan.slots = slots;
            }
            std::vector<std::uint32_t> darts;
            for (const RunnerOptions& options : ways) {
                const SampleSet set = sample(mesh, params, options);
                CHECK(points_of(set) == want);
                darts.push_back(set.report.candidates);
            }
            CHECK(want == double_set(mesh, params, ref::frame_of(mesh, params).first_error()));
            // Just so many darts it takes, and none less.
            CHECK(darts == std::vector<std::uint32_t>(ways.size(), darts[0]));
            CHECK(sample(mesh, darts_for(mesh, 400, darts[0])).samples.size() == count);
            if (darts[0] > 1) {
                CHECK(sample(mesh, darts_for(mesh, 400, darts[0] - 1)).samples.size() == count - 1);
            }
        }
    }

    TEST_CASE("a pool stops at a count as well") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 3));
        SampleParams params = params_for(mesh, 300);
        const Points points = points_of(sample(mesh, params));
        params.stop_count = 200;
        for (const std::uint32_t stages : {1u, 4u}) {
            CHECK(points_of(sample(mesh, params, by_stages(stages))) == first_of(points, 200));
        }
    }

    TEST_CASE("a count out of reach uses up the darts and returns what there is") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 3));
        const SampleParams params = darts_for(mesh, 100, 5'000, 4'000);
        const SampleSet set = sample(mesh, params);
        CHECK(set.report.candidates == 5'000);
        CHECK(points_of(set) == points_of(sample(mesh, darts_for(mesh, 100, 5'000))));
        CHECK(set.samples.size() < 200);
    }

    TEST_CASE("overflows while earlier samples reject change nothing") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 4));
        const SampleParams params = darts_for(mesh, 300, 9'000);
        const Points want = points_of(sample(mesh, params));
        RunnerOptions tight;
        tight.plan.window_capacity = 2;
        tight.plan.table_capacity = 4;
        tight.plan.list_capacity = 4;
        tight.pool_bytes = 1 << 20;
        const SampleSet set = sample(mesh, params, tight);
        CHECK(points_of(set) == want);
        CHECK(set.report.regrown > 0);

        // The first stage has shorter lists than the third, which overflow in the disks of samples.
        RunPlan plan;
        plan.list_capacity = 64;
        DeviceRun run(mesh, darts_for(mesh, 300, 20'000), plan);
        std::uint32_t first_overflows = 0, overflows = 0;
        for (;;) {
            const gpu::ControlRec control = run.control();
            const Advice advice = expect(run.job().advance(control));
            if (!run.follow(advice)) {
                REQUIRE(advice.next == Next::complete);
                break;
            }
            if (advice.next == Next::larger_pool) {
                CHECK(control.overflow == gpu::kOverflowConflicts);
                CHECK(run.control().next_sample == control.next_sample);
                CHECK(run.control().accepted == control.accepted);
                ++(run.push().first_stage == 0 ? first_overflows : overflows);
            }
        }
        CHECK(first_overflows == 0);
        CHECK(overflows > 0);
        const auto samples = run.read<gpu::SampleRec>(BufferRole::samples, want.size());
        std::uint32_t wrong = 0;
        for (std::size_t i = 0; i < want.size(); ++i) {
            wrong +=
                want[i] != SamplePoint{samples[i].face, samples[i].weight1, samples[i].weight2};
        }
        CHECK(wrong == 0);
    }

    TEST_CASE("the buffer of samples grows and keeps those of earlier stages") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 12));
        const SampleParams params = darts_for(mesh, 500, 10'000);
        RunnerOptions options;
        options.plan.slots = 16;
        options.plan.sample_capacity = 20;
        CHECK(points_of(sample(mesh, params, options)) == points_of(sample(mesh, params)));
    }

    TEST_CASE("no stages at once and no slots change the guard of long chains") {
        const PreparedMesh mesh = prepared(needle_disk(1'200));
        for (const std::uint32_t stop_count : {0u, 40u}) {
            SampleParams params = params_for(mesh, 60);
            params.stop_count = stop_count;
            const SampleSet base = sample(mesh, params);
            CHECK(base.report.guard > 0x1p-13);
            for (const std::uint32_t slots : {kMinSlots, 1'000u}) {
                for (const std::uint32_t stages : {1u, 4u}) {
                    RunnerOptions options = by_stages(stages);
                    options.plan.slots = slots;
                    const SampleSet set = sample(mesh, params, options);
                    CHECK(set.report.guard == base.report.guard);
                    CHECK(points_of(set) == points_of(base));
                }
            }
        }
    }

    TEST_CASE("progress goes on through the stages, and any of them can be cancelled") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 4));
        const SampleParams params = darts_for(mesh, 1'000, 40'000);
        Context& context = shared_context();
        Runner runner = expect(Runner::create(context.device(), context.queue()));
        std::uint32_t passed = 0;
        const auto cancelled = runner.sample_and_wait(mesh, params, [&](const Progress& state) {
            CHECK(state.candidates == 40'000);
            CHECK(state.decided >= passed);
            passed = state.decided;
            return passed <= 10'000;
        });
        REQUIRE_FALSE(cancelled);
        CHECK(cancelled.error().status == Status::cancelled);
        CHECK(passed > 10'000);
        CHECK(points_of(expect(runner.sample_and_wait(mesh, params))) ==
              points_of(sample(mesh, params)));
    }

    TEST_CASE("darts come one stage at a time, whatever the plan asks for") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 3));
        const SampleParams params = darts_for(mesh, 200, 3'000);
        BoxParams square{{1, 1}};
        square.min_distance = 0.08;
        square.darts = 2'000;
        const Domain box = expect(Domain::box(square));
        Context& context = shared_context();
        Runner usual = expect(Runner::create(context.device(), context.queue()));
        const auto points = expect(usual.sample_and_wait(box)).points;
        for (const std::uint32_t stages : {1u, 2u, 6u}) {
            CAPTURE(stages);
            CHECK(points_of(sample(mesh, params, by_stages(stages))) ==
                  points_of(sample(mesh, params)));
            Runner runner =
                expect(Runner::create(context.device(), context.queue(), by_stages(stages)));
            CHECK(expect(runner.sample_and_wait(box)).points == points);
        }
        const Sampler& sampler = usual.sampler();
        RunPlan plan = expect(sampler.plan_run(box, std::uint64_t{64} << 20));
        plan.stages = 2;
        const auto refused = sampler.workspace_needs(box, plan);
        REQUIRE_FALSE(refused);
        CHECK(refused.error().status == Status::invalid_argument);
        CHECK(refused.error().message.find("one stage at a time") != std::string::npos);
    }

    TEST_CASE("distances for counts give as many samples on average") {
        constexpr double kCount = 1'500;
        double samples = 0, runs = 0;
        for (const char* const shape : {"icosphere", "cube", "torus-knot"}) {
            const PreparedMesh mesh = prepared(builtin(shape, 4));
            for (const std::uint64_t seed : {1u, 2u, 3u}) {
                SampleParams params;
                params.min_distance = distance_for_count(mesh, {}, kCount);
                params.seed = seed;
                samples += static_cast<double>(sample(mesh, params).samples.size());
                ++runs;
            }
        }
        CHECK(samples / runs == doctest::Approx(kCount).epsilon(0.01));
    }

    TEST_CASE("pools larger than a binding are drawn stage by stage") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 2));
        const Sampler sampler = expect(Sampler::create(shared_context().device()));
        const std::uint64_t binding = sampler.report().limits.max_storage_buffer_range;
        if (binding / 8 >= kMaxCandidates / 2) {
            return; // A GPU that binds all.
        }
        const SampleParams params =
            params_for(mesh, 1.5 * static_cast<double>(binding) / (8 * kDefaultPoolRatio));
        const Domain domain = expect(Domain::surface(mesh, params));
        const RunPlan plan = expect(sampler.plan_run(domain, std::uint64_t{64} << 20));
        CHECK(plan.stages == 2);
        const auto needs = expect(sampler.workspace_needs(domain, plan));
        CHECK(needs.bytes[static_cast<std::size_t>(BufferRole::weights)] <= binding);
    }
}

} // namespace geodisk::test
