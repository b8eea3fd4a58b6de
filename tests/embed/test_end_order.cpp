// Jobs that stop at orders and go on, that count their darts, and whose rounds are recorded in
// parts.
#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include <geodisk/runner.hpp>

#include "constants.h"
#include "engine/job/order_cut.hpp"
#include "engine_job.hpp"
#include "gpu/device_run.hpp"
#include "gpu/sets.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {
namespace {

constexpr std::uint64_t kStage = std::uint64_t{1} << gpu::kPriorityBits;

std::vector<gpu::SampleRec> samples_at_end(const DeviceRun& run) {
    return run.read<gpu::SampleRec>(BufferRole::samples, run.control().ready);
}

bool is_prefix(const std::vector<gpu::SampleRec>& part, const std::vector<gpu::SampleRec>& all) {
    return part.size() <= all.size() &&
           std::ranges::equal(std::as_bytes(std::span(part)),
                              std::as_bytes(std::span(all).first(part.size())));
}

/// Stops at each of the orders; returns the samples in the end.
std::vector<gpu::SampleRec> stop_at(DeviceRun& run, const std::vector<std::uint64_t>& orders) {
    std::vector<gpu::SampleRec> before;
    std::uint64_t highest = 0;
    for (const std::uint64_t order : orders) {
        CAPTURE(order);
        highest = std::max(highest, order);
        run.job().set_end_order(order);
        const Advice paused = run.follow_all();
        REQUIRE(paused.next == Next::paused);
        CHECK(expect(run.job().advance(run.control())).next == Next::paused);
        const auto now = run.read<gpu::SampleRec>(BufferRole::samples, paused.ready);
        CHECK(is_prefix(before, now));
        const std::uint64_t first = std::uint64_t{run.push().first_stage} * kStage;
        const std::uint32_t settled = run.control().settled;
        for (std::size_t i = settled; i < now.size(); ++i) {
            CHECK(first + now[i].order < highest);
        }
        before = now;
    }
    run.job().set_end_order(kAllOrders);
    const Advice last = run.follow_all();
    CHECK(last.next == Next::complete);
    const std::vector<gpu::SampleRec> all = samples_at_end(run);
    CHECK(is_prefix(before, all));
    return all;
}

void check_stops(DeviceRun& run) {
    REQUIRE(run.follow_all().next == Next::complete);
    const std::vector<gpu::SampleRec> whole = samples_at_end(run);
    REQUIRE(whole.size() > 10);
    const std::vector<std::vector<std::uint64_t>> sequences = {
        {0},
        {1, 1},
        {kStage / 64, kStage / 8, kStage / 2, kStage},
        {3 * kStage / 2, kStage / 3, 2 * kStage}, // A lower one changes nothing.
    };
    for (const auto& orders : sequences) {
        run.job().set_seed(1);
        const std::vector<gpu::SampleRec> again = stop_at(run, orders);
        CHECK(again.size() == whole.size());
        CHECK(is_prefix(again, whole));
    }
}

/// Changes the end order twice in each so many rounds, one after the other, until the job is
/// complete.
void check_changes(DeviceRun& run, std::size_t period) {
    const std::uint64_t orders[] = {kStage / 2, kStage / 4, 2 * kStage, 1,
                                    kStage,     5 * kStage, kAllOrders};
    std::uint32_t paused = 0;
    for (std::size_t i = 0, changes = 0;; ++i) {
        REQUIRE(i < 10'000);
        if (i % period <= 1) {
            run.job().set_end_order(orders[changes++ % std::size(orders)]);
        }
        const Advice advice = expect(run.job().advance(run.control()));
        if (advice.next == Next::complete) {
            break;
        }
        paused += advice.next == Next::paused ? 1 : 0;
        run.follow(advice);
    }
    CHECK(paused > 0);
}

RunPlan small_plan(std::uint32_t slots, std::uint32_t stages) {
    RunPlan plan;
    plan.slots = slots;
    plan.stages = stages;
    return plan;
}

} // namespace

TEST_SUITE("end order") {
    TEST_CASE(
        "the end of an exact number of candidates is found by counting, however they are spread") {
        std::vector<std::uint32_t> even, dense, alike(50, 7'000);
        for (std::uint32_t i = 0; i < 1'000; ++i) {
            even.push_back(i * 250'000 + i % 7);
            dense.push_back(i < 999 ? (1u << 28) - 2'000 + i : 3);
        }
        alike.push_back(7'001);
        for (std::vector<std::uint32_t>& orders :
             {std::ref(even), std::ref(dense), std::ref(alike)}) {
            std::sort(orders.begin(), orders.end());
            const auto drawn = static_cast<std::uint32_t>(orders.size());
            for (const std::uint32_t wanted : {1u, 2u, 49u, drawn / 2, drawn - 1}) {
                CAPTURE(wanted);
                OrderCut cut(1u << 28, drawn, wanted);
                std::uint32_t guesses = 0;
                const auto below = [&](std::uint32_t order) {
                    const auto end = std::lower_bound(orders.begin(), orders.end(), order);
                    return static_cast<std::uint32_t>(end - orders.begin());
                };
                for (; !cut.is_found(); ++guesses) {
                    REQUIRE(guesses < 64);
                    REQUIRE(cut.guess() > 0);
                    cut.note(below(cut.guess()));
                }
                CHECK(cut.count() == below(cut.end()));
                CHECK(cut.count() >= wanted);
                CHECK((cut.count() == wanted || orders[wanted - 1] == orders[wanted]));
            }
        }
    }

    TEST_CASE("any sequence of end orders gives one set") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 8));
        const SampleParams params = params_for(mesh, 100);
        for (const std::uint32_t stages : {1u, 3u, 4u}) {
            for (const std::uint32_t slots : {kMinSlots, 200u}) {
                CAPTURE(stages);
                CAPTURE(slots);
                DeviceRun run(mesh, params, small_plan(slots, stages));
                check_stops(run);
                CHECK(ready_points(run) == float_set(mesh, params, run.plan().error_bound));
            }
        }
        DeviceRun tight(mesh, params, small_plan(16, 2));
        tight.set_plan(tightened(tight.plan()));
        check_stops(tight);
        BoxParams box{{1, 1}, true};
        box.min_distance = distance_for_count(box, 100);
        box.seed = 1;
        DeviceRun in_box(box, small_plan(20, 2));
        check_stops(in_box);
    }

    TEST_CASE("an end order may change between any rounds") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 8));
        const SampleParams params = params_for(mesh, 100);
        DeviceRun run(mesh, params, small_plan(40, 2));
        check_changes(run, 2);
        CHECK(ready_points(run) == float_set(mesh, params, run.plan().error_bound));
    }

    TEST_CASE("an end order may change while a list of candidates is incomplete") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 8));
        const SampleParams params = params_for(mesh, 1'500);
        RunPlan plan = small_plan(200, 2);
        plan.dispatch_items = gpu::kSelectBlock;
        DeviceRun run(mesh, params, plan);
        check_changes(run, 20);
        // A list takes several rounds, so the second change comes while the list is made.
        CHECK(run.control().drawn > 3 * gpu::kSelectBlock);
        CHECK(ready_points(run) == float_set(mesh, params, run.plan().error_bound));
    }

    TEST_CASE("a run of darts and one that stops at a count pause and go on") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 8));
        SampleParams params = params_for(mesh, 100);
        params.darts = 3'000;
        DeviceRun darts(mesh, params, small_plan(40, 1));
        check_stops(darts);
        CHECK(ready_points(darts) == float_set(mesh, params, darts.plan().error_bound));
        params.stop_count = 60;
        DeviceRun stopped(mesh, params, small_plan(40, 1));
        stopped.job().set_end_order(kStage / 512);
        CHECK(stopped.follow_all().next == Next::paused);
        stopped.job().set_end_order(kAllOrders);
        CHECK(stopped.follow_all().next == Next::complete);
        CHECK(ready_points(stopped) == float_set(mesh, params, stopped.plan().error_bound));
    }

    TEST_CASE("a job throws an exact number of darts, and tells how many a count took") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 8));
        Runner runner = expect(Runner::create(shared_context().device(), shared_context().queue()));
        for (const std::uint32_t darts : {1u, 700u, 5'000u}) {
            CAPTURE(darts);
            SampleParams params = params_for(mesh, 100);
            params.darts = darts;
            DeviceRun run(mesh, params);
            const Advice last = run.follow_all();
            REQUIRE(last.next == Next::complete);
            CHECK(last.candidates == darts);
            CHECK(ready_points(run) == float_set(mesh, params, run.plan().error_bound));

            params.stop_count = 20;
            DeviceRun stopped(mesh, params);
            const Advice end = stopped.follow_all();
            const SampleSet set = expect(runner.sample_and_wait(mesh, params));
            CHECK(ready_points(stopped) == points_of(set));
            if (set.samples.size() == 20) {
                CHECK(end.candidates == 0);
                while (!stopped.count(1)) {
                    CHECK(expect(stopped.job().advance(stopped.control())).next == Next::count);
                }
            }
            const Advice counted = expect(stopped.job().advance(stopped.control()));
            CHECK(counted.next == Next::complete);
            CHECK(counted.candidates == set.report.candidates);
            CHECK(stopped.count()); // Nothing is left to count.
        }
    }

    TEST_CASE("an engine throws an exact number of darts, some frames behind") {
        const Context context = validated_context();
        {
            const Sampler sampler = expect(Sampler::create(context.device()));
            Task knot = task(sampler, "torus-knot", 8, 200);
            knot.params.darts = 4'000;
            const RunPlan plan = expect(sampler.plan_run(knot.domain(), Workshop::kPoolBytes));
            knot.wanted = float_set(knot.mesh, knot.params, plan.error_bound);
            Workshop workshop(context);
            for (const std::size_t lag : {0u, 2u}) {
                workshop.start_over();
                EngineJob(workshop, sampler, knot).run(lag);
                CHECK(workshop.damage() == 0);
            }
        }
        check_silent(context);
    }

    TEST_CASE("an engine records rounds in parts, with its own commands between them") {
        const Context context = validated_context();
        {
            const Sampler sampler = expect(Sampler::create(context.device()));
            const Task knot = task(sampler, "torus-knot", 8, 200);
            Workshop workshop(context);
            EngineJob job(workshop, sampler, knot);
            std::uint32_t seen = 0;
            workshop.frame(0, [&](VkCommandBuffer commands) {
                job.record_upload(commands);
                sampler.record_begin(commands, job.job());
            });
            for (std::uint32_t round = 0; round < 10'000; ++round) {
                workshop.frame(round, [&](VkCommandBuffer commands) {
                    sampler.record_select(commands, job.job());
                    // Reads what is in the slots, before their disks are known.
                    job.record_read(commands, BufferRole::control, sizeof(gpu::ControlRec));
                });
                seen += job.control().undecided;
                workshop.frame(round, [&](VkCommandBuffer commands) {
                    sampler.record_detect(commands, job.job());
                    job.record_read(commands, BufferRole::pool, 64);
                    sampler.record_resolve(commands, job.job());
                    job.record_read(commands, BufferRole::control, sizeof(gpu::ControlRec));
                });
                if (job.control().done != 0) {
                    break;
                }
            }
            const gpu::ControlRec control = job.control();
            REQUIRE(control.done == 1);
            CHECK(seen >= control.accepted);
            workshop.frame(0, [&](VkCommandBuffer commands) { job.record_last(commands); });
            job.check_samples(control.accepted);
            CHECK(workshop.damage() == 0);
        }
        check_silent(context);
    }
}

} // namespace geodisk::test
