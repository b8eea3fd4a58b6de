#include "vk/buffer.hpp"

#include <optional>
#include <string>
#include <utility>

#include "vk/result.hpp"

namespace geodisk {
namespace {

std::optional<std::uint32_t> find_type(const VkPhysicalDeviceMemoryProperties& memory,
                                       std::uint32_t allowed, VkMemoryPropertyFlags flags) {
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        if ((allowed & 1u << i) != 0 && (memory.memoryTypes[i].propertyFlags & flags) == flags) {
            return i;
        }
    }
    return std::nullopt;
}

std::optional<std::uint32_t> choose_type(const VkPhysicalDeviceMemoryProperties& memory,
                                         std::uint32_t allowed, MemoryKind kind) {
    constexpr VkMemoryPropertyFlags kMapped =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    if (kind == MemoryKind::host) {
        // Cached memory reads back many times faster where the device is not the host.
        const auto cached =
            find_type(memory, allowed, kMapped | VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
        return cached ? cached : find_type(memory, allowed, kMapped);
    }
    const auto local = find_type(memory, allowed, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    return local ? local : find_type(memory, allowed, 0);
}

} // namespace

Result<DeviceBuffer> DeviceBuffer::create(const DeviceRefs& device, const DeviceTable& vk,
                                          const VkPhysicalDeviceMemoryProperties& memory,
                                          VkDeviceSize bytes, VkBufferUsageFlags usage,
                                          MemoryKind kind) {
    DeviceBuffer result;
    result.device_ = &device;
    result.vk_ = &vk;
    result.size_ = bytes;
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = bytes;
    info.usage = usage;
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    VkResult status = null_unless_success(
        vk.vkCreateBuffer(device.device, &info, device.host_allocator, &result.buffer_),
        result.buffer_);
    if (status != VK_SUCCESS) {
        return vk_error("vkCreateBuffer", status);
    }
    VkMemoryRequirements requirements{};
    vk.vkGetBufferMemoryRequirements(device.device, result.buffer_, &requirements);
    const auto type = choose_type(memory, requirements.memoryTypeBits, kind);
    if (!type) {
        return Error{Status::device_lacks, "the device has no memory type for a storage buffer"};
    }
    VkMemoryAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocate.allocationSize = requirements.size;
    allocate.memoryTypeIndex = *type;
    status = null_unless_success(
        vk.vkAllocateMemory(device.device, &allocate, device.host_allocator, &result.memory_),
        result.memory_);
    if (status != VK_SUCCESS) {
        Error error = vk_error("vkAllocateMemory", status);
        error.message += " (" + std::to_string(requirements.size) + " bytes)";
        return error;
    }
    status = vk.vkBindBufferMemory(device.device, result.buffer_, result.memory_, 0);
    if (status != VK_SUCCESS) {
        return vk_error("vkBindBufferMemory", status);
    }
    if (kind == MemoryKind::host) {
        void* mapped = nullptr;
        status = vk.vkMapMemory(device.device, result.memory_, 0, VK_WHOLE_SIZE, 0, &mapped);
        if (status != VK_SUCCESS) {
            return vk_error("vkMapMemory", status);
        }
        result.mapped_ = {static_cast<std::byte*>(mapped), static_cast<std::size_t>(bytes)};
    }
    return result;
}

DeviceBuffer::DeviceBuffer(DeviceBuffer&& other) noexcept {
    *this = std::move(other);
}

DeviceBuffer& DeviceBuffer::operator=(DeviceBuffer&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(vk_, other.vk_);
    std::swap(buffer_, other.buffer_);
    std::swap(memory_, other.memory_);
    std::swap(size_, other.size_);
    std::swap(mapped_, other.mapped_);
    return *this;
}

DeviceBuffer::~DeviceBuffer() {
    if (vk_ != nullptr) {
        vk_->vkDestroyBuffer(device_->device, buffer_, device_->host_allocator);
        vk_->vkFreeMemory(device_->device, memory_, device_->host_allocator);
    }
}

} // namespace geodisk
