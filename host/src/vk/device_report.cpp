#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <geodisk/device.hpp>

#include "support/guard.hpp"
#include "vk/dispatch.hpp"
#include "vk/extensions.hpp"

namespace geodisk {
namespace {

// Limits that every kernel relies on. They are at most the guaranteed minima of Vulkan 1.1, except
// for the storage buffers per stage, of which the specification guarantees four.
constexpr std::uint64_t kNeededStorageBufferRange = std::uint64_t{1} << 27;
constexpr std::uint64_t kNeededStorageBuffersPerStage = 8;
constexpr std::uint64_t kNeededWorkgroupSize = 128;
constexpr std::uint64_t kNeededPushConstantsSize = 128;
constexpr std::uint64_t kNeededSharedMemorySize = 16'384;

/// Returns the string of a fixed-size field, which a faulty driver may have left without its
/// terminator.
template <std::size_t kSize>
std::string text_of(const char (&field)[kSize]) {
    return std::string(field, std::find(field, field + kSize, '\0'));
}

void read_properties(const VkPhysicalDeviceProperties& properties, DeviceReport& report) {
    report.name = text_of(properties.deviceName);
    report.type = properties.deviceType;
    report.api_version = properties.apiVersion;
    report.driver_version = properties.driverVersion;
    report.vendor_id = properties.vendorID;
    report.device_id = properties.deviceID;

    const VkPhysicalDeviceLimits& from = properties.limits;
    DeviceLimits& to = report.limits;
    to.max_storage_buffer_range = from.maxStorageBufferRange;
    to.min_storage_buffer_offset_alignment = from.minStorageBufferOffsetAlignment;
    to.min_texel_buffer_offset_alignment = from.minTexelBufferOffsetAlignment;
    to.min_uniform_buffer_offset_alignment = from.minUniformBufferOffsetAlignment;
    to.max_texel_buffer_elements = from.maxTexelBufferElements;
    to.non_coherent_atom_size = from.nonCoherentAtomSize;
    to.max_memory_allocation_count = from.maxMemoryAllocationCount;
    to.max_storage_buffers_per_stage = from.maxPerStageDescriptorStorageBuffers;
    to.max_workgroup_invocations = from.maxComputeWorkGroupInvocations;
    to.max_workgroup_size_x = from.maxComputeWorkGroupSize[0];
    to.max_workgroup_count_x = from.maxComputeWorkGroupCount[0];
    to.max_shared_memory_size = from.maxComputeSharedMemorySize;
    to.max_push_constants_size = from.maxPushConstantsSize;
    to.timestamp_period = from.timestampPeriod;
}

/// Reads properties that only Vulkan 1.1 devices have.
Result<Done> read_properties2(const InstanceTable& vk, VkPhysicalDevice physical_device,
                              DeviceReport& report) {
    const Result<bool> has_driver_properties =
        has_device_extension(vk, physical_device, VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME);
    if (!has_driver_properties)
        return has_driver_properties.error();

    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    VkPhysicalDeviceIDProperties id{};
    id.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES;
    VkPhysicalDeviceSubgroupProperties subgroup{};
    subgroup.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
    subgroup.pNext = &id;
    VkPhysicalDeviceMaintenance3Properties maintenance3{};
    maintenance3.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
    maintenance3.pNext = &subgroup;
    if (*has_driver_properties || report.api_version >= VK_API_VERSION_1_2)
        id.pNext = &driver;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &maintenance3;
    vk.vkGetPhysicalDeviceProperties2(physical_device, &properties);

    report.driver_name = text_of(driver.driverName);
    report.driver_info = text_of(driver.driverInfo);
    report.driver_id = driver.driverID;
    report.rounds_natively = driver.driverID == VK_DRIVER_ID_MESA_LLVMPIPE;
    std::copy_n(id.deviceUUID, report.uuid.size(), report.uuid.begin());
    report.limits.subgroup_size = subgroup.subgroupSize;
    report.limits.max_memory_allocation_size = maintenance3.maxMemoryAllocationSize;
    return Done{};
}

void read_queue_families(const InstanceTable& vk, VkPhysicalDevice physical_device,
                         DeviceReport& report) {
    std::uint32_t count = 0;
    vk.vkGetPhysicalDeviceQueueFamilyProperties(physical_device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vk.vkGetPhysicalDeviceQueueFamilyProperties(physical_device, &count, families.data());

    bool chosen_has_graphics = false;
    for (std::uint32_t i = 0; i < count; ++i) {
        const VkQueueFamilyProperties& family = families[i];
        if (family.queueCount == 0 || (family.queueFlags & VK_QUEUE_COMPUTE_BIT) == 0)
            continue;
        const bool has_graphics = (family.queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0;
        if (has_graphics && !report.graphics_queue_family)
            report.graphics_queue_family = i;
        if (report.compute_queue_family && (has_graphics || !chosen_has_graphics))
            continue;
        report.compute_queue_family = i;
        report.timestamp_valid_bits = family.timestampValidBits;
        chosen_has_graphics = has_graphics;
    }
}

void read_memory(const InstanceTable& vk, VkPhysicalDevice physical_device, DeviceReport& report) {
    VkPhysicalDeviceMemoryProperties memory{};
    vk.vkGetPhysicalDeviceMemoryProperties(physical_device, &memory);
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
        const VkMemoryHeap& heap = memory.memoryHeaps[i];
        if ((heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0)
            report.largest_device_local_heap =
                std::max(report.largest_device_local_heap, std::uint64_t{heap.size});
    }
}

std::string version_text(std::uint32_t version) {
    return std::to_string(VK_API_VERSION_MAJOR(version)) + '.' +
           std::to_string(VK_API_VERSION_MINOR(version));
}

void check_requirements(DeviceReport& report) {
    const auto need = [&](const char* limit, std::uint64_t has, std::uint64_t needed) {
        if (has < needed)
            report.reasons_against.push_back(std::string(limit) + " is " + std::to_string(has) +
                                             ", at least " + std::to_string(needed) + " is needed");
    };
    if (report.api_version < VK_API_VERSION_1_1)
        report.reasons_against.push_back("apiVersion is " + version_text(report.api_version) +
                                         ", at least 1.1 is needed");
    if (!report.compute_queue_family)
        report.reasons_against.push_back("no queue family supports compute");
    const DeviceLimits& has = report.limits;
    need("maxPerStageDescriptorStorageBuffers", has.max_storage_buffers_per_stage,
         kNeededStorageBuffersPerStage);
    need("maxStorageBufferRange", has.max_storage_buffer_range, kNeededStorageBufferRange);
    need("maxComputeWorkGroupInvocations", has.max_workgroup_invocations, kNeededWorkgroupSize);
    need("maxComputeWorkGroupSize[0]", has.max_workgroup_size_x, kNeededWorkgroupSize);
    need("maxPushConstantsSize", has.max_push_constants_size, kNeededPushConstantsSize);
    need("maxComputeSharedMemorySize", has.max_shared_memory_size, kNeededSharedMemorySize);
}

} // namespace

Result<DeviceReport> query_device(PFN_vkGetInstanceProcAddr get_instance_proc_addr,
                                  VkInstance instance, VkPhysicalDevice physical_device) noexcept {
    return guarded([&]() -> Result<DeviceReport> {
        if (physical_device == VK_NULL_HANDLE)
            return Error{Status::invalid_argument, "physical_device is null"};
        const Result<InstanceTable> vk = load_instance_table(get_instance_proc_addr, instance);
        if (!vk)
            return vk.error();
        DeviceReport report;
        VkPhysicalDeviceProperties properties{};
        vk->vkGetPhysicalDeviceProperties(physical_device, &properties);
        read_properties(properties, report);
        if (report.api_version >= VK_API_VERSION_1_1) {
            const Result<Done> read = read_properties2(*vk, physical_device, report);
            if (!read)
                return read.error();
        }
        read_queue_families(*vk, physical_device, report);
        read_memory(*vk, physical_device, report);
        check_requirements(report);
        return report;
    });
}

} // namespace geodisk
