// VkResult in words and as Status.
#pragma once

#include <string_view>

#include <vulkan/vulkan_core.h>

#include <geodisk/export.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Name of a result as in the specification, or "an unknown VkResult".
GEODISK_API const char* to_string(VkResult result) noexcept;

/// The status a failed Vulkan call amounts to; `internal` for what geodisk should have prevented.
GEODISK_API Status status_of(VkResult result) noexcept;

/// The Error for `call` (a function name) having returned `result`. May throw std::bad_alloc.
GEODISK_API Error vk_error(std::string_view call, VkResult result);

/// Passes on the result of a call that was to fill in `handle`. A call that failed may have left
/// anything there, which must not be destroyed.
template <class Handle>
VkResult null_unless_success(VkResult result, Handle& handle) noexcept {
    if (result != VK_SUCCESS) {
        handle = VK_NULL_HANDLE;
    }
    return result;
}

} // namespace geodisk
