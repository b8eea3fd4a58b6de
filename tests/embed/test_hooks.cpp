// Hooks of a caller: its own memory, and names for its debugger.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include <geodisk/runner.hpp>

#include "app_device.hpp"
#include "arena.hpp"
#include "gpu/sets.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {
namespace {

// State of the functions below, which carry no user pointer.
PFN_vkGetInstanceProcAddr real_driver = nullptr;
PFN_vkSetDebugUtilsObjectNameEXT set_name = nullptr;
PFN_vkCmdBeginDebugUtilsLabelEXT begin_label = nullptr;
PFN_vkCmdEndDebugUtilsLabelEXT end_label = nullptr;
bool has_labels = true;
std::multiset<std::string> names;
std::vector<std::string> labels;
int open_labels = 0;

VKAPI_ATTR VkResult VKAPI_CALL note_name(VkDevice device,
                                         const VkDebugUtilsObjectNameInfoEXT* info) {
    names.insert(info->pObjectName);
    return set_name(device, info);
}

VKAPI_ATTR void VKAPI_CALL note_begin(VkCommandBuffer commands, const VkDebugUtilsLabelEXT* label) {
    CHECK(open_labels++ == 0);
    labels.push_back(label->pLabelName);
    begin_label(commands, label);
}

VKAPI_ATTR void VKAPI_CALL note_end(VkCommandBuffer commands) {
    CHECK(open_labels-- == 1);
    end_label(commands);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL watched(VkInstance instance, const char* name) {
    const PFN_vkVoidFunction function = real_driver(instance, name);
    if (std::strcmp(name, "vkSetDebugUtilsObjectNameEXT") == 0) {
        set_name = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(function);
        return reinterpret_cast<PFN_vkVoidFunction>(note_name);
    }
    if (std::strcmp(name, "vkCmdBeginDebugUtilsLabelEXT") == 0) {
        begin_label = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(function);
        return has_labels ? reinterpret_cast<PFN_vkVoidFunction>(note_begin) : nullptr;
    }
    if (std::strcmp(name, "vkCmdEndDebugUtilsLabelEXT") == 0) {
        end_label = reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(function);
        return reinterpret_cast<PFN_vkVoidFunction>(note_end);
    }
    return function;
}

struct SmallJob {
    PreparedMesh mesh = prepared(builtin("icosphere", 2));
    SampleParams params = params_for(mesh, 100);
    void check(Runner& runner) const {
        const SampleSet set = expect(runner.sample_and_wait(mesh, params));
        CHECK(points_of(set) == float_set(mesh, params, set.report.plan.error_bound));
    }
};

/// A device whose buffers lie in the arena.
struct HookedDevice {
    AppDevice app;
    Arena arena{app.refs()};
    MemoryHooks hooks = arena.hooks();

    Result<Runner> create() const {
        DeviceRefs refs = app.refs();
        refs.memory_hooks = &hooks;
        return Runner::create(refs, app.queue());
    }
};

} // namespace

TEST_SUITE("hooks") {
    TEST_CASE("buffers lie in the caller's memory, and go back to it") {
        HookedDevice device;
        Arena& arena = device.arena;
        const SmallJob job;
        {
            Runner runner = expect(device.create());
            job.check(runner);
            const std::uint32_t asked = arena.asked;
            CHECK(asked > 0);
            job.check(runner);
            CHECK(arena.asked == asked);
            runner.release_memory();
            CHECK(arena.alive.empty());
            job.check(runner);
            CHECK_FALSE(arena.alive.empty());
        }
        CHECK(arena.alive.empty());
        CHECK(device.app.messages().empty());
    }

    TEST_CASE("a caller without memory is an error that names the bytes, whichever it lacks") {
        HookedDevice device;
        Arena& arena = device.arena;
        const SmallJob job;
        Runner runner = expect(device.create());
        arena.asked = 0;
        job.check(runner);
        const std::uint32_t needed = arena.asked;
        for (std::uint32_t i = 0; i < needed; ++i) {
            CAPTURE(i);
            runner.release_memory();
            arena.asked = 0;
            arena.fail_from = i;
            const auto set = runner.sample_and_wait(job.mesh, job.params);
            REQUIRE_FALSE(set);
            CHECK(set.error().status == Status::out_of_device_memory);
            CHECK(set.error().message.find("MemoryHooks::allocate") != std::string::npos);
            CHECK(set.error().message.find("bytes") != std::string::npos);
            CHECK(arena.alive.empty());
        }
        arena.fail_from = ~0u;
        arena.forget_to_map = true;
        const auto set = runner.sample_and_wait(job.mesh, job.params);
        REQUIRE_FALSE(set);
        CHECK(set.error().status == Status::invalid_argument);
        CHECK(arena.alive.empty());
        arena.forget_to_map = false;
        job.check(runner);
        CHECK(device.app.messages().empty());
    }

    TEST_CASE(
        "pipelines and buffers have names, and stages labels, where the caller asks for them") {
        AppDevice app;
        real_driver = app.refs().get_instance_proc_addr;
        names.clear();
        labels.clear();
        DeviceRefs refs = app.refs();
        refs.get_instance_proc_addr = watched;
        const SmallJob job;
        {
            Runner runner = expect(Runner::create(refs, app.queue()));
            job.check(runner);
            CHECK(names.empty());
            CHECK(labels.empty());
        }
        refs.debug_utils = true;
        {
            Runner runner = expect(Runner::create(refs, app.queue()));
            job.check(runner);
            for (const char* name :
                 {"geodisk detect", "geodisk select", "geodisk resolve", "geodisk draw",
                  "geodisk faces", "geodisk pool", "geodisk staging"}) {
                CAPTURE(name);
                CHECK(names.count(name) >= 1);
            }
            for (const Stage stage : {Stage::count, Stage::draw, Stage::select, Stage::detect,
                                      Stage::resolve, Stage::gather}) {
                CAPTURE(to_string(stage));
                CHECK(std::count(labels.begin(), labels.end(), to_string(stage)) >= 1);
            }
            CHECK(open_labels == 0);
        }
        has_labels = false;
        const auto refused = Runner::create(refs, app.queue());
        has_labels = true;
        REQUIRE_FALSE(refused);
        CHECK(refused.error().status == Status::device_lacks);
        CHECK(refused.error().message.find("vkCmdBeginDebugUtilsLabelEXT") != std::string::npos);
        CHECK(app.messages().empty());
    }
}

} // namespace geodisk::test
