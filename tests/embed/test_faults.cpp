// Every fallible Vulkan call fails once, at every place: the error says so, nothing leaks, nothing
// that was never made is destroyed, and the next run is as good as any.
#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <geodisk/context.hpp>
#include <geodisk/runner.hpp>

#include "engine/domain/stages.hpp"
#include "fake_driver.hpp"
#include "gpu/device_run.hpp"
#include "gpu/sets.hpp"
#include "support/device_abilities.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"
#include "vk/result.hpp"
#include "watched_bench.hpp"

namespace geodisk::test {
namespace {

constexpr VkResult kNoHostMemory = VK_ERROR_OUT_OF_HOST_MEMORY;
constexpr VkResult kNoDeviceMemory = VK_ERROR_OUT_OF_DEVICE_MEMORY;

/// A function and all that the specification lets it fail with and that can happen.
struct Fallible {
    const char* function;
    std::vector<VkResult> results;
};

const std::vector<Fallible> kFallible = {
    {"vkCreateDescriptorSetLayout", {kNoHostMemory, kNoDeviceMemory}},
    {"vkCreatePipelineLayout", {kNoHostMemory, kNoDeviceMemory}},
    {"vkCreateShaderModule", {kNoHostMemory, kNoDeviceMemory}},
    {"vkCreateComputePipelines", {kNoHostMemory, kNoDeviceMemory}},
    {"vkCreateCommandPool", {kNoHostMemory, kNoDeviceMemory}},
    {"vkAllocateCommandBuffers", {kNoHostMemory, kNoDeviceMemory}},
    {"vkCreateFence", {kNoHostMemory, kNoDeviceMemory}},
    {"vkCreateDescriptorPool", {kNoHostMemory, kNoDeviceMemory}},
    {"vkAllocateDescriptorSets",
     {kNoHostMemory, kNoDeviceMemory, VK_ERROR_FRAGMENTED_POOL, VK_ERROR_OUT_OF_POOL_MEMORY}},
    {"vkCreateBuffer", {kNoHostMemory, kNoDeviceMemory}},
    {"vkCreateBufferView", {kNoHostMemory, kNoDeviceMemory}},
    {"vkAllocateMemory", {kNoHostMemory, kNoDeviceMemory, VK_ERROR_TOO_MANY_OBJECTS}},
    {"vkBindBufferMemory", {kNoHostMemory, kNoDeviceMemory}},
    {"vkMapMemory", {kNoHostMemory, kNoDeviceMemory, VK_ERROR_MEMORY_MAP_FAILED}},
    {"vkResetCommandPool", {kNoHostMemory, kNoDeviceMemory}},
    {"vkBeginCommandBuffer", {kNoHostMemory, kNoDeviceMemory}},
    {"vkEndCommandBuffer", {kNoHostMemory, kNoDeviceMemory}},
    {"vkQueueSubmit", {kNoHostMemory, kNoDeviceMemory}},
    {"vkResetFences", {kNoDeviceMemory}},
};

void check_error(const Error& error, const char* function, VkResult result) {
    CHECK(error.status == status_of(result));
    CHECK(error.status != Status::internal);
    CHECK(error.vk_result == result);
    CHECK(error.message.find(function) != std::string::npos);
    CHECK(error.message.find(to_string(result)) != std::string::npos);
}

/// Fails every call that Runner::create makes of `function`, one after the other; returns the
/// runner that is created once none fails.
Runner sweep_create(Bench& bench, const char* function, VkResult result, std::uint32_t& faults) {
    for (std::uint32_t number = 0;; ++number) {
        CAPTURE(number);
        bench.spy.fail(function, number, result);
        Result<Runner> runner = bench.create();
        if (!bench.spy.end_of_fault()) {
            return expect(std::move(runner));
        }
        REQUIRE_FALSE(runner);
        check_error(runner.error(), function, result);
        CHECK(bench.spy.alive() == "");
        CHECK(bench.spy.strangers() == 0);
        ++faults;
    }
}

/// Fails every call of `function` that compiling for a domain makes, with `runner` and others like
/// it: nothing is left of the pipelines before it, and the next try works. Leaves `runner` ready.
void sweep_prepare(Bench& bench, Runner& runner, const char* function, VkResult result,
                   std::uint32_t& faults) {
    for (std::uint32_t number = 0;; ++number) {
        CAPTURE(number);
        const std::string own = bench.spy.alive();
        bench.spy.fail(function, number, result);
        const Result<Done> done = bench.prepare(runner);
        if (!bench.spy.end_of_fault()) {
            CHECK(done);
            return;
        }
        REQUIRE_FALSE(done);
        check_error(done.error(), function, result);
        CHECK(bench.spy.alive() == own);
        CHECK(bench.spy.strangers() == 0);
        bench.check_run(runner);
        runner = expect(bench.create());
        ++faults;
    }
}

/// Returns true for what a run tries again with less, if that would do.
bool makes_buffers(std::string_view function) {
    return function == "vkCreateBuffer" || function == "vkAllocateMemory" ||
           function == "vkBindBufferMemory" || function == "vkMapMemory";
}

/// Fails every call of `function` that a run by a prepared runner makes, and returns how many there
/// are; the runner works again after each.
std::uint32_t sweep_run(Bench& bench, Runner& runner, const char* function, VkResult result) {
    runner.release_memory();
    const std::string own = bench.spy.alive();
    for (std::uint32_t number = 0;; ++number) {
        CAPTURE(number);
        runner.release_memory();
        bench.spy.fail(function, number, result);
        const Result<SampleSet> set = bench.sample(runner);
        if (!bench.spy.end_of_fault()) {
            bench.check_set(set);
            return number;
        }
        if (set) { // With half as much.
            CHECK(makes_buffers(function));
            CHECK(result == kNoDeviceMemory);
            bench.check_set(set);
            continue;
        }
        check_error(set.error(), function, result);
        CHECK(bench.spy.alive() == own);
        CHECK(bench.spy.strangers() == 0);
        bench.check_run(runner);
    }
}

/// Fails every call of `function`, at all times.
void sweep(Bench& bench, const char* function, VkResult result) {
    if (!bench.reads_texels() && function == std::string_view("vkCreateBufferView")) {
        MESSAGE("skipped: vkCreateBufferView, the device reads no texels");
        return;
    }
    CAPTURE(std::string(function));
    CAPTURE(to_string(result));
    std::uint32_t faults = 0;
    {
        Runner runner = sweep_create(bench, function, result, faults);
        sweep_prepare(bench, runner, function, result, faults);
        faults += sweep_run(bench, runner, function, result);
    }
    CHECK(faults > 0);
    CHECK(bench.spy.alive() == "");
    CHECK(bench.spy.strangers() == 0);
}

/// Shader modules are done with once the pipelines exist.
bool frees_what_runs(std::string_view function) {
    return (function.starts_with("vkDestroy") && function != "vkDestroyShaderModule") ||
           function.starts_with("vkFree");
}

void check_given_up(const Error& error) {
    CHECK(error.status == Status::device_lost);
    CHECK(error.message.find("did not respond") != std::string::npos);
}

} // namespace

TEST_SUITE("faults") {
    TEST_CASE("no failed call leaks, spoils the runner or goes unnamed") {
        Bench bench;
        for (const Fallible& fallible : kFallible) {
            sweep(bench, fallible.function, fallible.results.front());
        }
    }

    TEST_CASE("nor does one, whatever it fails with" * doctest::test_suite("slow")) {
        Bench bench;
        for (const Fallible& fallible : kFallible) {
            for (std::size_t i = 1; i < fallible.results.size(); ++i) {
                sweep(bench, fallible.function, fallible.results[i]);
            }
        }
    }

    TEST_CASE("nor does one in any other domain") {
        const TestMesh shape = builtin("torus-knot", 4);
        const PreparedMesh knot = prepared(shape);
        const RadiusField radii = radius_field(knot, wavy_factors(shape, 0.5));
        const SampleParams params = params_for(knot, 30);
        const SampleParams varying = params_for(knot, 30, 1, &radii);
        const std::vector<SurfacePart> parts{{&knot, varying}, {&knot, varying, 2}};
        BoxParams box{{1, 1}, true};
        box.min_distance = 0.2;
        const std::vector<std::function<Result<Domain>()>> domains{
            [&] { return Domain::surfaces(parts); }, [&] { return Domain::box(box); },
            [&] {
                return Domain::surface_in_space(shape.view(), knot, params, Metric::euclidean);
            }};
        for (const auto& domain : domains) {
            Bench bench;
            bench.other = domain;
            std::uint32_t faults = 0;
            {
                Runner runner = bench.prepared_runner();
                for (const Fallible& fallible : kFallible) {
                    CAPTURE(std::string(fallible.function));
                    faults += sweep_run(bench, runner, fallible.function, fallible.results.back());
                }
            }
            CHECK(faults > 0);
            CHECK(bench.spy.alive() == "");
            CHECK(bench.spy.strangers() == 0);
        }
    }

    TEST_CASE("nor does one while a disk that trims gets kernels and memory for that") {
        const PreparedMesh tube = prepared(builtin("tube", 6));
        SampleParams params;
        params.min_distance = 1;
        Bench bench;
        bench.other = [&] { return Domain::surface(tube, params); };
        std::uint32_t compiled = 0;
        for (bool fired = true; fired; ++compiled) {
            CAPTURE(compiled);
            Runner runner = bench.prepared_runner();
            bench.spy.fail("vkCreateComputePipelines", compiled, kNoDeviceMemory);
            const Result<SampleSet> set = bench.sample(runner);
            fired = bench.spy.end_of_fault();
            if (fired) {
                REQUIRE_FALSE(set);
                check_error(set.error(), "vkCreateComputePipelines", kNoDeviceMemory);
            }
            bench.check_run(runner);
        }
        CHECK(compiled > 1);
        {
            Runner runner = bench.prepared_runner();
            bench.check_run(runner); // Leaves it with the kernels that trim.
            CHECK(sweep_run(bench, runner, "vkAllocateMemory", VK_ERROR_TOO_MANY_OBJECTS) > 1);
        }
        CHECK(bench.spy.alive() == "");
        CHECK(bench.spy.strangers() == 0);
    }

    TEST_CASE("nor does one where work groups compute all disks, or those that lanes leave") {
        RunnerOptions by_groups;
        by_groups.plan.disks_by = DisksBy::groups;
        RunnerOptions leaving;
        leaving.plan.large_groups = 2;
        leaving.plan.large_after = 10;
        for (const RunnerOptions& options : {by_groups, leaving}) {
            Bench bench;
            {
                Runner runner = bench.prepared_runner(options);
                for (const char* function :
                     {"vkCreateBuffer", "vkAllocateMemory", "vkMapMemory", "vkQueueSubmit"}) {
                    CAPTURE(function);
                    CHECK(sweep_run(bench, runner, function, kNoDeviceMemory) > 0);
                }
            }
            CHECK(bench.spy.alive() == "");
            CHECK(bench.spy.strangers() == 0);
        }
    }

    TEST_CASE("nor does one between chunks") {
        Bench bench;
        {
            Runner in_chunks = bench.prepared_runner(growing());
            Runner at_once = bench.prepared_runner();
            for (const char* function :
                 {"vkCreateBuffer", "vkAllocateMemory", "vkBindBufferMemory", "vkQueueSubmit"}) {
                CAPTURE(function);
                CHECK(sweep_run(bench, in_chunks, function, kNoDeviceMemory) >
                      sweep_run(bench, at_once, function, kNoDeviceMemory));
            }
        }
        CHECK(bench.spy.alive() == "");
        CHECK(bench.spy.strangers() == 0);
    }

    TEST_CASE("a wait that fails for want of memory goes on waiting") {
        Bench bench;
        for (const VkResult result : {kNoHostMemory, kNoDeviceMemory}) {
            Runner runner = expect(bench.create());
            bool fired = true;
            for (std::uint32_t number = 0; fired; ++number) {
                bench.spy.fail("vkWaitForFences", number, result);
                bench.check_run(runner);
                fired = bench.spy.end_of_fault();
            }
        }
        CHECK(bench.spy.alive() == "");
    }

    TEST_CASE("a lost device is reported, left alone and cleaned up") {
        for (const char* function : {"vkQueueSubmit", "vkWaitForFences"}) {
            CAPTURE(function);
            Bench bench;
            bench.spy.fail(function, 0, VK_ERROR_DEVICE_LOST);
            const Result<Runner> refused = bench.create();
            CHECK(bench.spy.end_of_fault());
            REQUIRE_FALSE(refused);
            check_error(refused.error(), function, VK_ERROR_DEVICE_LOST);
            CHECK(bench.spy.alive() == "");
            bool fired = true;
            for (std::uint32_t number = 0; fired; ++number) {
                Runner runner = bench.prepared_runner();
                const std::string own = bench.spy.alive();
                bench.spy.fail(function, number, VK_ERROR_DEVICE_LOST);
                const Result<SampleSet> set = bench.sample(runner);
                fired = bench.spy.end_of_fault();
                if (fired) {
                    REQUIRE_FALSE(set);
                    check_error(set.error(), function, VK_ERROR_DEVICE_LOST);
                    CHECK(bench.spy.alive() == own);
                    std::uint32_t calls = 0;
                    bench.spy.on_call = [&](std::string_view) { ++calls; };
                    const auto again = bench.sample(runner);
                    bench.spy.on_call = nullptr;
                    REQUIRE_FALSE(again);
                    CHECK(again.error().status == Status::device_lost);
                    CHECK(calls == 0);
                }
            }
            CHECK(bench.spy.alive() == "");
            CHECK(bench.spy.strangers() == 0);
        }
    }

    TEST_CASE("a device that never answers is given up, and nothing it may use is freed") {
        Bench bench;
        RunnerOptions options;
        options.stall_seconds = 1;
        std::uint32_t freed = 0;
        {
            Runner runner = expect(bench.create(options));
            bench.spy.never_signal = true;
            bench.spy.on_call = [&](std::string_view function) {
                freed += frees_what_runs(function) ? 1u : 0u;
            };
            const auto set = bench.sample(runner);
            REQUIRE_FALSE(set);
            check_given_up(set.error());
            const std::uint32_t submitted = bench.spy.calls("vkQueueSubmit");
            const std::uint32_t reset = bench.spy.calls("vkResetCommandPool");
            const auto again = bench.sample(runner);
            REQUIRE_FALSE(again);
            check_given_up(again.error());
            CHECK(bench.spy.calls("vkQueueSubmit") == submitted);
            CHECK(bench.spy.calls("vkResetCommandPool") == reset);
        }
        CHECK(freed == 0);
        const std::string alive = bench.spy.alive();
        for (const char* kept : {"vkDestroyPipeline", "vkDestroyFence", "vkDestroyCommandPool",
                                 "vkDestroyDescriptorPool", "vkFreeMemory", "vkDestroyBuffer"}) {
            CHECK(alive.find(kept) != std::string::npos);
        }
        bench.spy.destroy_what_is_alive();

        // The same for the very first submission, the self-test's.
        const Result<Runner> refused = bench.create(options);
        REQUIRE_FALSE(refused);
        check_given_up(refused.error());
        CHECK(freed == 0);
        CHECK(bench.spy.alive().find("vkFreeMemory") != std::string::npos);
        CHECK(bench.spy.alive().find("vkDestroyPipeline") != std::string::npos);
        bench.spy.destroy_what_is_alive();

        bench.spy.never_signal = false;
        bench.spy.on_call = nullptr;
        Runner runner = expect(bench.create());
        bench.check_run(runner);
    }

    TEST_CASE("samples on their way to a larger buffer are not freed when the device hangs") {
        Bench bench;
        RunnerOptions options = growing();
        options.stall_seconds = 1;
        std::uint32_t freed = 0;
        std::uint32_t enlarged = 0;
        bool has_job = false;
        {
            Runner runner = expect(bench.create(options));
            bench.spy.on_call = [&](std::string_view function) {
                has_job = has_job || function == "vkCreateDescriptorPool";
                enlarged += has_job && function == "vkCreateBuffer" ? 1u : 0u;
                // Three buffers, and then what two of them hold is copied.
                bench.spy.never_signal = enlarged == 3;
                freed += enlarged == 3 && frees_what_runs(function) ? 1u : 0u;
            };
            const auto set = bench.sample(runner);
            REQUIRE_FALSE(set);
            check_given_up(set.error());
            CHECK(enlarged == 3);
        }
        CHECK(freed == 0);
        bench.spy.on_call = nullptr;
        bench.spy.never_signal = false;
        bench.spy.destroy_what_is_alive();
    }

    TEST_CASE("a device that computes wrongly is refused, naming the operation") {
        Bench bench;
        const char* const operations[] = {"division", "square root", "a * b + c", "(c + a) - c"};
        for (std::size_t operation = 0; operation < 4; ++operation) {
            for (const std::size_t vector : {0u, 1234u, 4095u}) {
                CAPTURE(operation);
                CAPTURE(vector);
                bench.spy.on_done = [&](std::span<const std::span<std::byte>> mapped) {
                    REQUIRE(mapped.size() == 1);
                    // The last bit of the fraction.
                    mapped[0][(vector * 4 + operation) * 4] ^= std::byte{1};
                };
                const Result<Runner> runner = bench.create();
                REQUIRE_FALSE(runner);
                CHECK(runner.error().status == Status::device_lacks);
                CHECK(runner.error().message.find(operations[operation]) != std::string::npos);
                CHECK(runner.error().message.find(bench.context.report().name) !=
                      std::string::npos);
                CHECK(bench.spy.alive() == "");
            }
        }
        bench.spy.on_done = nullptr;
        Runner runner = expect(bench.create());
        bench.check_run(runner);
    }

    TEST_CASE("a device without enough memory is told from its bytes") {
        Bench bench;
        Runner runner = expect(bench.create());
        for (const VkDeviceSize left : {1000u, 30'000u, 100'000u}) {
            CAPTURE(left);
            bench.spy.memory_left = left;
            const auto set = bench.sample(runner);
            REQUIRE_FALSE(set);
            CHECK(set.error().status == Status::out_of_device_memory);
            CHECK(set.error().message.find("vkAllocateMemory") != std::string::npos);
            CHECK(set.error().message.find("bytes") != std::string::npos);
        }
        bench.spy.memory_left = ~VkDeviceSize{0};
        bench.check_run(runner);
    }

    TEST_CASE("candidates beyond the device's memory are drawn in chunks") {
        const Context context = expect(Context::create());
        FakeDriver driver;
        driver.edit_memory = [](VkPhysicalDeviceMemoryProperties& memory) {
            for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
                memory.memoryHeaps[i].size = 1 << 15;
            }
        };
        DeviceRefs refs = context.device();
        refs.get_instance_proc_addr = &FakeDriver::get_instance_proc_addr;
        Runner runner = expect(Runner::create(refs, context.queue()));
        const PreparedMesh mesh = prepared(builtin("icosphere", 2));
        const SampleParams params = params_for(mesh, 100);
        const SampleSet set = expect(runner.sample_and_wait(mesh, params));
        // Four stages run two at a time, at 16 bytes a candidate in three quarters of the memory.
        CHECK(stages_of(mesh, params).pool_stages() == 4);
        CHECK(2 * stages_of(mesh, params).expected(0) < (1 << 15) / 4 * 3 / 16);
        CHECK(3 * stages_of(mesh, params).expected(0) > 0.9 * (1 << 15) / 4 * 3 / 16);
        CHECK(set.report.plan.stages == 2);
        CHECK(set.report.chunks == 2);
        CHECK(points_of(set) == float_set(mesh, params, set.report.plan.error_bound));
    }

    TEST_CASE("more samples than the device can bind are refused at once, with the numbers") {
        const Context context = expect(Context::create());
        FakeDriver driver;
        const PreparedMesh mesh = prepared(builtin("icosphere", 2));
        for (const std::uint32_t range : {1u << 27, 1u << 28}) {
            CAPTURE(range);
            driver.edit_properties = [range](VkPhysicalDeviceProperties& properties) {
                properties.limits.maxStorageBufferRange = range;
            };
            DeviceRefs refs = context.device();
            refs.get_instance_proc_addr = &FakeDriver::get_instance_proc_addr;
            Runner runner = expect(Runner::create(refs, context.queue()));
            CHECK(runner.sample_and_wait(mesh, params_for(mesh, 30)));
            // A sample takes 16 bytes; one percent more of them than fit.
            const double most = range / 16.0;
            const auto set =
                runner.sample_and_wait(mesh, params_for(mesh, 1.01 * most),
                                       [](const Progress&) { return false; }); // No work at all.
            REQUIRE_FALSE(set);
            CHECK(set.error().status == Status::job_too_large);
            CHECK(set.error().message.find("candidates") != std::string::npos);
            CHECK(set.error().message.find(std::to_string(range)) != std::string::npos);
        }
    }
}

} // namespace geodisk::test
