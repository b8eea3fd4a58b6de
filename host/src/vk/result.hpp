// Converts VkResult to text and to Status.
#pragma once

#include <string_view>

#include <vulkan/vulkan_core.h>

#include <geodisk/export.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Returns the name of a result in the specification, or "an unknown VkResult".
GEODISK_API const char* to_string(VkResult result) noexcept;

/// Returns the status of a failed Vulkan call; `internal` for errors that geodisk should have
/// prevented.
GEODISK_API Status status_of(VkResult result) noexcept;

/// Returns the Error for function `call` that returned `result`. May throw std::bad_alloc.
GEODISK_API Error vk_error(std::string_view call, VkResult result);

/// Returns the result of a call that fills in `handle`. Resets the handle if the call failed, since
/// it may hold anything and must not be destroyed.
template <class Handle>
VkResult null_unless_success(VkResult result, Handle& handle) noexcept {
    if (result != VK_SUCCESS) {
        handle = VK_NULL_HANDLE;
    }
    return result;
}

} // namespace geodisk
