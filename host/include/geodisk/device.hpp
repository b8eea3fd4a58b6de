// What geodisk needs to know about a Vulkan device, and what it asks of one.
//
// geodisk runs on a device that the caller owns. Before creating it, `query_device` tells whether
// a physical device is good enough; afterwards `DeviceRefs` and `QueueRef` hand the device over.
// No extension and no optional feature has to be enabled.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <vulkan/vulkan_core.h>

#include <geodisk/export.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Memory for a buffer, asked of the caller.
struct MemoryRequest {
    VkBuffer buffer = VK_NULL_HANDLE; ///< To be bound to it, by geodisk.
    VkMemoryRequirements requirements{};
    VkMemoryPropertyFlags required =
        0; ///< Host visible and coherent where the host writes or reads.
    VkMemoryPropertyFlags preferred = 0; ///< Better still.
};

/// What the caller gives: from `offset` on, which is aligned as asked.
struct MemoryGrant {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    void* mapped = nullptr;     ///< At `offset`, until freed; not null where the host is to see it.
    void* allocation = nullptr; ///< The caller's own, for `free`.
};

/// Device memory of a caller's allocator, such as VMA, instead of an allocation for each buffer.
/// Called on the thread that calls geodisk; must not throw.
struct MemoryHooks {
    void* user = nullptr;
    /// Fills `grant`, or fails as vkAllocateMemory does.
    VkResult (*allocate)(void* user, const MemoryRequest& request, MemoryGrant& grant) = nullptr;
    void (*free)(void* user, const MemoryGrant& grant) = nullptr;
};

/// A device lent to geodisk.
///
/// Nothing here is owned: every handle must outlive each geodisk object created from it, and
/// geodisk destroys none of them. All Vulkan calls go through `get_instance_proc_addr`, so the
/// library links no Vulkan loader.
struct DeviceRefs {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    /// The lower of the version the instance was created with and the one the device reports.
    std::uint32_t api_version = VK_API_VERSION_1_1;
    /// Used, if set, for every pipeline geodisk creates. Access to it is as Vulkan defines:
    /// internally synchronized unless created otherwise.
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE;
    /// Whether VK_EXT_memory_budget is enabled: Runner then keeps to the memory that is free.
    bool memory_budget = false;
    /// Whether VK_EXT_debug_utils is enabled on the instance: pipelines and the buffers of Runner
    /// then have names, and what is recorded has a label for each stage.
    bool debug_utils = false;
    /// Where Runner gets the memory of its buffers, if set; must outlive the objects.
    const MemoryHooks* memory_hooks = nullptr;
    /// Whether VK_KHR_pipeline_executable_properties is enabled, with its feature: kernels are then
    /// compiled so that Sampler::report_kernels can tell of them.
    bool pipeline_statistics = false;
    /// Passed, if set, to each create and destroy call; must outlive the objects as well.
    const VkAllocationCallbacks* host_allocator = nullptr;
};

/// A queue lent to geodisk, of a family that supports compute.
///
/// When other code submits to the same queue at the same time, set `lock` and `unlock`: they are
/// called with `lock_user` around each submission, on the thread that runs geodisk, never nested,
/// and must not throw. geodisk never waits for the whole queue or device.
struct QueueRef {
    VkQueue queue = VK_NULL_HANDLE;
    std::uint32_t family = 0;
    void* lock_user = nullptr;
    void (*lock)(void*) = nullptr;
    void (*unlock)(void*) = nullptr;
};

/// The limits of a device that geodisk requires or adapts to. Sizes are in bytes.
struct DeviceLimits {
    std::uint64_t max_storage_buffer_range = 0;
    std::uint64_t max_memory_allocation_size = 0;
    std::uint64_t min_storage_buffer_offset_alignment = 0;
    std::uint64_t min_texel_buffer_offset_alignment = 0;
    std::uint64_t max_texel_buffer_elements = 0;
    std::uint64_t non_coherent_atom_size = 0;
    std::uint32_t max_memory_allocation_count = 0;
    std::uint32_t max_storage_buffers_per_stage = 0;
    std::uint32_t max_workgroup_invocations = 0;
    std::uint32_t max_workgroup_size_x = 0;
    std::uint32_t max_workgroup_count_x = 0;
    std::uint32_t max_shared_memory_size = 0;
    std::uint32_t max_push_constants_size = 0;
    std::uint32_t subgroup_size = 0;
    float timestamp_period = 0.0f; ///< Nanoseconds per timestamp tick.
};

/// What `query_device` found out about one physical device.
struct DeviceReport {
    std::string name;
    std::string driver_name; ///< Empty when the driver does not tell.
    std::string driver_info; ///< Empty when the driver does not tell.
    VkDriverId driver_id{};  ///< Zero when the driver does not tell.
    VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
    std::uint32_t api_version = 0; ///< As the device reports; the instance may be lower.
    std::uint32_t driver_version = 0;
    std::uint32_t vendor_id = 0;
    std::uint32_t device_id = 0;
    std::array<std::uint8_t, VK_UUID_SIZE> uuid{}; ///< Zero below Vulkan 1.1.
    DeviceLimits limits;
    std::uint64_t largest_device_local_heap = 0;
    /// The family to take the compute queue from: one without graphics where there is one, so that
    /// long dispatches do not hold up a display.
    std::optional<std::uint32_t> compute_queue_family;
    /// Of compute_queue_family; 0 when it has no timestamps.
    std::uint32_t timestamp_valid_bits = 0;
    /// The first family with graphics and compute, for those who draw with the same queue.
    std::optional<std::uint32_t> graphics_queue_family;
    /// Division and square root are known to be correctly rounded, as on the host. Vulkan promises
    /// less, so this is true only for drivers known to do better (llvmpipe).
    bool rounds_natively = false;
    /// Every unmet requirement, one line each; empty for a device that can run geodisk.
    std::vector<std::string> reasons_against;

    bool usable() const noexcept { return reasons_against.empty(); }
};

/// Reports on `physical_device` and checks it against everything geodisk requires. Call it before
/// vkCreateDevice, then create the device with a queue of `compute_queue_family`.
///
/// `instance` must have been created with API version 1.1 or higher. A device that falls short is
/// not an error: the report lists every reason. Errors: `invalid_argument` for a null argument,
/// `device_lacks` naming a function that the instance does not provide, `out_of_host_memory`.
GEODISK_API Result<DeviceReport> query_device(PFN_vkGetInstanceProcAddr get_instance_proc_addr,
                                              VkInstance instance,
                                              VkPhysicalDevice physical_device) noexcept;

} // namespace geodisk
