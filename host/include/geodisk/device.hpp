// DeviceRefs and QueueRef: a Vulkan device and queue of the caller's, and what geodisk requires.
//
// geodisk runs on a device that the caller owns. Call `query_device` before you create it, to learn
// whether the physical device meets the requirements. Then pass the device as `DeviceRefs` and
// `QueueRef`. No extension and no optional feature has to be enabled.
// Stable.
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

/// Request for the memory of a buffer, answered by MemoryHooks::allocate.
struct MemoryRequest {
    VkBuffer buffer = VK_NULL_HANDLE; ///< Buffer that geodisk will bind to the memory.
    VkMemoryRequirements requirements{};
    /// Required properties: host visible and coherent if the host writes or reads the buffer.
    VkMemoryPropertyFlags required = 0;
    VkMemoryPropertyFlags preferred = 0; ///< Properties to prefer among suitable memory types.
};

/// Memory that the caller grants for a buffer.
struct MemoryGrant {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;    ///< First byte, aligned as requested.
    void* mapped = nullptr;     ///< Host address of `offset`, valid until freed. Not null if host
                                ///< visible memory was required.
    void* allocation = nullptr; ///< Value of the caller's choice, for `free`.
};

/// Callbacks to a caller's allocator, such as VMA. Without them geodisk allocates device memory for
/// each buffer. Called on the thread that calls geodisk; must not throw.
struct MemoryHooks {
    void* user = nullptr; ///< Passed to both callbacks.
    /// Fills `grant` and returns VK_SUCCESS, or returns an error of vkAllocateMemory.
    VkResult (*allocate)(void* user, const MemoryRequest& request, MemoryGrant& grant) = nullptr;
    /// Frees memory after its buffer is destroyed.
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
    /// Pipeline cache for every pipeline that geodisk creates, or null. Vulkan synchronizes access
    /// to it, unless it was created as externally synchronized.
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE;
    /// True if VK_EXT_memory_budget is enabled. Runner then uses only memory that is free.
    bool memory_budget = false;
    /// True if VK_EXT_debug_utils is enabled on the instance. Pipelines and the buffers of Runner
    /// then have names, and recorded commands have a label per stage.
    bool debug_utils = false;
    /// Allocator for the buffers of Runner and FrameSampler, or null. Must outlive their objects.
    const MemoryHooks* memory_hooks = nullptr;
    /// True if VK_KHR_pipeline_executable_properties is enabled, with its feature. The driver then
    /// keeps the statistics that Sampler::report_kernels returns.
    bool pipeline_statistics = false;
    /// Callbacks passed to each create and destroy call, or null. Must outlive the objects as well.
    const VkAllocationCallbacks* host_allocator = nullptr;
};

/// A queue lent to geodisk, of a family that supports compute.
///
/// Set `lock` and `unlock` if other threads submit to the same queue. They are called with
/// `lock_user` around each submission, on the thread that runs geodisk, never nested. They must not
/// throw. geodisk never waits for the whole queue or device.
struct QueueRef {
    VkQueue queue = VK_NULL_HANDLE;
    std::uint32_t family = 0;
    void* lock_user = nullptr;
    void (*lock)(void*) = nullptr;
    void (*unlock)(void*) = nullptr;
};

/// Limits of a device that geodisk requires or adapts to. Sizes are in bytes.
struct DeviceLimits {
    std::uint64_t max_storage_buffer_range = 0;
    std::uint64_t max_memory_allocation_size = 0;
    std::uint64_t min_storage_buffer_offset_alignment = 0;
    std::uint64_t min_texel_buffer_offset_alignment = 0;
    std::uint64_t min_uniform_buffer_offset_alignment = 0;
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

/// Properties of a physical device, and whether geodisk can use it.
struct DeviceReport {
    std::string name;
    std::string driver_name; ///< Empty if the driver does not report it.
    std::string driver_info; ///< Empty if the driver does not report it.
    VkDriverId driver_id{};  ///< Zero if the driver does not report it.
    VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
    std::uint32_t api_version = 0; ///< Version of the device; that of the instance may be lower.
    std::uint32_t driver_version = 0;
    std::uint32_t vendor_id = 0;
    std::uint32_t device_id = 0;
    std::array<std::uint8_t, VK_UUID_SIZE> uuid{}; ///< Zero below Vulkan 1.1.
    DeviceLimits limits;
    std::uint64_t largest_device_local_heap = 0;
    /// Recommended family for the compute queue. Has no graphics if possible, so that long
    /// dispatches do not delay a display.
    std::optional<std::uint32_t> compute_queue_family;
    /// Timestamp bits of compute_queue_family; 0 if it has no timestamps.
    std::uint32_t timestamp_valid_bits = 0;
    /// First family with graphics and compute, for programs that draw with the same queue.
    std::optional<std::uint32_t> graphics_queue_family;
    /// True if division and square root are known to be correctly rounded, as on the host. Vulkan
    /// promises less, so this is true only for drivers known to do better (llvmpipe).
    bool rounds_natively = false;
    /// Every unmet requirement, one line each; empty for a device that can run geodisk.
    std::vector<std::string> reasons_against;

    /// Returns true if geodisk can run on the device.
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
