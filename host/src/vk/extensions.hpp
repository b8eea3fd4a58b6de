// Looks up extensions by name.
#pragma once

#include <span>
#include <string_view>

#include <vulkan/vulkan_core.h>

#include <geodisk/export.hpp>
#include <geodisk/status.hpp>

#include "vk/dispatch.hpp"

namespace geodisk {

GEODISK_API bool contains_extension(std::span<const VkExtensionProperties> extensions,
                                    std::string_view name) noexcept;

/// Returns true if the device offers the extension `name`. May throw std::bad_alloc.
GEODISK_API Result<bool> has_device_extension(const InstanceTable& vk,
                                              VkPhysicalDevice physical_device,
                                              std::string_view name);

} // namespace geodisk
