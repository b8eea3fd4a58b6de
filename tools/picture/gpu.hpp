// Drawing on a lent device: its functions, objects that destroy themselves, and waiting.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <vulkan/vulkan_core.h>

#include <geodisk/device.hpp>

namespace geodisk::tools::picture {

// clang-format off
#define GEODISK_PICTURE_DEVICE_FUNCTIONS(X)                                          \
    X(vkAllocateMemory) X(vkFreeMemory) X(vkMapMemory)                               \
    X(vkCreateBuffer) X(vkDestroyBuffer) X(vkGetBufferMemoryRequirements)            \
    X(vkBindBufferMemory)                                                            \
    X(vkCreateImage) X(vkDestroyImage) X(vkGetImageMemoryRequirements)               \
    X(vkBindImageMemory) X(vkCreateImageView) X(vkDestroyImageView)                  \
    X(vkCreateRenderPass) X(vkDestroyRenderPass)                                     \
    X(vkCreateFramebuffer) X(vkDestroyFramebuffer)                                   \
    X(vkCreateShaderModule) X(vkDestroyShaderModule)                                 \
    X(vkCreateDescriptorSetLayout) X(vkDestroyDescriptorSetLayout)                   \
    X(vkCreateDescriptorPool) X(vkDestroyDescriptorPool)                             \
    X(vkAllocateDescriptorSets) X(vkUpdateDescriptorSets)                            \
    X(vkCreatePipelineLayout) X(vkDestroyPipelineLayout)                             \
    X(vkCreateGraphicsPipelines) X(vkDestroyPipeline)                                \
    X(vkCreateCommandPool) X(vkDestroyCommandPool) X(vkResetCommandPool)             \
    X(vkAllocateCommandBuffers) X(vkBeginCommandBuffer) X(vkEndCommandBuffer)        \
    X(vkCreateFence) X(vkDestroyFence) X(vkResetFences) X(vkWaitForFences)           \
    X(vkQueueSubmit)                                                                 \
    X(vkCmdPipelineBarrier) X(vkCmdCopyBuffer) X(vkCmdCopyImageToBuffer)             \
    X(vkCmdBeginRenderPass) X(vkCmdEndRenderPass) X(vkCmdBindPipeline)               \
    X(vkCmdBindDescriptorSets) X(vkCmdPushConstants) X(vkCmdSetViewport)             \
    X(vkCmdSetScissor) X(vkCmdDraw)
// clang-format on

struct Functions {
#define GEODISK_PICTURE_MEMBER(name) PFN_##name name = nullptr;
    GEODISK_PICTURE_DEVICE_FUNCTIONS(GEODISK_PICTURE_MEMBER)
#undef GEODISK_PICTURE_MEMBER
};

/// Zero but for its type.
template <class T>
T structure(VkStructureType type) {
    T result{};
    result.sType = type;
    return result;
}

/// Throws UserError for a failed call: `out_of_memory`, or `internal`.
void check(VkResult result, const char* call);

class Gpu;

/// Owns an object of a device; kDestroy is the member of Functions that destroys it. A device that
/// was given up may use it for ever, and keeps it.
template <class T, auto kDestroy>
class Handle {
  public:
    Handle() = default;
    Handle(const Gpu& gpu, T value) : gpu_(&gpu), value_(value) {}
    Handle(Handle&& other) noexcept
        : gpu_(other.gpu_), value_(std::exchange(other.value_, T(VK_NULL_HANDLE))) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(gpu_, other.gpu_);
        std::swap(value_, other.value_);
        return *this;
    }
    ~Handle();
    T get() const { return value_; }

  private:
    const Gpu* gpu_ = nullptr;
    T value_ = VK_NULL_HANDLE;
};

/// A device and a queue for graphics, both lent; they must outlive the objects made here. Not
/// thread-safe.
class Gpu {
  public:
    /// A part of a picture takes far less, even on a CPU.
    static constexpr std::chrono::minutes kStallLimit{2};

    /// Throws UserError, like all that follow.
    Gpu(const DeviceRefs& device, const QueueRef& queue,
        std::chrono::nanoseconds stall_limit = kStallLimit);
    Gpu(const Gpu&) = delete;
    Gpu& operator=(const Gpu&) = delete;

    VkDevice device() const { return device_; }
    const Functions& vk() const { return vk_; }
    const VkPhysicalDeviceLimits& limits() const { return limits_; }
    VkFormat depth_format() const { return depth_format_; }

    VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags required,
                            VkMemoryPropertyFlags preferred) const;

    /// Submits what `record` records and waits until it is done. Gives the device up where that
    /// takes longer than the stall limit: then each call fails.
    void run(const std::function<void(VkCommandBuffer)>& record) const;
    bool is_given_up() const { return is_given_up_; }

  private:
    void wait(VkFence fence) const;

    Functions vk_;
    VkDevice device_;
    QueueRef queue_;
    VkPhysicalDeviceLimits limits_{};
    VkFormat depth_format_ = VK_FORMAT_X8_D24_UNORM_PACK32;
    VkPhysicalDeviceMemoryProperties memory_{};
    std::chrono::nanoseconds stall_limit_;
    Handle<VkCommandPool, &Functions::vkDestroyCommandPool> pool_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    Handle<VkFence, &Functions::vkDestroyFence> fence_;
    mutable bool is_given_up_ = false;
};

template <class T, auto kDestroy>
Handle<T, kDestroy>::~Handle() {
    if (value_ != VK_NULL_HANDLE && !gpu_->is_given_up()) {
        (gpu_->vk().*kDestroy)(gpu_->device(), value_, nullptr);
    }
}

using Memory = Handle<VkDeviceMemory, &Functions::vkFreeMemory>;

/// A buffer with memory of its own, which the host sees if asked for.
class Buffer {
  public:
    Buffer() = default;
    Buffer(const Gpu& gpu, VkDeviceSize size, VkBufferUsageFlags usage, bool is_mapped);

    VkBuffer get() const { return buffer_.get(); }
    VkDeviceSize size() const { return size_; }
    std::span<std::byte> bytes() const { return {mapped_, static_cast<std::size_t>(size_)}; }

  private:
    Memory memory_; ///< Freed after the buffer is gone.
    Handle<VkBuffer, &Functions::vkDestroyBuffer> buffer_;
    VkDeviceSize size_ = 0;
    std::byte* mapped_ = nullptr;
};

/// A storage buffer on the device that holds `bytes`; of an empty span, something to bind.
Buffer make_storage(const Gpu& gpu, std::span<const std::byte> bytes);

/// A target to draw to.
class Image {
  public:
    Image() = default;
    Image(const Gpu& gpu, VkFormat format, VkExtent2D size, VkImageUsageFlags usage,
          VkImageAspectFlags aspect);

    VkImage get() const { return image_.get(); }
    VkImageView view() const { return view_.get(); }

  private:
    Memory memory_;
    Handle<VkImage, &Functions::vkDestroyImage> image_;
    Handle<VkImageView, &Functions::vkDestroyImageView> view_;
};

} // namespace geodisk::tools::picture
