// Workspaces, plans and uploads that cannot work are refused, by name.
#include <doctest/doctest.h>

#include <cstddef>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/job/pool_plan.hpp"
#include "engine_job.hpp"

namespace geodisk::test {
namespace {

/// A key for each face, other than its index.
std::vector<std::uint32_t> all_keys(const PreparedMesh& mesh) {
    std::vector<std::uint32_t> keys(mesh.face_count());
    std::iota(keys.rbegin(), keys.rend(), 100u);
    return keys;
}

} // namespace

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
            const char* names[] = {"faces",   "fans",     "cells",   "weights",  "orders",
                                   "starts",  "pool",     "control", "list",     "sums",
                                   "samples", "accepted", "buckets", "constants"};
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
                check({range.buffer, VkDeviceSize{1} << 40, range.size}, Status::invalid_argument,
                      "ends behind its VkBuffer");
                check({range.buffer, ~VkDeviceSize{0} << 12, range.size}, Status::invalid_argument,
                      "ends behind its VkBuffer");
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
            CHECK(job.error().message == std::string("the buffer range ") + name + " is null");
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
        check(&RunPlan::slots, kMinSlots - 1);
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
        const auto range = [&](BufferRole role) {
            return good.workspace()[static_cast<std::size_t>(role)];
        };
        const BufferRange upon{pool.buffer, range(BufferRole::faces).offset, pool.size};
        CHECK(good.job().set_plan(good.plan(), upon).error().status == Status::invalid_argument);
        const BufferRange samples = range(BufferRole::samples);
        const BufferRange accepted = range(BufferRole::accepted);
        const BufferRange buckets = range(BufferRole::buckets);
        const std::uint32_t capacity = good.plan().sample_capacity;
        const auto refused_samples = [&](std::uint32_t count, const BufferRange& first,
                                         const BufferRange& second, const char* part) {
            const Result<Done> set = good.job().set_samples(count, first, second, buckets);
            REQUIRE_FALSE(set);
            CHECK(set.error().status == Status::invalid_argument);
            CHECK(set.error().message.find(part) != std::string::npos);
        };
        refused_samples(capacity, samples, samples, "overlaps");
        refused_samples(capacity, samples, pool, "overlaps");
        refused_samples(capacity, {samples.buffer, VkDeviceSize{1} << 40, samples.size}, accepted,
                        "ends behind");
        refused_samples(good.plan().slots, samples, accepted, "slots");
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
        const std::span<std::byte> nowhere(static_cast<std::byte*>(nullptr),
                                           sampler.upload_size(domain, BufferRole::faces));
        CHECK_FALSE(sampler.write_upload(domain, plan, BufferRole::faces, nowhere));
    }

    TEST_CASE("a workspace may hold what regrowths take") {
        const Context context = validated_context();
        const Sampler sampler = expect(Sampler::create(context.device()));
        const Task knot = task(sampler, "torus-knot", 8, 300);
        const Domain domain = knot.domain();
        const RunPlan plan = tightened(expect(sampler.plan_run(domain, Workshop::kPoolBytes)));
        constexpr auto kPool = static_cast<std::size_t>(BufferRole::pool);
        constexpr auto kSamples = static_cast<std::size_t>(BufferRole::samples);
        constexpr std::uint32_t kAll =
            gpu::kOverflowWindows | gpu::kOverflowVertices | gpu::kOverflowConflicts;
        const WorkspaceNeeds once = expect(sampler.workspace_needs(domain, plan));
        CHECK(expect(sampler.workspace_needs(domain, plan, 0)).bytes == once.bytes);
        for (const std::uint32_t regrowths : {1u, 2u}) {
            CAPTURE(regrowths);
            const WorkspaceNeeds needs = expect(sampler.workspace_needs(domain, plan, regrowths));
            RunPlan grown = plan;
            std::uint64_t samples = plan.sample_capacity;
            for (std::uint32_t i = 0; i < regrowths; ++i) {
                grown = expect(grown_plan(grown, kAll, needs.bytes[kPool], sampler.report()));
                samples += samples / 2;
            }
            CHECK(grown.slots == plan.slots);
            CHECK(grown.lanes == plan.lanes);
            CHECK(grown.pool_bytes() == needs.bytes[kPool]);
            CHECK(needs.bytes[kSamples] == samples * sizeof(gpu::SampleRec));
            const RunPlan more =
                expect(grown_plan(grown, kAll, needs.bytes[kPool], sampler.report()));
            CHECK(more.lanes < plan.lanes);
            for (std::size_t i = 0; i < kBufferRoles; ++i) {
                CHECK(needs.bytes[i] >= once.bytes[i]);
            }
        }
        const auto none = sampler.workspace_needs(domain, plan, 1000);
        REQUIRE_FALSE(none);
        CHECK(none.error().status == Status::workspace_too_small);
    }

    TEST_CASE("plans of few large disks fit small pools: smaller slices, then lanes") {
        const Context context = expect(Context::create());
        const Sampler sampler = expect(Sampler::create(context.device()));
        const PreparedMesh mesh = prepared(builtin("icosphere", 5));
        const Domain domain = expect(Domain::surface(mesh, params_for(mesh, 3)));
        const RunPlan ample = expect(sampler.plan_run(domain, std::uint64_t{1} << 30));
        REQUIRE(ample.disks_by == DisksBy::groups);
        const std::uint64_t slice = std::uint64_t{ample.lane_rows()} * 16;
        RunPlan least;
        std::uint64_t pool = 2 * slice;
        for (auto plan = sampler.plan_run(domain, pool); plan;
             plan = sampler.plan_run(domain, pool)) {
            least = *plan;
            CHECK(least.pool_bytes() <= pool);
            CHECK(least.window_capacity <= ample.window_capacity);
            pool /= 2;
        }
        CHECK(pool < slice / 4);
        CHECK(least.disks_by == DisksBy::lanes);
        // So do disks that outgrow the pool.
        const auto grown = [&](LastResort last) {
            return grown_plan(ample, gpu::kOverflowVertices, slice + (std::uint64_t{1} << 16),
                              sampler.report(), last);
        };
        CHECK_FALSE(grown(LastResort::none));
        CHECK(expect(grown(LastResort::lanes)).disks_by == DisksBy::lanes);
    }
}

} // namespace geodisk::test
