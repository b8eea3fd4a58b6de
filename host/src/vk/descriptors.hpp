// Descriptor pools and sets.
#pragma once

#include <cstdint>
#include <span>

#include <vulkan/vulkan_core.h>

#include <geodisk/device.hpp>
#include <geodisk/status.hpp>

#include "vk/dispatch.hpp"

namespace geodisk {

/// Creates a pool for this many sets; it is null after an error. Errors: those of Vulkan.
Result<Done> create_descriptor_pool(const DeviceRefs& device, const DeviceTable& vk,
                                    std::span<const VkDescriptorPoolSize> sizes, std::uint32_t sets,
                                    VkDescriptorPool& pool);

/// Allocates one set per layout.
Result<Done> allocate_descriptor_sets(const DeviceRefs& device, const DeviceTable& vk,
                                      VkDescriptorPool pool,
                                      std::span<const VkDescriptorSetLayout> layouts,
                                      std::span<VkDescriptorSet> sets);

/// Binds a range as a buffer of this type, or `view` if that is a texel buffer.
void write_buffer(const DeviceRefs& device, const DeviceTable& vk, VkDescriptorSet set,
                  std::uint32_t binding, VkDescriptorType type, const VkDescriptorBufferInfo& range,
                  const VkBufferView& view = VK_NULL_HANDLE);

} // namespace geodisk
