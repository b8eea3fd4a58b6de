// Tables of Vulkan functions, one per instance and one per device, filled through the caller's
// function pointer. The library calls Vulkan only through these tables: there are no linked
// prototypes and no globals. They are plain structs, so that a test may replace single entries, for
// example by one that fails at its third call.
#pragma once

#include <vulkan/vulkan_core.h>

#include <geodisk/device.hpp>
#include <geodisk/export.hpp>
#include <geodisk/status.hpp>

// clang-format off
#define GEODISK_INSTANCE_FUNCTIONS(X)            \
    X(vkEnumerateDeviceExtensionProperties)      \
    X(vkGetPhysicalDeviceProperties)             \
    X(vkGetPhysicalDeviceProperties2)            \
    X(vkGetPhysicalDeviceMemoryProperties)       \
    X(vkGetPhysicalDeviceQueueFamilyProperties)

// Functions that Context needs to create a device.
#define GEODISK_OWNER_FUNCTIONS(X)               \
    X(vkDestroyInstance)                         \
    X(vkEnumeratePhysicalDevices)                \
    X(vkCreateDevice)                            \
    X(vkGetDeviceProcAddr)

// Only core Vulkan 1.0 and 1.1, so that each function exists on every device geodisk accepts. There
// is no vkDeviceWaitIdle or vkQueueWaitIdle: a borrowed device may be busy with other work.
#define GEODISK_DEVICE_FUNCTIONS(X)       \
    X(vkQueueSubmit)                      \
                                          \
    X(vkAllocateMemory)                   \
    X(vkFreeMemory)                       \
    X(vkMapMemory)                        \
    X(vkCreateBuffer)                     \
    X(vkDestroyBuffer)                    \
    X(vkCreateBufferView)                 \
    X(vkDestroyBufferView)                \
    X(vkGetBufferMemoryRequirements)      \
    X(vkBindBufferMemory)                 \
                                          \
    X(vkCreateShaderModule)               \
    X(vkDestroyShaderModule)              \
    X(vkCreatePipelineLayout)             \
    X(vkDestroyPipelineLayout)            \
    X(vkCreateComputePipelines)           \
    X(vkDestroyPipeline)                  \
                                          \
    X(vkCreateDescriptorSetLayout)        \
    X(vkDestroyDescriptorSetLayout)       \
    X(vkCreateDescriptorPool)             \
    X(vkDestroyDescriptorPool)            \
    X(vkAllocateDescriptorSets)           \
    X(vkUpdateDescriptorSets)             \
                                          \
    X(vkCreateCommandPool)                \
    X(vkDestroyCommandPool)               \
    X(vkResetCommandPool)                 \
    X(vkAllocateCommandBuffers)           \
    X(vkBeginCommandBuffer)               \
    X(vkEndCommandBuffer)                 \
                                          \
    X(vkCmdBindPipeline)                  \
    X(vkCmdBindDescriptorSets)            \
    X(vkCmdPushConstants)                 \
    X(vkCmdDispatch)                      \
    X(vkCmdDispatchIndirect)              \
    X(vkCmdFillBuffer)                    \
    X(vkCmdCopyBuffer)                    \
    X(vkCmdUpdateBuffer)                  \
    X(vkCmdPipelineBarrier)               \
                                          \
    X(vkCreateFence)                      \
    X(vkDestroyFence)                     \
    X(vkResetFences)                      \
    X(vkWaitForFences)

// Functions for RunnerOptions::time_stages.
#define GEODISK_QUERY_FUNCTIONS(X)        \
    X(vkCreateQueryPool)                  \
    X(vkDestroyQueryPool)                 \
    X(vkGetQueryPoolResults)              \
    X(vkCmdResetQueryPool)                \
    X(vkCmdWriteTimestamp)

// Functions of VK_EXT_debug_utils; null unless DeviceRefs::debug_utils.
#define GEODISK_DEBUG_FUNCTIONS(X)        \
    X(vkSetDebugUtilsObjectNameEXT)       \
    X(vkCmdBeginDebugUtilsLabelEXT)       \
    X(vkCmdEndDebugUtilsLabelEXT)
// clang-format on

namespace geodisk {

#define GEODISK_MEMBER(name) PFN_##name name = nullptr;

/// Functions of an instance and its physical devices. Members have the names of the functions.
struct InstanceTable {
    GEODISK_INSTANCE_FUNCTIONS(GEODISK_MEMBER)
};

/// Further functions of an instance that geodisk owns.
struct OwnerTable {
    GEODISK_OWNER_FUNCTIONS(GEODISK_MEMBER)
};

/// Functions of one device, without the loader's trampolines. Members have the names of the
/// functions.
struct DeviceTable {
    GEODISK_DEVICE_FUNCTIONS(GEODISK_MEMBER)
    GEODISK_DEBUG_FUNCTIONS(GEODISK_MEMBER)
};

struct QueryTable {
    GEODISK_QUERY_FUNCTIONS(GEODISK_MEMBER)
};

#undef GEODISK_MEMBER

/// Fills the table of `instance`. Errors: `invalid_argument` for a null argument, `device_lacks`
/// naming the first function that is missing.
GEODISK_API Result<InstanceTable>
load_instance_table(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance) noexcept;

/// Fills the table of further functions. Errors: those of load_instance_table().
GEODISK_API Result<OwnerTable> load_owner_table(PFN_vkGetInstanceProcAddr get_instance_proc_addr,
                                                VkInstance instance) noexcept;

/// Fills the table of `refs.device`. Errors: `invalid_argument` naming the handle, or function of
/// DeviceRefs::memory_hooks, that is null, `device_lacks` for an API version below 1.1 or naming
/// the first function that is missing.
GEODISK_API Result<DeviceTable> load_device_table(const DeviceRefs& refs) noexcept;

/// Fills the table of query functions. Errors: those of load_device_table().
GEODISK_API Result<QueryTable> load_query_table(const DeviceRefs& refs) noexcept;

} // namespace geodisk
