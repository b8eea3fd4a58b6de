// DeviceBuffer: a buffer with its own memory.
#pragma once

#include <cstddef>
#include <span>

#include <geodisk/device.hpp>

#include "vk/dispatch.hpp"

namespace geodisk {

enum class MemoryKind {
    device, ///< Fast for the device; maybe not host-visible.
    host,   ///< Mapped and coherent.
};

/// Owns a VkBuffer and its memory; movable. `device` and `vk` must outlive it.
class DeviceBuffer {
  public:
    /// Creates a buffer. Errors: `out_of_device_memory` naming the bytes; those of Vulkan.
    static Result<DeviceBuffer> create(const DeviceRefs& device, const DeviceTable& vk,
                                       const VkPhysicalDeviceMemoryProperties& memory,
                                       VkDeviceSize bytes, VkBufferUsageFlags usage,
                                       MemoryKind kind);
    DeviceBuffer() = default;
    DeviceBuffer(DeviceBuffer&& other) noexcept;
    DeviceBuffer& operator=(DeviceBuffer&& other) noexcept;
    ~DeviceBuffer();

    /// Gives up the buffer without destroying it: the device may still be using it.
    void abandon() noexcept { vk_ = nullptr; }

    VkBuffer handle() const noexcept { return buffer_; }
    VkDeviceSize size() const noexcept { return size_; }
    /// Returns the mapped bytes of a host buffer.
    std::span<std::byte> bytes() const noexcept { return mapped_; }

  private:
    Result<Done> allocate_memory(const VkPhysicalDeviceMemoryProperties& memory,
                                 const VkMemoryRequirements& requirements, MemoryKind kind);
    Result<Done> ask_for_memory(const VkMemoryRequirements& requirements, MemoryKind kind);

    const DeviceRefs* device_ = nullptr;
    const DeviceTable* vk_ = nullptr;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    MemoryGrant grant_;
    VkDeviceSize size_ = 0;
    std::span<std::byte> mapped_;
};

} // namespace geodisk
