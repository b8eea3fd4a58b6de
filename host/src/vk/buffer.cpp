#include "vk/buffer.hpp"

#include <optional>
#include <string>
#include <utility>

#include "support/try.hpp"
#include "vk/result.hpp"

namespace geodisk {
namespace {

constexpr VkMemoryPropertyFlags kMapped =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

Error allocation_error(const char* function, VkResult status,
                       const VkMemoryRequirements& requirements) {
    Error error = vk_error(function, status);
    error.message += " (" + std::to_string(requirements.size) + " bytes)";
    return error;
}

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
    if (kind == MemoryKind::host) {
        // Host reads of cached memory are many times faster on a discrete device.
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
    auto allocated = device.memory_hooks != nullptr
                         ? result.ask_for_memory(requirements, kind)
                         : result.allocate_memory(memory, requirements, kind);
    GEODISK_TRY(allocated);
    status = vk.vkBindBufferMemory(device.device, result.buffer_, result.grant_.memory,
                                   result.grant_.offset);
    if (status != VK_SUCCESS) {
        return vk_error("vkBindBufferMemory", status);
    }
    if (kind == MemoryKind::host) {
        result.mapped_ = {static_cast<std::byte*>(result.grant_.mapped),
                          static_cast<std::size_t>(bytes)};
    }
    return result;
}

Result<Done> DeviceBuffer::allocate_memory(const VkPhysicalDeviceMemoryProperties& memory,
                                           const VkMemoryRequirements& requirements,
                                           MemoryKind kind) {
    const auto type = choose_type(memory, requirements.memoryTypeBits, kind);
    if (!type) {
        return Error{Status::device_lacks, "the device has no memory type for a storage buffer"};
    }
    VkMemoryAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocate.allocationSize = requirements.size;
    allocate.memoryTypeIndex = *type;
    VkResult status = null_unless_success(
        vk_->vkAllocateMemory(device_->device, &allocate, device_->host_allocator, &grant_.memory),
        grant_.memory);
    if (status != VK_SUCCESS) {
        return allocation_error("vkAllocateMemory", status, requirements);
    }
    if (kind == MemoryKind::host) {
        status =
            vk_->vkMapMemory(device_->device, grant_.memory, 0, VK_WHOLE_SIZE, 0, &grant_.mapped);
        if (status != VK_SUCCESS) {
            return vk_error("vkMapMemory", status);
        }
    }
    return Done{};
}

Result<Done> DeviceBuffer::ask_for_memory(const VkMemoryRequirements& requirements,
                                          MemoryKind kind) {
    const MemoryHooks& hooks = *device_->memory_hooks;
    const bool is_host = kind == MemoryKind::host;
    const MemoryRequest request{
        buffer_, requirements, is_host ? kMapped : 0,
        static_cast<VkMemoryPropertyFlags>(is_host ? VK_MEMORY_PROPERTY_HOST_CACHED_BIT
                                                   : VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)};
    MemoryGrant grant;
    const VkResult status = hooks.allocate(hooks.user, request, grant);
    if (status != VK_SUCCESS) {
        return allocation_error("MemoryHooks::allocate", status, requirements);
    }
    grant_ = grant;
    if (grant.memory == VK_NULL_HANDLE || grant.offset % requirements.alignment != 0 ||
        (is_host && grant.mapped == nullptr)) {
        return Error{Status::invalid_argument,
                     "MemoryHooks::allocate gave memory that is null, off alignment, or not mapped "
                     "where it has to be"};
    }
    return Done{};
}

DeviceBuffer::DeviceBuffer(DeviceBuffer&& other) noexcept {
    *this = std::move(other);
}

DeviceBuffer& DeviceBuffer::operator=(DeviceBuffer&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(vk_, other.vk_);
    std::swap(buffer_, other.buffer_);
    std::swap(grant_, other.grant_);
    std::swap(size_, other.size_);
    std::swap(mapped_, other.mapped_);
    return *this;
}

DeviceBuffer::~DeviceBuffer() {
    if (vk_ != nullptr) {
        vk_->vkDestroyBuffer(device_->device, buffer_, device_->host_allocator);
        if (device_->memory_hooks == nullptr) {
            vk_->vkFreeMemory(device_->device, grant_.memory, device_->host_allocator);
        } else if (grant_.memory != VK_NULL_HANDLE) {
            device_->memory_hooks->free(device_->memory_hooks->user, grant_);
        }
    }
}

} // namespace geodisk
