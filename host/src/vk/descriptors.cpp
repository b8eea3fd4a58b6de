#include "vk/descriptors.hpp"

#include "vk/result.hpp"

namespace geodisk {

Result<Done> create_descriptor_pool(const DeviceRefs& device, const DeviceTable& vk,
                                    std::span<const VkDescriptorPoolSize> sizes, std::uint32_t sets,
                                    VkDescriptorPool& pool) {
    VkDescriptorPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    info.maxSets = sets;
    info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    const VkResult result = null_unless_success(
        vk.vkCreateDescriptorPool(device.device, &info, device.host_allocator, &pool), pool);
    return result == VK_SUCCESS ? Result<Done>(Done{}) : vk_error("vkCreateDescriptorPool", result);
}

Result<Done> allocate_descriptor_sets(const DeviceRefs& device, const DeviceTable& vk,
                                      VkDescriptorPool pool,
                                      std::span<const VkDescriptorSetLayout> layouts,
                                      std::span<VkDescriptorSet> sets) {
    VkDescriptorSetAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorPool = pool;
    info.descriptorSetCount = static_cast<std::uint32_t>(layouts.size());
    info.pSetLayouts = layouts.data();
    const VkResult result = vk.vkAllocateDescriptorSets(device.device, &info, sets.data());
    return result == VK_SUCCESS ? Result<Done>(Done{})
                                : vk_error("vkAllocateDescriptorSets", result);
}

void write_buffer(const DeviceRefs& device, const DeviceTable& vk, VkDescriptorSet set,
                  std::uint32_t binding, VkDescriptorType type, const VkDescriptorBufferInfo& range,
                  const VkBufferView& view) {
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set;
    write.dstBinding = binding;
    write.descriptorCount = 1;
    write.descriptorType = type;
    write.pBufferInfo = &range;
    write.pTexelBufferView = &view;
    vk.vkUpdateDescriptorSets(device.device, 1, &write, 0, nullptr);
}

} // namespace geodisk
