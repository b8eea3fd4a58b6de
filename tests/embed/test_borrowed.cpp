// An application lends geodisk the device and queue it made for itself.
#include <doctest/doctest.h>

#include <string_view>

#include <geodisk/runner.hpp>

#include "app_device.hpp"
#include "device_spy.hpp"
#include "gpu/device_run.hpp"
#include "gpu/sets.hpp"
#include "host_memory.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {
namespace {

/// A run on `device` returns what sequential dart throwing returns.
void check_run(Runner& runner, std::uint64_t seed = 1) {
    const PreparedMesh mesh = prepared(builtin("torus-knot", 8));
    const SampleParams params = params_for(mesh, 200, seed);
    const SampleSet set = expect(runner.sample_and_wait(mesh, params));
    CHECK(set.samples.size() > 100);
    CHECK(points_of(set) == float_set(mesh, params, set.report.plan.error_bound));
}

void check_silent(const AppDevice& app) {
    for (const std::string& message : app.messages()) {
        MESSAGE(message);
    }
    CHECK(app.messages().empty());
}

/// Counts of the uses of a queue's callbacks.
struct QueueLock {
    std::uint32_t locked = 0;
    std::uint32_t unlocked = 0;
    std::uint32_t misused = 0;
    bool held = false;

    static void lock(void* user) {
        QueueLock& self = *static_cast<QueueLock*>(user);
        self.misused += self.held ? 1u : 0u;
        self.held = true;
        ++self.locked;
    }
    static void unlock(void* user) {
        QueueLock& self = *static_cast<QueueLock*>(user);
        self.misused += self.held ? 0u : 1u;
        self.held = false;
        ++self.unlocked;
    }
};

/// Returns the device with functions that a DeviceSpy watches.
DeviceRefs spied(const AppDevice& app) {
    DeviceRefs refs = app.refs();
    refs.get_instance_proc_addr = &DeviceSpy::get_instance_proc_addr;
    return refs;
}

} // namespace

TEST_SUITE("borrowed") {
    TEST_CASE("a lent device samples, and is destroyed without complaint") {
        AppDevice app;
        {
            Runner runner = expect(Runner::create(app.refs(), app.queue()));
            check_run(runner);
        }
        app.destroy_device();
        check_silent(app);
    }

    TEST_CASE("the validation layer of the lent device is truly on") {
        AppDevice app;
        VkFenceCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        VkFence leaked = VK_NULL_HANDLE;
        REQUIRE(app.function<PFN_vkCreateFence>("vkCreateFence")(app.refs().device, &info, nullptr,
                                                                 &leaked) == VK_SUCCESS);
        app.destroy_device();
        REQUIRE_FALSE(app.messages().empty());
        CHECK(app.messages().front().find("vkDestroyDevice") != std::string::npos);
    }

    TEST_CASE("every submission holds the queue's lock, and nothing else does") {
        AppDevice app;
        DeviceSpy spy(app.refs().get_instance_proc_addr);
        DeviceRefs refs = spied(app);
        QueueLock lock;
        QueueRef queue = app.queue();
        queue.lock_user = &lock;
        queue.lock = &QueueLock::lock;
        queue.unlock = &QueueLock::unlock;
        std::uint32_t wrong = 0;
        spy.on_call = [&](std::string_view function) {
            wrong += lock.held != (function == "vkQueueSubmit") ? 1u : 0u;
        };
        {
            Runner runner = expect(Runner::create(refs, queue));
            check_run(runner);
        }
        CHECK(wrong == 0);
        CHECK(lock.misused == 0);
        CHECK(lock.locked == spy.calls("vkQueueSubmit"));
        CHECK(lock.unlocked == lock.locked);
        CHECK(lock.locked > 5);
        CHECK(spy.alive().empty());
        CHECK(spy.strangers() == 0);
        app.destroy_device();
        check_silent(app);
    }

    TEST_CASE("a lent pipeline cache is used and outlives the runner") {
        AppDevice app;
        DeviceSpy spy(app.refs().get_instance_proc_addr);
        VkPipelineCacheCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
        DeviceRefs refs = spied(app);
        REQUIRE(app.function<PFN_vkCreatePipelineCache>("vkCreatePipelineCache")(
                    refs.device, &info, nullptr, &refs.pipeline_cache) == VK_SUCCESS);
        for (int i = 0; i < 2; ++i) {
            Runner runner = expect(Runner::create(refs, app.queue()));
            check_run(runner);
        }
        CHECK(spy.pipeline_cache() == refs.pipeline_cache);
        std::size_t bytes = 0;
        CHECK(app.function<PFN_vkGetPipelineCacheData>("vkGetPipelineCacheData")(
                  refs.device, refs.pipeline_cache, &bytes, nullptr) == VK_SUCCESS);
        CHECK(bytes > 0);
        app.function<PFN_vkDestroyPipelineCache>("vkDestroyPipelineCache")(
            refs.device, refs.pipeline_cache, nullptr);
        app.destroy_device();
        check_silent(app);
    }

    TEST_CASE("pipelines compiled ahead serve a run, and each that fails leaves nothing") {
        AppDevice app;
        DeviceSpy spy(app.refs().get_instance_proc_addr);
        const DeviceRefs refs = spied(app);
        SamplerOptions options;
        options.ahead = Ahead::surface;
        constexpr const char* kCompiles = "vkCreateComputePipelines";
        {
            const auto sampler =
                std::make_shared<const Sampler>(expect(Sampler::create(refs, options)));
            const std::uint32_t ahead = spy.calls(kCompiles);
            Runner runner = expect(Runner::create(sampler, app.queue()));
            check_run(runner);
            CHECK(spy.calls(kCompiles) == ahead);
        }
        std::uint32_t failed = 0;
        for (bool fails = true; fails; ++failed) {
            spy.fail(kCompiles, failed, VK_ERROR_OUT_OF_DEVICE_MEMORY);
            const auto sampler = Sampler::create(refs, options);
            fails = spy.end_of_fault();
            CHECK(static_cast<bool>(sampler) != fails);
        }
        CHECK(failed > 10);
        CHECK(spy.alive().empty());
        CHECK(spy.strangers() == 0);
        app.destroy_device();
        check_silent(app);
    }

    TEST_CASE("the first run lets drivers compile at dispatches of no work groups") {
        AppDevice app;
        DeviceSpy spy(app.refs().get_instance_proc_addr);
        const DeviceRefs refs = spied(app);
        std::uint32_t real = 0;
        std::uint32_t real_before = 0;
        std::uint32_t last_empty = 0;
        spy.on_dispatch = [&](std::uint32_t) {
            real_before += spy.empty_dispatches != last_empty ? real : 0;
            last_empty = spy.empty_dispatches;
            ++real;
        };
        {
            Runner runner = expect(Runner::create(refs, app.queue()));
            real = 0; // Without that of the self test.
            check_run(runner);
            CHECK(spy.empty_dispatches > 12);
            CHECK(real_before == 0); // All of them come first.
            const std::uint32_t first = spy.empty_dispatches;
            check_run(runner, 2);
            CHECK(spy.empty_dispatches == first);
        }
        app.destroy_device();
        check_silent(app);
    }

    TEST_CASE("pipelines compiled on several threads serve a run") {
        AppDevice app;
        SamplerOptions options;
        options.ahead = Ahead::surface;
        options.threads.max_threads = 8;
        {
            Runner runner = expect(Runner::create(
                std::make_shared<const Sampler>(expect(Sampler::create(app.refs(), options))),
                app.queue()));
            check_run(runner);
        }
        app.destroy_device();
        check_silent(app);
    }

    TEST_CASE("lent allocation callbacks serve every object, and all memory comes back") {
        HostMemory memory;
        {
            AppDevice app(memory.callbacks());
            const std::uint64_t before = memory.live();
            {
                Runner runner = expect(Runner::create(app.refs(), app.queue()));
                CHECK(memory.live() > before);
                check_run(runner);
            }
            app.destroy_device();
            check_silent(app);
        }
        CHECK(memory.allocations() > 100);
        CHECK(memory.live() == 0);
        CHECK(memory.misuses() == 0);
    }

    TEST_CASE("arguments that cannot work are refused by name") {
        AppDevice app;
        const auto refused = [&](const DeviceRefs& refs, const QueueRef& queue, const char* part) {
            CAPTURE(part);
            const Result<Runner> runner = Runner::create(refs, queue);
            REQUIRE_FALSE(runner);
            CHECK(runner.error().status == Status::invalid_argument);
            CHECK(runner.error().message.find(part) != std::string::npos);
        };
        DeviceRefs refs = app.refs();
        refs.device = VK_NULL_HANDLE;
        refused(refs, app.queue(), "DeviceRefs::device");
        QueueRef queue = app.queue();
        queue.queue = VK_NULL_HANDLE;
        refused(app.refs(), queue, "QueueRef::queue");
        queue = app.queue();
        queue.family = 1000;
        refused(app.refs(), queue, "QueueRef::family");
        queue = app.queue();
        queue.lock = &QueueLock::lock;
        refused(app.refs(), queue, "QueueRef::unlock");
    }
}

} // namespace geodisk::test
