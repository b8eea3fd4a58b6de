// Runs keep to the memory that a device has.
#include <doctest/doctest.h>

#include <cstring>
#include <string>

#include <geodisk/runner.hpp>

#include "arena.hpp"
#include "gpu/sets.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {
namespace {

// State of the functions below, which carry no user pointer.
PFN_vkGetInstanceProcAddr real = nullptr;
PFN_vkGetPhysicalDeviceProperties2 real_properties = nullptr;
PFN_vkGetPhysicalDeviceMemoryProperties2 real_memory = nullptr;
VkDeviceSize max_at_once = 0; ///< Unless 0.
VkDeviceSize free_bytes = 0;

/// The struct of a chain with this type.
template <class Struct>
Struct* find(void* chain, VkStructureType type) {
    auto* at = static_cast<VkBaseOutStructure*>(chain);
    while (at != nullptr && at->sType != type) {
        at = at->pNext;
    }
    return reinterpret_cast<Struct*>(at);
}

VKAPI_ATTR void VKAPI_CALL small_allocations(VkPhysicalDevice device,
                                             VkPhysicalDeviceProperties2* properties) {
    real_properties(device, properties);
    auto* const limits = find<VkPhysicalDeviceMaintenance3Properties>(
        properties->pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES);
    if (limits != nullptr && max_at_once != 0) {
        limits->maxMemoryAllocationSize = max_at_once;
    }
}

VKAPI_ATTR void VKAPI_CALL little_is_free(VkPhysicalDevice device,
                                          VkPhysicalDeviceMemoryProperties2* properties) {
    real_memory(device, properties);
    auto* const budget = find<VkPhysicalDeviceMemoryBudgetPropertiesEXT>(
        properties->pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT);
    REQUIRE(budget != nullptr);
    for (std::uint32_t heap = 0; heap < VK_MAX_MEMORY_HEAPS; ++heap) {
        budget->heapUsage[heap] = VkDeviceSize{1} << 30;
        budget->heapBudget[heap] = budget->heapUsage[heap] + free_bytes;
    }
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL limited(VkInstance instance, const char* name) {
    const PFN_vkVoidFunction function = real(instance, name);
    if (std::strcmp(name, "vkGetPhysicalDeviceProperties2") == 0) {
        real_properties = reinterpret_cast<PFN_vkGetPhysicalDeviceProperties2>(function);
        return reinterpret_cast<PFN_vkVoidFunction>(small_allocations);
    }
    if (std::strcmp(name, "vkGetPhysicalDeviceMemoryProperties2") == 0) {
        real_memory = reinterpret_cast<PFN_vkGetPhysicalDeviceMemoryProperties2>(function);
        return reinterpret_cast<PFN_vkVoidFunction>(little_is_free);
    }
    return function;
}

/// A job that takes some megabytes, on a device with these limits.
struct LimitedJob {
    PreparedMesh mesh = prepared(builtin("torus-knot", 12));
    SampleParams params = params_for(mesh, 10000);
    Arena arena{shared_context().device()};
    MemoryHooks hooks = arena.hooks();

    Result<SampleSet> run(bool memory_budget = false) {
        DeviceRefs refs = shared_context().device();
        real = refs.get_instance_proc_addr;
        refs.get_instance_proc_addr = limited;
        refs.memory_budget = memory_budget;
        refs.memory_hooks = &hooks;
        Runner runner = expect(Runner::create(refs, shared_context().queue()));
        arena.largest = 0;
        return runner.sample_and_wait(mesh, params);
    }
};

} // namespace

TEST_SUITE("device memory") {
    TEST_CASE("no allocation is larger than the device allows") {
        LimitedJob job;
        max_at_once = 0;
        const SampleSet wanted = expect(job.run());
        const VkDeviceSize usual = job.arena.largest;
        for (const VkDeviceSize most : {usual - 1, usual / 8 * 7}) {
            CAPTURE(most);
            max_at_once = most;
            CHECK(points_of(expect(job.run())) == points_of(wanted));
            CHECK(job.arena.largest <= most);
        }
        max_at_once = VkDeviceSize{100} << 10;
        const auto none = job.run();
        max_at_once = 0;
        REQUIRE_FALSE(none);
        CHECK(none.error().status == Status::out_of_device_memory);
        CHECK(none.error().message.find("but the device allocates at most 102400 at once") !=
              std::string::npos);
    }

    TEST_CASE("a run keeps to what is free, where the driver tells") {
        LimitedJob job;
        const SampleSet wanted = expect(job.run());
        const VkDeviceSize usual = wanted.report.device_bytes;
        for (const VkDeviceSize bytes : {2 * usual, usual - 1, usual / 4 * 3}) {
            CAPTURE(bytes);
            free_bytes = bytes;
            const SampleSet set = expect(job.run(true));
            CHECK(points_of(set) == points_of(wanted));
            CHECK(set.report.device_bytes <= bytes);
        }
        for (const VkDeviceSize bytes : {VkDeviceSize{1} << 20, VkDeviceSize{0}}) {
            free_bytes = bytes;
            const auto none = job.run(true);
            REQUIRE_FALSE(none);
            CHECK(none.error().status == Status::out_of_device_memory);
            CHECK(none.error().message.find("may take only " + std::to_string(bytes)) !=
                  std::string::npos);
        }
    }
}

} // namespace geodisk::test
