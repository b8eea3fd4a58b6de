#include "vk/result.hpp"

#include <string>

namespace geodisk {

const char* to_string(VkResult result) noexcept {
    switch (result) {
#define GEODISK_CASE(name)                                                                         \
    case name:                                                                                     \
        return #name;
        GEODISK_CASE(VK_SUCCESS)
        GEODISK_CASE(VK_NOT_READY)
        GEODISK_CASE(VK_TIMEOUT)
        GEODISK_CASE(VK_INCOMPLETE)
        GEODISK_CASE(VK_ERROR_OUT_OF_HOST_MEMORY)
        GEODISK_CASE(VK_ERROR_OUT_OF_DEVICE_MEMORY)
        GEODISK_CASE(VK_ERROR_INITIALIZATION_FAILED)
        GEODISK_CASE(VK_ERROR_DEVICE_LOST)
        GEODISK_CASE(VK_ERROR_MEMORY_MAP_FAILED)
        GEODISK_CASE(VK_ERROR_LAYER_NOT_PRESENT)
        GEODISK_CASE(VK_ERROR_EXTENSION_NOT_PRESENT)
        GEODISK_CASE(VK_ERROR_FEATURE_NOT_PRESENT)
        GEODISK_CASE(VK_ERROR_INCOMPATIBLE_DRIVER)
        GEODISK_CASE(VK_ERROR_TOO_MANY_OBJECTS)
        GEODISK_CASE(VK_ERROR_FRAGMENTED_POOL)
        GEODISK_CASE(VK_ERROR_UNKNOWN)
        GEODISK_CASE(VK_ERROR_OUT_OF_POOL_MEMORY)
        GEODISK_CASE(VK_ERROR_INVALID_SHADER_NV)
#undef GEODISK_CASE
    default:
        return "an unknown VkResult";
    }
}

Status status_of(VkResult result) noexcept {
    switch (result) {
    case VK_SUCCESS:
        return Status::ok;
    case VK_ERROR_OUT_OF_HOST_MEMORY:
        return Status::out_of_host_memory;
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_MEMORY_MAP_FAILED: // Mapping fails without enough contiguous address space.
    case VK_ERROR_TOO_MANY_OBJECTS:  // vkAllocateMemory: too many allocations for the driver.
    case VK_ERROR_FRAGMENTED_POOL:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
        return Status::out_of_device_memory;
    case VK_ERROR_DEVICE_LOST:
        return Status::device_lost;
    case VK_ERROR_LAYER_NOT_PRESENT:
    case VK_ERROR_EXTENSION_NOT_PRESENT:
    case VK_ERROR_FEATURE_NOT_PRESENT:
        return Status::device_lacks;
    case VK_ERROR_INCOMPATIBLE_DRIVER:
        return Status::no_device;
    default:
        return Status::internal;
    }
}

Error vk_error(std::string_view call, VkResult result) {
    std::string message(call);
    message += " failed with ";
    message += to_string(result);
    return Error{status_of(result), std::move(message), kNoElement, result};
}

} // namespace geodisk
