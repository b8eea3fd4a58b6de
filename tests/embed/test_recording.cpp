// An engine that records geodisk's work among its own, in memory that it cuts out of one buffer.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <geodisk/context.hpp>
#include <geodisk/runner.hpp>

#include "engine/domain/box_grid.hpp"
#include "engine/domain/stages.hpp"
#include "engine_job.hpp"
#include "gpu/device_run.hpp"
#include "kernels/grid.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {
namespace {

/// Finishes after every round, from the first to the last of all stages. What is ready must stay,
/// and grow in more than one step; returns all in the end.
std::vector<gpu::SampleRec> finish_often(DeviceRun& run, std::uint32_t stages) {
    std::vector<gpu::SampleRec> ready;
    std::uint32_t steps = 0;
    std::uint32_t changed = 0;
    const auto finish = [&] {
        run.finish();
        const auto now = run.read<gpu::SampleRec>(BufferRole::samples, run.control().ready);
        REQUIRE(now.size() >= ready.size());
        changed += !ready.empty() &&
                   std::memcmp(now.data(), ready.data(), ready.size() * sizeof ready[0]) != 0;
        steps += now.size() > ready.size();
        ready = now;
    };
    for (std::uint32_t first = 0; first < stages; first += run.plan().stages) {
        run.set_stages(first, std::min(run.plan().stages, stages - first));
        run.begin();
        finish();
        for (std::uint32_t round = 0; run.control().done == 0; ++round) {
            REQUIRE(round < 100'000);
            run.rounds(1);
            finish();
            if (run.control().overflow != 0) {
                run.grow();
                finish();
            }
        }
    }
    CHECK(changed == 0);
    CHECK(steps > 1);
    CHECK(ready.size() == run.control().accepted);
    return ready;
}

void check_finishes(const RunPlan& plan, bool is_tight = false) {
    const PreparedMesh mesh = prepared(builtin("torus-knot", 12));
    CHECK(mesh.face_count() == 2880);
    const SampleParams params = params_for(mesh, 60);
    DeviceRun run(mesh, params, plan);
    if (is_tight) {
        run.set_plan(tightened(run.plan()));
    }
    Points points;
    for (const gpu::SampleRec& s : finish_often(run, stages_of(mesh, params).pool_stages())) {
        points.push_back({s.face, s.weight1, s.weight2});
    }
    CHECK(points == float_set(mesh, params, run.plan().error_bound));
    CHECK((!is_tight || run.plan().window_capacity > 2));
}

/// Returns how often `part` is recorded until it says that it was the last.
template <class Part>
std::uint32_t parts_of(const Part& part) {
    std::uint32_t parts = 1;
    while (!part()) {
        ++parts;
    }
    return parts;
}

void check_finishes_in_box(const RunPlan& plan, bool is_tight = false) {
    BoxParams box{{1, 1, 1}, true};
    box.min_distance = distance_for_count(box, 60);
    DeviceRun run(box, plan);
    if (is_tight) {
        run.set_plan(tightened(run.plan()));
    }
    std::vector<std::array<double, 3>> points;
    for (const gpu::SampleRec& s : finish_often(run, ref::stages_in(box).pool_stages())) {
        sample_point(box.seed, draw_axes(box), s, points.emplace_back());
    }
    const ref::BoxPool<float> pool(box);
    const ref::BoxLattice lattice(box);
    std::vector<std::array<double, 3>> wanted;
    for (const std::uint32_t rank : ref::throw_darts(pool)) {
        for (std::size_t i = 0; auto& x : wanted.emplace_back()) {
            x = lattice.coordinate(i++, pool.points[pool.places[rank]]);
        }
    }
    CHECK(points == wanted);
    CHECK((!is_tight || run.plan().list_capacity > 4));
}

} // namespace

TEST_SUITE("recording") {
    TEST_CASE("an engine samples a few rounds a frame, in ranges of its own buffer") {
        const Context context = validated_context();
        {
            const Sampler sampler = expect(Sampler::create(context.device()));
            const Task knot = task(sampler, "torus-knot", 8, 200);
            const Task cube = task(sampler, "cube", 1, 300);
            Workshop workshop(context);
            EngineJob(workshop, sampler, knot).run();
            CHECK(workshop.damage() == 0);
            // The same memory again, cut differently.
            workshop.start_over();
            EngineJob(workshop, sampler, cube).run();
            CHECK(workshop.damage() == 0);
        }
        check_silent(context);
    }

    TEST_CASE("two frames in flight: what the device reports comes late") {
        const Context context = validated_context();
        {
            const Sampler sampler = expect(Sampler::create(context.device()));
            const Task knot = task(sampler, "torus-knot", 8, 200);
            Workshop workshop(context);
            for (const std::size_t lag : {1u, 2u, 5u}) {
                workshop.start_over();
                EngineJob job(workshop, sampler, knot, 1);
                const RunPlan tight = tightened(job.plan());
                expect(job.job().set_plan(tight));
                job.run(lag);
                CHECK(job.job().plan().window_capacity > tight.window_capacity);
                CHECK(workshop.damage() == 0);
            }
        }
        check_silent(context);
    }

    TEST_CASE("chunk by chunk, in a workspace for one of them") {
        const Context context = validated_context();
        {
            const Sampler sampler = expect(Sampler::create(context.device()));
            const Task knot = task(sampler, "torus-knot", 8, 200);
            Workshop workshop(context);
            EngineJob job(workshop, sampler, knot, 1);
            // Room for some more candidates than one of the four stages expects.
            const Stages stages = stages_of(knot.mesh, knot.params);
            REQUIRE(stages.pool_stages() == 4);
            const auto bytes = static_cast<double>(
                job.workspace()[static_cast<std::size_t>(BufferRole::weights)].size);
            CHECK(bytes >= 8 * stages.expected(0));
            CHECK(bytes < 2 * 8 * stages.expected(0));
            job.run();
            CHECK(workshop.damage() == 0);
        }
        check_silent(context);
    }

    TEST_CASE("a whole job in one command buffer, and another in the same workspace") {
        const Context context = validated_context();
        {
            const Sampler sampler = expect(Sampler::create(context.device()));
            const Task knot = task(sampler, "torus-knot", 8, 60);
            Workshop workshop(context);
            EngineJob first(workshop, sampler, knot);
            workshop.frame(0, [&](VkCommandBuffer commands) {
                for (int job = 0; job < 2; ++job) {
                    first.record_first(commands);
                    first.record_rounds(commands, 40);
                    first.record_last(commands);
                }
                first.record_read(commands, BufferRole::control, sizeof(gpu::ControlRec));
            });
            const gpu::ControlRec control = first.control();
            REQUIRE(control.done == 1);
            workshop.frame(1, [&](VkCommandBuffer commands) { first.record_last(commands); });
            first.check_samples(control.accepted);
            CHECK(workshop.damage() == 0);
        }
        check_silent(context);
    }

    TEST_CASE("one sampler records surfaces, radii that vary, boxes and distances through space") {
        const Context context = validated_context();
        {
            const Sampler sampler = expect(Sampler::create(context.device()));
            Workshop workshop(context);
            const TestMesh shape = builtin("torus-knot", 8);
            const PreparedMesh mesh = prepared(shape);
            const SampleParams params = params_for(mesh, 200);
            const RadiusField radii = radius_field(mesh, wavy_factors(shape, 0.5));
            Runner runner = expect(Runner::create(context.device(), context.queue()));
            const auto check = [&](Domain domain) {
                const SampleSet want = expect(runner.sample_and_wait(domain));
                workshop.start_over();
                const std::uint32_t n = domain.dimension();
                EngineJob job(workshop, sampler, std::move(domain));
                const auto samples = job.samples(job.run_frames());
                Points points;
                std::vector<double> coordinates(samples.size() * n);
                for (std::size_t i = 0; i < samples.size(); ++i) {
                    points.push_back({samples[i].face, samples[i].weight1, samples[i].weight2});
                    job.domain().coordinates(samples[i], std::span(coordinates).subspan(i * n, n));
                }
                CHECK(coordinates == want.points);
                CHECK((n > 0 || points == points_of(want)));
                CHECK(samples.size() > 20);
                CHECK(workshop.damage() == 0);
            };
            check(expect(Domain::surface(mesh, params)));
            check(expect(Domain::surface(mesh, params_for(mesh, 100, 1, &radii))));
            BoxParams box{{1, 1, 1}, true};
            box.min_distance = distance_for_count(box, 60);
            check(expect(Domain::box(box)));
            box.extents = {1, 2};
            box.is_periodic = false;
            check(expect(Domain::box(box)));
            for (const Metric metric : {Metric::euclidean, Metric::approximate}) {
                check(expect(Domain::surface_in_space(shape.view(), mesh, params, metric)));
            }
            check(expect(Domain::surface(mesh, params))); // The kernels of before.
        }
        check_silent(context);
    }

    TEST_CASE("a mesh that was not uploaded is an error, not a set of no samples") {
        const Context context = validated_context();
        {
            const Sampler sampler = expect(Sampler::create(context.device()));
            const Task knot = task(sampler, "torus-knot", 8, 200);
            Workshop workshop(context);
            EngineJob job(workshop, sampler, knot);
            workshop.frame(0, [&](VkCommandBuffer commands) {
                job.record_upload(commands, true);
                sampler.record_begin(commands, job.job());
                job.record_rounds(commands, 4);
            });
            const auto advice = job.job().advance(job.control());
            REQUIRE_FALSE(advice);
            CHECK(advice.error().status == Status::invalid_argument);
            CHECK(advice.error().message.find("write_upload") != std::string::npos);
        }
        check_silent(context);
    }

    TEST_CASE("all ranges laid out in one buffer") {
        const Context context = expect(Context::create());
        const Sampler sampler = expect(Sampler::create(context.device()));
        const Task knot = task(sampler, "torus-knot", 8, 200);
        const Domain domain = knot.domain();
        const RunPlan plan = expect(sampler.plan_run(domain, Workshop::kPoolBytes));
        const WorkspaceNeeds needs = expect(sampler.workspace_needs(domain, plan));
        const WorkspaceLayout layout = sampler.lay_out(needs);
        CHECK(layout.bytes >= needs.total());
        CHECK(layout.bytes <= needs.total() + kBufferRoles * layout.alignment);
        Workshop workshop(context);
        const VkBuffer buffer = workshop.cut(needs)[0].buffer;
        const Workspace workspace = layout.in(buffer, 4 * layout.alignment);
        for (std::size_t i = 0; i < kBufferRoles; ++i) {
            CHECK(workspace[i].size == needs.bytes[i]);
            CHECK(workspace[i].buffer == (needs.bytes[i] > 0 ? buffer : VK_NULL_HANDLE));
        }
        CHECK(sampler.make_job(domain, plan, workspace)); // Which checks them.
    }

    TEST_CASE("rounds after the last change nothing") {
        const Context context = expect(Context::create());
        const Sampler sampler = expect(Sampler::create(context.device()));
        const Task knot = task(sampler, "torus-knot", 8, 60);
        Workshop workshop(context);
        EngineJob job(workshop, sampler, knot);
        job.run();
        const std::vector<std::byte> before = workshop.contents();
        workshop.frame(0, [&](VkCommandBuffer commands) { job.record_rounds(commands, 20); });
        CHECK(workshop.contents() == before);
        CHECK(job.control().done == 1);
        CHECK(job.control().accepted == knot.wanted.size());
    }

    TEST_CASE("begins and finishes recorded a dispatch at a time, each bounded") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 12));
        const SampleParams params = params_for(mesh, 60);
        RunPlan plan;
        plan.dispatch_items = 500;
        plan.stages = 1;
        DeviceRun run(mesh, params, plan);
        const std::uint32_t stages = stages_of(mesh, params).pool_stages();
        REQUIRE(stages > 1);
        for (std::uint32_t stage = 0; stage < stages; ++stage) {
            run.set_stages(stage, 1);
            const std::uint64_t before = run.dispatches();
            const std::uint32_t parts = parts_of([&] { return run.begin(1); });
            CHECK(parts > 2880 / 500);
            CHECK(run.dispatches() - before == parts);
            for (std::uint32_t batch = 0; decide_batch(run); ++batch) {
                REQUIRE(batch < 100'000);
            }
            CHECK(parts_of([&] { return run.finish(1); }) > 60 / 500);
        }
        CHECK(ready_points(run) == float_set(mesh, params, run.plan().error_bound));
    }

    TEST_CASE("what a begin or a finish has left is recorded before all else") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 12));
        const SampleParams params = params_for(mesh, 60);
        RunPlan plan;
        plan.dispatch_items = 500;
        plan.slots = kMinSlots;
        DeviceRun run(mesh, params, plan);
        for (const std::uint32_t dispatches : {0u, 1u, 2u, 5u, 11u}) {
            CAPTURE(dispatches);
            run.set_stages(0, stages_of(mesh, params).pool_stages());
            run.begin(dispatches);
            if (dispatches == 0) {
                run.begin();
            } else if (dispatches == 1) {
                run.finish();
            } else if (dispatches == 2) {
                run.rewind();
            }
            for (std::uint32_t round = 0; run.control().done == 0; ++round) {
                REQUIRE(round < 10'000);
                run.finish(dispatches);
                run.rounds(1);
            }
            parts_of([&] { return run.finish(3); });
            CHECK(ready_points(run) == float_set(mesh, params, run.plan().error_bound));
        }
    }

    TEST_CASE("finishing early changes nothing, and what is ready stays") {
        RunPlan plan;
        check_finishes(plan);
        check_finishes_in_box(plan);
        plan.slots = kMinSlots;
        check_finishes(plan);
        check_finishes_in_box(plan);
        plan.stages = 1;
        check_finishes(plan);
        check_finishes_in_box(plan);
    }

    TEST_CASE("finishing early between the dispatches of a batch") {
        RunPlan plan;
        plan.detect_passes = 1;
        plan.step_budget = 1;
        check_finishes(plan);
        check_finishes_in_box(plan);
        plan.stages = 1;
        check_finishes(plan);
        check_finishes_in_box(plan);
    }

    TEST_CASE("finishing early where slices and lists overflow") {
        RunPlan plan;
        check_finishes(plan, true);
        check_finishes_in_box(plan, true);
        plan.stages = 1;
        check_finishes(plan, true);
        check_finishes_in_box(plan, true);
    }

    TEST_CASE("slices that overflow grow within the engine's pool") {
        const Context context = validated_context();
        {
            const Sampler sampler = expect(Sampler::create(context.device()));
            const Task knot = task(sampler, "torus-knot", 8, 100);
            Workshop workshop(context);
            EngineJob job(workshop, sampler, knot);
            const RunPlan tight = tightened(job.plan());
            expect(job.job().set_plan(tight));
            job.run();
            CHECK(job.job().plan().window_capacity > tight.window_capacity);
            CHECK(workshop.damage() == 0);
        }
        check_silent(context);
    }

    TEST_CASE("two threads record two jobs with one sampler") {
        const Context context = validated_context();
        {
            const Sampler sampler = expect(Sampler::create(context.device()));
            const std::array tasks{task(sampler, "torus-knot", 8, 200),
                                   task(sampler, "icosphere", 3, 80)};
            std::array<std::optional<Workshop>, 2> workshops;
            std::array<std::string, 2> failures;
            {
                std::vector<std::jthread> threads;
                for (std::size_t t = 0; t < tasks.size(); ++t) {
                    threads.emplace_back([&, t] {
                        try {
                            workshops[t].emplace(context);
                            EngineJob(*workshops[t], sampler, tasks[t]).run();
                        } catch (const std::exception& error) {
                            failures[t] = error.what();
                        }
                    });
                }
            }
            CHECK(failures == std::array<std::string, 2>{});
            for (auto& workshop : workshops) {
                CHECK(workshop->damage() == 0);
            }
        }
        check_silent(context);
    }

    TEST_CASE("a missing barrier does not go unnoticed") {
        const Context context = validated_context();
        {
            const Sampler sampler = expect(Sampler::create(context.device()));
            const Task knot = task(sampler, "torus-knot", 8, 60);
            Workshop workshop(context);
            EngineJob job(workshop, sampler, knot);
            workshop.frame(0, [&](VkCommandBuffer commands) {
                job.record_first(commands);
                workshop.record_download(commands, job.workspace()[4], 16);
            });
        }
        bool hazard = false;
        for (const std::string& message : expect(context.validation_messages())) {
            hazard = hazard || message.find("SYNC-HAZARD") != std::string::npos;
        }
        CHECK(hazard);
    }
}

} // namespace geodisk::test
