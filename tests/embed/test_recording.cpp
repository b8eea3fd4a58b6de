// An engine that records geodisk's work among its own, in memory that it cuts out of one buffer.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include <geodisk/context.hpp>
#include <geodisk/runner.hpp>

#include "engine/box_grid.hpp"
#include "engine/stages.hpp"
#include "gpu/device_run.hpp"
#include "gpu/sets.hpp"
#include "kernels/grid.hpp"
#include "records.h"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"
#include "vk/barriers.hpp"
#include "workshop.hpp"

namespace geodisk::test {
namespace {

constexpr BufferRole kUploaded[] = {BufferRole::faces, BufferRole::fans, BufferRole::keys};

struct Task {
    PreparedMesh mesh;
    SampleParams params;
    Points wanted;

    Domain domain() const { return expect(Domain::surface(mesh, params)); }
};

Task task(const Sampler& sampler, const char* shape, int resolution, double count) {
    PreparedMesh mesh = prepared(builtin(shape, resolution));
    const SampleParams params = params_for(mesh, count);
    const Domain domain = expect(Domain::surface(mesh, params));
    const RunPlan plan = expect(sampler.plan_run(domain, Workshop::kPoolBytes));
    auto wanted = float_set(mesh, params, plan.error_bound);
    return {std::move(mesh), params, std::move(wanted)};
}

/// A key for each face, other than its index.
std::vector<std::uint32_t> all_keys(const PreparedMesh& mesh) {
    std::vector<std::uint32_t> keys(mesh.face_count());
    std::iota(keys.rbegin(), keys.rend(), 100u);
    return keys;
}

/// One job of the engine, a few rounds a frame.
class EngineJob {
  public:
    /// With all candidates at once, or those of so many stages.
    EngineJob(Workshop& workshop, const Sampler& sampler, const Task& task,
              std::uint32_t stages = 0)
        : EngineJob(workshop, sampler, task.domain(), stages) {
        wanted_ = task.wanted;
    }
    /// Of any domain.
    EngineJob(Workshop& workshop, const Sampler& sampler, Domain domain, std::uint32_t stages = 0)
        : workshop_(workshop), sampler_(sampler), domain_(std::move(domain)),
          plan_(expect(sampler.plan_run(domain_, Workshop::kPoolBytes))) {
        plan_.stages = stages != 0 ? stages : plan_.stages;
        const WorkspaceNeeds needs = expect(sampler.workspace_needs(domain_, plan_));
        workspace_ = workshop.cut(needs);
        job_.emplace(expect(sampler.make_job(domain_, plan_, workspace_)));
    }

    /// Uploads through staging and begins, in the frame's command buffer.
    void record_first(VkCommandBuffer commands) {
        std::size_t staged = 0;
        for (const BufferRole role : kUploaded) {
            const std::size_t size = sampler_.upload_size(domain_, role);
            if (size == 0) {
                continue;
            }
            expect(sampler_.write_upload(domain_, plan_, role,
                                         workshop_.upload_bytes().subspan(staged, size)));
            workshop_.record_upload(commands, range(role), staged, size);
            staged += size;
        }
        workshop_.barrier(commands, Workshop::kUploaded, Sampler::kFirstUse);
        sampler_.record_begin(commands, *job_);
    }

    void record_rounds(VkCommandBuffer commands, std::uint32_t rounds) {
        sampler_.record_rounds(commands, *job_, rounds);
        record_read(commands, BufferRole::control, sizeof(gpu::ControlRec));
    }

    void record_last(VkCommandBuffer commands) {
        sampler_.record_finish(commands, *job_);
        record_read(commands, BufferRole::samples, range(BufferRole::samples).size);
    }

    /// The engine's own copy to where the host can read.
    void record_read(VkCommandBuffer commands, BufferRole role, VkDeviceSize size) {
        workshop_.barrier(commands, Sampler::kLastUse, Workshop::kCopied);
        workshop_.record_download(commands, range(role), size);
        workshop_.barrier(commands, Workshop::kCopied, Sampler::kFirstUse);
    }

    gpu::ControlRec control() const {
        gpu::ControlRec control;
        std::memcpy(&control, workshop_.download_bytes().data(), sizeof control);
        return control;
    }

    /// With larger slices, as far as the pool allows.
    void record_regrown(VkCommandBuffer commands, std::uint32_t overflow) {
        expect(job_->set_plan(
            expect(sampler_.grow_plan(job_->plan(), overflow, range(BufferRole::pool).size))));
        sampler_.record_rewind(commands, *job_);
    }

    std::vector<gpu::SampleRec> samples(std::uint32_t accepted) const {
        std::vector<gpu::SampleRec> samples(accepted);
        std::memcpy(samples.data(), workshop_.download_bytes().data(),
                    accepted * sizeof samples[0]);
        return samples;
    }

    void check_samples(std::uint32_t accepted) const {
        Points points;
        for (const gpu::SampleRec& sample : samples(accepted)) {
            points.push_back({sample.face, sample.weight1, sample.weight2});
        }
        CHECK(points == wanted_);
    }

    /// Frames until the samples are there, as many as are returned.
    std::uint32_t run_frames() {
        const std::uint32_t stages = domain_.stages().pool_stages();
        gpu::ControlRec last{};
        for (std::uint32_t first = 0; first < stages; first += plan_.stages) {
            expect(job_->set_stages(first, std::min(plan_.stages, stages - first)));
            last = run_chunk(first == 0);
            workshop_.frame(0, [&](VkCommandBuffer commands) { record_last(commands); });
        }
        return last.accepted;
    }

    void run() { check_samples(run_frames()); }

    gpu::ControlRec run_chunk(bool is_first) {
        gpu::ControlRec last{};
        for (std::uint32_t frame = 0; last.done == 0; ++frame) {
            workshop_.frame(frame, [&](VkCommandBuffer commands) {
                if (frame == 0 && is_first) {
                    record_first(commands);
                } else if (frame == 0) {
                    sampler_.record_begin(commands, *job_);
                }
                if (last.overflow != 0) {
                    record_regrown(commands, last.overflow);
                }
                record_rounds(commands, 3);
            });
            last = control();
            if (last.abi != gpu::kAbi || frame == 10'000) {
                throw std::runtime_error("the rounds lead nowhere");
            }
        }
        return last;
    }

    Job& job() { return *job_; }
    const Domain& domain() const { return domain_; }
    const Workspace& workspace() const { return workspace_; }
    const RunPlan& plan() const { return plan_; }

  private:
    const BufferRange& range(BufferRole role) const {
        return workspace_[static_cast<std::size_t>(role)];
    }

    Workshop& workshop_;
    const Sampler& sampler_;
    Domain domain_;
    Points wanted_;
    RunPlan plan_;
    Workspace workspace_;
    std::optional<Job> job_;
};

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
        changed += std::memcmp(now.data(), ready.data(), ready.size() * sizeof ready[0]) != 0;
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
                run.grow(run.control().overflow);
                finish();
            }
        }
    }
    CHECK(changed == 0);
    CHECK(steps > 1);
    CHECK(ready.size() == run.control().accepted);
    return ready;
}

/// Slices and lists of a few entries, in a pool where they may grow.
void tighten(DeviceRun& run) {
    RunPlan tight = run.plan();
    tight.window_capacity = 2;
    tight.table_capacity = 4;
    tight.list_capacity = 4;
    run.set_plan(tight);
}

void check_finishes(const RunPlan& plan, bool is_tight = false) {
    const PreparedMesh mesh = prepared(builtin("torus-knot", 12));
    CHECK(mesh.face_count() == 2880);
    const SampleParams params = params_for(mesh, 60);
    DeviceRun run(mesh, params, plan);
    if (is_tight) {
        tighten(run);
    }
    Points points;
    for (const gpu::SampleRec& s : finish_often(run, stages_of(mesh, params).pool_stages())) {
        points.push_back({s.face, s.weight1, s.weight2});
    }
    CHECK(points == float_set(mesh, params, run.plan().error_bound));
    CHECK((!is_tight || run.plan().window_capacity > 2));
}

void check_finishes_in_box(const RunPlan& plan, bool is_tight = false) {
    BoxParams box{{1, 1, 1}, true};
    box.min_distance = distance_for_count(box, 60);
    DeviceRun run(box, plan);
    if (is_tight) {
        tighten(run);
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

Context validated_context() {
    ContextOptions options;
    options.validation = true;
    return expect(Context::create(options));
}

void check_silent(const Context& context) {
    CHECK(expect(context.validation_messages()) == std::vector<std::string>{});
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
                job.workspace()[static_cast<std::size_t>(BufferRole::states)].size);
            CHECK(bytes >= 4 * stages.expected(0));
            CHECK(bytes < 2 * 4 * stages.expected(0));
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

    TEST_CASE("finishing early changes nothing, and what is ready stays") {
        RunPlan plan;
        check_finishes(plan);
        check_finishes_in_box(plan);
        plan.slots = kLeastSlots;
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
            RunPlan tight = job.plan();
            tight.window_capacity = 2;
            tight.table_capacity = 4;
            tight.list_capacity = 4;
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

TEST_SUITE("workspaces") {
    /// The error that make_job gives for a workspace with one range replaced.
    Error refused(const Sampler& sampler, const Task& task, const RunPlan& plan,
                  const Workspace& workspace) {
        const Result<Job> job = sampler.make_job(task.domain(), plan, workspace);
        REQUIRE_FALSE(job);
        return job.error();
    }

    TEST_CASE("ranges that cannot work are refused by name") {
        const Context context = validated_context();
        {
            const Sampler sampler = expect(Sampler::create(context.device()));
            // One that needs all buffers.
            Task cube = task(sampler, "cube", 1, 300);
            const std::vector<std::uint32_t> keys = all_keys(cube.mesh);
            cube.params.face_keys = keys;
            Workshop workshop(context);
            const EngineJob good(workshop, sampler, cube);
            const WorkspaceNeeds needs =
                expect(sampler.workspace_needs(cube.domain(), good.plan()));
            const char* names[] = {"faces",   "fans",   "keys",    "cells",    "states",
                                   "weights", "orders", "starts",  "pool",     "control",
                                   "list",    "sums",   "samples", "accepted", "buckets"};
            for (std::size_t i = 0; i < kBufferRoles; ++i) {
                CAPTURE(names[i]);
                const auto check = [&](const BufferRange& range, Status status, const char* part) {
                    Workspace wrong = good.workspace();
                    wrong[i] = range;
                    const Error error = refused(sampler, cube, good.plan(), wrong);
                    CHECK(error.status == status);
                    CHECK(error.message.find(names[i]) != std::string::npos);
                    CHECK(error.message.find(part) != std::string::npos);
                };
                const BufferRange& range = good.workspace()[i];
                const std::string needed = std::to_string(needs.bytes[i]);
                check({VK_NULL_HANDLE, 0, range.size}, Status::invalid_argument, "null");
                check({range.buffer, range.offset, needs.bytes[i] - 1}, Status::workspace_too_small,
                      needed.c_str());
                check({range.buffer, range.offset + 4, range.size}, Status::invalid_argument,
                      "alignment");
                check({range.buffer, range.offset, VK_WHOLE_SIZE}, Status::invalid_argument,
                      "binds at most");
                check({range.buffer, good.workspace()[(i + 1) % kBufferRoles].offset, range.size},
                      Status::invalid_argument, "overlaps");
            }
        }
        check_silent(context);
    }

    TEST_CASE("buffers are named as the domain uses them") {
        const Context context = expect(Context::create());
        const Sampler sampler = expect(Sampler::create(context.device()));
        const TestMesh shape = builtin("cube", 1);
        const PreparedMesh mesh = prepared(shape);
        const auto check = [&](const Domain& domain, BufferRole role, const char* name) {
            const RunPlan plan = expect(sampler.plan_run(domain, Workshop::kPoolBytes));
            Workshop workshop(context);
            Workspace wrong = workshop.cut(expect(sampler.workspace_needs(domain, plan)));
            wrong[static_cast<std::size_t>(role)].buffer = VK_NULL_HANDLE;
            const Result<Job> job = sampler.make_job(domain, plan, wrong);
            REQUIRE_FALSE(job);
            CHECK(job.error().message ==
                  std::string("the workspace's buffer ") + name + " is null");
        };
        BoxParams box;
        box.min_distance = 0.1;
        check(expect(Domain::box(box)), BufferRole::axes, "axes");
        check(expect(Domain::box(box)), BufferRole::points, "points");
        const SampleParams params = params_for(mesh, 50);
        check(expect(Domain::surface_in_space(shape.view(), mesh, params, Metric::euclidean)),
              BufferRole::corners, "corners");
        check(expect(Domain::surface(mesh, params)), BufferRole::fans, "fans");
    }

    TEST_CASE("plans and pools that cannot work are refused") {
        const Context context = expect(Context::create());
        const Sampler sampler = expect(Sampler::create(context.device()));
        const Task knot = task(sampler, "torus-knot", 8, 60);
        Workshop workshop(context);
        EngineJob good(workshop, sampler, knot);
        const auto check = [&]<class Value>(Value RunPlan::*field,
                                            std::type_identity_t<Value> value) {
            CAPTURE(value);
            RunPlan plan = good.plan();
            plan.*field = value;
            const Error error = refused(sampler, knot, plan, good.workspace());
            CHECK(error.status == Status::invalid_argument);
            CHECK(error.message.find("plan") != std::string::npos);
            const Result<Done> set = good.job().set_plan(plan);
            REQUIRE_FALSE(set);
            CHECK(set.error().status == Status::invalid_argument);
        };
        check(&RunPlan::slots, 0);
        check(&RunPlan::slots, 1u << 25);
        check(&RunPlan::window_capacity, 0);
        check(&RunPlan::window_capacity, 33);
        check(&RunPlan::window_capacity, 0xfffffffe);
        check(&RunPlan::table_capacity, 0);
        check(&RunPlan::table_capacity, 48);
        check(&RunPlan::list_capacity, 0);
        check(&RunPlan::list_capacity, 6);
        check(&RunPlan::step_budget, 0);
        check(&RunPlan::lanes, 0);
        check(&RunPlan::detect_passes, 0);
        check(&RunPlan::detect_passes, 5000);
        check(&RunPlan::slots, kLeastSlots - 1);
        check(&RunPlan::sample_capacity, 0);
        check(&RunPlan::sample_capacity, good.plan().slots);
        check(&RunPlan::stages, 0);
        check(&RunPlan::stages, 16);
        check(&RunPlan::idle_capacity, 0);
        check(&RunPlan::idle_capacity, (1u << 23) + 1);
        check(&RunPlan::error_bound, 0.75);
        check(&RunPlan::error_bound, -0.25);

        RunPlan larger = good.plan();
        larger.window_capacity *= 2;
        const Result<Done> grown = good.job().set_plan(larger);
        REQUIRE_FALSE(grown);
        CHECK(grown.error().status == Status::workspace_too_small);
        const BufferRange& pool = good.workspace()[static_cast<std::size_t>(BufferRole::pool)];
        for (const BufferRange& wrong :
             {BufferRange{VK_NULL_HANDLE, 0, pool.size},
              BufferRange{pool.buffer, pool.offset + 4, pool.size},
              BufferRange{pool.buffer, pool.offset, good.plan().pool_bytes() - 1}}) {
            const Result<Done> set = good.job().set_plan(good.plan(), wrong);
            REQUIRE_FALSE(set);
            CHECK(set.error().message.find("pool") != std::string::npos);
        }
        CHECK(good.job().plan().slots == good.plan().slots);
        good.run(); // As if nothing had been asked.
    }

    TEST_CASE("mesh bytes go to mesh buffers of the right size only") {
        const Context context = expect(Context::create());
        const Sampler sampler = expect(Sampler::create(context.device()));
        Task knot = task(sampler, "torus-knot", 8, 60);
        const std::vector<std::uint32_t> keys = all_keys(knot.mesh);
        knot.params.face_keys = keys;
        const Domain domain = knot.domain();
        const RunPlan plan = expect(sampler.plan_run(domain, Workshop::kPoolBytes));
        for (const BufferRole role : kUploaded) {
            std::vector<std::byte> bytes(sampler.upload_size(domain, role));
            CHECK(sampler.write_upload(domain, plan, role, bytes));
            bytes.pop_back();
            CHECK_FALSE(sampler.write_upload(domain, plan, role, bytes));
        }
        std::vector<std::byte> none;
        CHECK_FALSE(sampler.write_upload(domain, plan, BufferRole::pool, none));
    }
}

} // namespace geodisk::test
