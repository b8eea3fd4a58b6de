// Parts that the engine has anyway: a device with one queue, a block of memory of each kind, and
// frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include <vulkan/vulkan.h>

#include <geodisk/device.hpp>
#include <geodisk/sampler.hpp>

namespace engine {

/// Throws std::runtime_error naming the call.
void check(VkResult result, const char* call);

/// The value, or a std::runtime_error with the error's message.
template <class T>
T take(geodisk::Result<T> result) {
    if (!result) {
        throw std::runtime_error(result.error().message);
    }
    return std::move(*result);
}

/// The first device that geodisk can use, with a queue for graphics and compute.
class Gpu {
  public:
    /// With the validation layer, synchronization validation included, if asked for.
    explicit Gpu(bool validate);
    Gpu(const Gpu&) = delete;
    Gpu& operator=(const Gpu&) = delete;
    ~Gpu();

    VkDevice device() const { return device_; }
    VkQueue queue() const { return queue_; }
    std::uint32_t family() const { return family_; }
    const geodisk::DeviceReport& report() const { return report_; }
    /// The index of a memory type with these properties among those allowed.
    std::uint32_t memory_type(std::uint32_t allowed, VkMemoryPropertyFlags properties) const;
    /// Returns what geodisk borrows.
    geodisk::DeviceRefs refs() const;
    /// Messages of the validation layer.
    std::uint32_t complaints() const { return complaints_; }

  private:
    void choose_device();

    bool validate_;
    std::uint32_t complaints_ = 0;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device_ = VK_NULL_HANDLE;
    std::uint32_t family_ = 0;
    geodisk::DeviceReport report_;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
};

/// One buffer in one allocation, cut from its front.
class Block {
  public:
    Block(const Gpu& gpu, VkDeviceSize bytes, VkBufferUsageFlags usage,
          VkMemoryPropertyFlags properties);
    Block(const Block&) = delete;
    Block& operator=(const Block&) = delete;
    ~Block();

    /// The next range; throws where there is no room.
    geodisk::BufferRange cut(VkDeviceSize bytes);
    /// Returns the bytes of a range of a mapped block.
    std::span<std::byte> bytes(const geodisk::BufferRange& range) const {
        return {mapped_ + range.offset, static_cast<std::size_t>(range.size)};
    }

  private:
    const Gpu& gpu_;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    std::byte* mapped_ = nullptr;
    VkDeviceSize size_ = 0, used_ = 0;
};

/// Two command buffers that take turns, so that one is recorded while the device works on the
/// other.
class Frames {
  public:
    static constexpr std::uint32_t kInFlight = 2;

    explicit Frames(const Gpu& gpu);
    Frames(const Frames&) = delete;
    Frames& operator=(const Frames&) = delete;
    ~Frames();

    /// Waits until the device is done with the frame that had this turn before.
    VkCommandBuffer begin();
    /// Returns which of the two has its turn.
    std::uint32_t turn() const { return turn_; }
    void submit();
    void wait_for_all() const;

  private:
    const Gpu& gpu_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_[kInFlight]{};
    VkFence fences_[kInFlight]{};
    std::uint32_t turn_ = 0;
};

void barrier(VkCommandBuffer commands, geodisk::SyncScope from, geodisk::SyncScope to);
void copy(VkCommandBuffer commands, const geodisk::BufferRange& from,
          const geodisk::BufferRange& to, VkDeviceSize bytes, VkDeviceSize to_offset = 0);

} // namespace engine
