// Descriptor pools and sets.
#pragma once

#include <cstdint>
#include <span>

#include <vulkan/vulkan_core.h>

#include <geodisk/device.hpp>
#include <geodisk/status.hpp>

#include "vk/dispatch.hpp"

namespace geodisk {

/// For so many sets; null after an error, which is as Vulkan fails.
Result<Done> create_descriptor_pool(const DeviceRefs& device, const DeviceTable& vk,
                                    std::span<const VkDescriptorPoolSize> sizes, std::uint32_t sets,
                                    VkDescriptorPool& pool);

/// A set of each layout.
Result<Done> allocate_descriptor_sets(const DeviceRefs& device, const DeviceTable& vk,
                                      VkDescriptorPool pool,
                                      std::span<const VkDescriptorSetLayout> layouts,
                                      std::span<VkDescriptorSet> sets);

/// Binds a range as a storage buffer.
void write_storage_buffer(const DeviceRefs& device, const DeviceTable& vk, VkDescriptorSet set,
                          std::uint32_t binding, const VkDescriptorBufferInfo& range);

} // namespace geodisk
