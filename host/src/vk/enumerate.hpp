// Vulkan's two-call idiom: query the count, then the elements.
#pragma once

#include <cstdint>
#include <vector>

#include <vulkan/vulkan_core.h>

namespace geodisk {

/// Fills `out` from `call(std::uint32_t* count, T* elements) -> VkResult`; elements are initialized
/// to `blank`. Returns the first result that is not success. May throw std::bad_alloc.
template <class T, class Call>
VkResult enumerate(std::vector<T>& out, Call&& call, const T& blank = T{}) {
    VkResult result = VK_INCOMPLETE;
    while (result == VK_INCOMPLETE) { // The list may have grown between the two calls.
        std::uint32_t count = 0;
        result = call(&count, static_cast<T*>(nullptr));
        if (result != VK_SUCCESS)
            break;
        out.assign(count, blank);
        result = call(&count, out.data());
        out.resize(count);
    }
    return result;
}

} // namespace geodisk
