#include "vk/extensions.hpp"

#include <algorithm>

#include "vk/enumerate.hpp"
#include "vk/result.hpp"

namespace geodisk {

bool contains_extension(std::span<const VkExtensionProperties> extensions,
                        std::string_view name) noexcept {
    return std::any_of(extensions.begin(), extensions.end(), [&](const auto& extension) {
        return name == static_cast<const char*>(extension.extensionName);
    });
}

Result<bool> has_device_extension(const InstanceTable& vk, VkPhysicalDevice physical_device,
                                  std::string_view name) {
    std::vector<VkExtensionProperties> extensions;
    const VkResult result = enumerate(extensions, [&](auto* count, auto* elements) {
        return vk.vkEnumerateDeviceExtensionProperties(physical_device, nullptr, count, elements);
    });
    if (result != VK_SUCCESS)
        return vk_error("vkEnumerateDeviceExtensionProperties", result);
    return contains_extension(extensions, name);
}

} // namespace geodisk
