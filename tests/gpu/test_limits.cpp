// Loop limits, overflow, impossible requests: what must end in a correct result or a clear error.
#include <doctest/doctest.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>

#include "constants.h"
#include "device_run.hpp"
#include "kernels/detect.hpp"
#include "lib/frame.hpp"
#include "sets.hpp"
#include "support/meshes.hpp"
#include "support/replay.hpp"

namespace geodisk::test {

TEST_SUITE("limits") {
    // Disks of some 5,000 trips each, every one of many iterations: more than the 65,535 after
    // which lavapipe silently ends all loops of a SIMD group.
    TEST_CASE("disks far beyond 65,535 loop iterations per SIMD group") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 6));
        const SampleParams params = params_for(mesh, 60);
        const SampleSet set = sample(mesh, params);
        CHECK(set.report.windows / set.report.disks > 65535 / 16);
        CHECK(points_of(set) == float_set(mesh, params, set.report.plan.error_bound));
    }

    TEST_CASE("crowds of candidates in every cell") {
        const PreparedMesh mesh = prepared(builtin("cube", 1));
        SampleParams params = params_for(mesh, 60);
        params.pool_ratio = 2000;
        const SampleSet set = sample(mesh, params);
        CHECK(set.report.tested / set.report.disks > 1000);
        CHECK(points_of(set) == float_set(mesh, params, set.report.plan.error_bound));
    }

    TEST_CASE("a batch that the buffer of samples has no room for waits for a larger one") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 3));
        const SampleParams params = params_for(mesh, 100);
        RunPlan small;
        small.slots = 8;
        small.sample_capacity = 20;
        DeviceRun run(mesh, params, small);
        run.begin();
        std::uint32_t enlarged = 0;
        for (gpu::ControlRec control = run.control(); control.done == 0; control = run.control()) {
            if (control.overflow != 0) {
                CHECK(control.overflow == gpu::kOverflowSamples);
                CHECK(control.accepted + 8 > run.plan().sample_capacity);
                CHECK(control.accepted <= run.plan().sample_capacity);
                run.rounds(2);
                CHECK(run.control().accepted == control.accepted);
                run.enlarge_samples(control.accepted + 20);
                run.rewind();
                ++enlarged;
            }
            run.rounds(1);
        }
        CHECK(enlarged > 3);
        run.finish();
        const gpu::ControlRec control = run.control();
        RunnerOptions options;
        options.plan = small;
        const SampleSet set = sample(mesh, params, options);
        REQUIRE(set.samples.size() == control.ready);
        Points records;
        for (const auto& record : run.read<gpu::SampleRec>(BufferRole::samples, control.ready)) {
            records.push_back({record.face, record.weight1, record.weight2});
        }
        CHECK(records == points_of(set));
        CHECK(points_of(set) == float_set(mesh, params, set.report.plan.error_bound));
    }

    TEST_CASE("a finish between any rounds leaves a prefix, and the run as it was") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 12));
        const SampleParams params = params_for(mesh, 200);
        RunPlan small;
        small.slots = 40;
        small.lanes = 8;
        small.step_budget = 2;
        small.detect_passes = 1;
        small.window_capacity = 8; // And overflows.
        small.stages = 2;
        DeviceRun run(mesh, params, small);
        const Points want = float_set(mesh, params, run.plan().error_bound);
        std::uint32_t ready = 0, within_batches = 0;
        for (const std::uint32_t first : {0u, 2u}) {
            run.set_stages(first, 2);
            run.begin();
            while (run.control().done == 0) {
                run.rounds(1);
                if (run.control().overflow != 0) {
                    run.grow();
                }
                run.finish();
                const gpu::ControlRec control = run.control();
                within_batches += control.undecided > 0 ? 1 : 0;
                CHECK(control.ready >= ready);
                ready = control.ready;
                const auto samples = run.read<gpu::SampleRec>(BufferRole::samples, ready);
                std::uint32_t wrong = 0;
                for (std::size_t i = 0; i < ready; ++i) {
                    wrong += want[i] !=
                             SamplePoint{samples[i].face, samples[i].weight1, samples[i].weight2};
                }
                CHECK(wrong == 0);
            }
        }
        CHECK(ready == want.size());
        CHECK(within_batches > 0);
    }

    TEST_CASE("long chains widen limit and margin, and no run is repeated") {
        for (const TestMesh& shape : {needle_disk(1'200), needle_strip(2'000, 10)}) {
            const PreparedMesh mesh = prepared(shape);
            for (const double count : {20.0, 30.0}) {
                const SampleParams params = params_for(mesh, count);
                const SampleSet set = sample(mesh, params);
                const ref::Frame frame = ref::frame_of(mesh, params);
                CHECK(set.report.starts == 1);
                CHECK(frame.error_of(set.report.longest_chain) > frame.first_error());
                const double error =
                    frame.error_of(set.report.longest_chain, set.report.plan.trims);
                CHECK(set.report.guard == std::max(frame.tolerances().guard, error));
                CHECK(points_of(set) == float_set(mesh, params, frame.first_error()));
                RunnerOptions by_groups;
                by_groups.plan.disks_by = DisksBy::groups;
                CHECK(points_of(sample(mesh, params, by_groups)) == points_of(set));
                const ReplayReport judged = replay(mesh, params, frame.first_error());
                CHECK(judged.wrong == 0);
                check_deviation("needles", judged);
            }
        }
    }

    TEST_CASE("sheets of needles upon each other are sampled") {
        const PreparedMesh mesh = prepared(needle_sheets());
        SampleParams params;
        params.min_distance = 3 * mesh.statistics().diagonal;
        const SampleSet set = sample(mesh, params);
        CHECK(set.report.plan.trims);
        CHECK(points_of(set) == float_set(mesh, params, set.report.plan.error_bound));
    }

    TEST_CASE("a disk that does not end is an error") {
        const PreparedMesh mesh = prepared(all_triangles(24));
        SampleParams params;
        params.min_distance = 2;
        Context& context = shared_context();
        Runner runner = expect(Runner::create(context.device(), context.queue()));
        const auto set = runner.sample_and_wait(mesh, params);
        REQUIRE_FALSE(set);
        CHECK(set.error().status == Status::mesh_rejected);
        CHECK(set.error().element < mesh.face_count());
        const std::string face = "face " + std::to_string(set.error().element) + " ";
        CHECK(set.error().message.find(face + "could not be computed") != std::string::npos);
        CHECK(runner.sample_and_wait(prepared(builtin("cube", 1)), params_for(mesh, 3)));
    }

    TEST_CASE("a disk that does not end is an error only if it is a sample's, whatever is active" *
              doctest::test_suite("slow")) {
        const PreparedMesh mesh = prepared(all_triangles(22));
        std::set<bool> outcomes;
        for (std::uint64_t seed = 1; outcomes.size() < 2; ++seed) {
            CAPTURE(seed);
            REQUIRE(seed < 40);
            SampleParams params;
            params.min_distance = 0.85;
            params.seed = seed;
            std::optional<Points> want;
            try {
                want = float_set(mesh, params, ref::frame_of(mesh, params).first_error());
            } catch (const ref::EndlessDisk&) {
            }
            if (!outcomes.insert(want.has_value()).second) {
                continue;
            }
            std::set<std::uint64_t> faces;
            for (const std::uint32_t slots : {8u, 512u}) {
                CAPTURE(slots);
                RunnerOptions options;
                options.plan.slots = slots;
                Context& context = shared_context();
                Runner runner = expect(Runner::create(context.device(), context.queue(), options));
                const auto set = runner.sample_and_wait(mesh, params);
                REQUIRE(static_cast<bool>(set) == want.has_value());
                if (set) {
                    CHECK(points_of(*set) == *want);
                } else {
                    CHECK(set.error().status == Status::mesh_rejected);
                    faces.insert(set.error().element);
                }
            }
            CHECK(faces.size() == (want ? 0 : 1));
        }
    }

    TEST_CASE("sheets of needles whose disks did not end are sampled") {
        const PreparedMesh mesh = prepared(shared_mesh("cases/endless_by_batches.obj").value());
        SampleParams params;
        params.min_distance = 0.21213203435597458;
        const SampleSet set = sample(mesh, params);
        CHECK(points_of(set) == float_set(mesh, params, set.report.plan.error_bound));
        CHECK(points_of(set) == double_set(mesh, params, set.report.plan.error_bound));
    }

    TEST_CASE("layers of needles that share long edges are sampled") {
        const PreparedMesh mesh = prepared(shared_mesh("cases/layers_18.obj").value());
        // The long edges have 7 to 18 times the distance, so positions on them round to more.
        for (const double distance : {4.55, 3.0, 1.7}) {
            SampleParams params;
            params.min_distance = distance;
            const SampleSet set = sample(mesh, params);
            CHECK(set.report.plan.trims);
            CHECK(points_of(set) == float_set(mesh, params, set.report.plan.error_bound));
            CHECK(points_of(set) == double_set(mesh, params, set.report.plan.error_bound));
        }
    }

    TEST_CASE("flat faces on top of each other around a vertex are sampled with any seed") {
        const PreparedMesh mesh = prepared(shared_mesh("cases/layers_flat.obj").value());
        for (std::uint64_t seed = 0; seed < 6; ++seed) {
            CAPTURE(seed);
            SampleParams params;
            params.min_distance = 90;
            params.seed = seed;
            const SampleSet set = sample(mesh, params);
            CHECK(points_of(set) == float_set(mesh, params, set.report.plan.error_bound));
            CHECK(points_of(set) == double_set(mesh, params, set.report.plan.error_bound));
        }
    }

    TEST_CASE("disks that begin to trim late, among many vertices, end") {
        const PreparedMesh mesh = prepared(tetrahedra_beyond_sheet(3, 0.15, 40));
        SampleParams params;
        params.min_distance = 60;
        const SampleSet set = sample(mesh, params);
        CHECK(set.report.plan.trims);
        CHECK(set.report.max_vertices > 1000);
        CHECK(points_of(set) == float_set(mesh, params, set.report.plan.error_bound));
    }

    TEST_CASE("an overflow decides nothing until slices are larger") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 4));
        const SampleParams params = params_for(mesh, 100);
        RunPlan small;
        small.window_capacity = 4;
        small.slots = 16;
        DeviceRun run(mesh, params, small);
        run.begin();
        run.rounds(3);
        CHECK(run.control().overflow == gpu::kOverflowWindows);
        CHECK(run.control().accepted == 0);
        CHECK(run.control().undecided == run.control().slots_used);
    }

    TEST_CASE("a pool smaller than all lists takes fewer slots and returns the same set") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 4));
        SampleParams params = params_for(mesh, 600);
        params.pool_ratio = 200;
        const SampleSet plenty = sample(mesh, params);
        RunnerOptions options;
        options.pool_bytes = 96 << 10;
        const SampleSet tight = sample(mesh, params, options);
        CHECK(tight.report.plan.slots < plenty.report.plan.slots);
        CHECK(tight.report.plan.pool_bytes() <= options.pool_bytes);
        CHECK(points_of(tight) == points_of(plenty));
    }

    TEST_CASE("a plan asked for must keep to the pool") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 3));
        RunnerOptions options;
        options.plan.lanes = 4096;
        options.pool_bytes = 1 << 20;
        Runner runner =
            expect(Runner::create(shared_context().device(), shared_context().queue(), options));
        const auto result = runner.sample_and_wait(mesh, params_for(mesh, 100));
        REQUIRE_FALSE(result);
        CHECK(result.error().status == Status::workspace_too_small);
    }

    TEST_CASE("a pool too small for one disk is an error naming the bytes") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 5));
        SampleParams params = params_for(mesh, 4);
        RunnerOptions options;
        options.pool_bytes = 16384;
        Context& context = shared_context();
        Runner runner = expect(Runner::create(context.device(), context.queue(), options));
        const auto result = runner.sample_and_wait(mesh, params);
        REQUIRE_FALSE(result);
        CHECK(result.error().status == Status::workspace_too_small);
        CHECK(result.error().message.find("bytes") != std::string::npos);
    }

    TEST_CASE("distances that no pool can serve are refused before any work") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 2));
        Context& context = shared_context();
        Runner runner = expect(Runner::create(context.device(), context.queue()));
        const double zero = 0;
        for (const double distance : {0.0, -1.0, 0.0 / zero, 1.0 / zero, 1e-9, 1e-300}) {
            CAPTURE(distance);
            SampleParams params;
            params.min_distance = distance;
            const auto result = runner.sample_and_wait(mesh, params);
            REQUIRE_FALSE(result);
            CHECK(result.error().status == Status::invalid_argument);
        }
        SampleParams params = params_for(mesh, 400'000'000);
        const auto result = runner.sample_and_wait(mesh, params);
        REQUIRE_FALSE(result);
        CHECK(result.error().status == Status::invalid_argument);
        CHECK(result.error().message.find("candidates") != std::string::npos);
    }

    TEST_CASE("a run can be cancelled") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 4));
        Context& context = shared_context();
        Runner runner = expect(Runner::create(context.device(), context.queue()));
        const auto result = runner.sample_and_wait(mesh, params_for(mesh, 5000),
                                                   [](const Progress&) { return false; });
        REQUIRE_FALSE(result);
        CHECK(result.error().status == Status::cancelled);
    }
}

} // namespace geodisk::test
