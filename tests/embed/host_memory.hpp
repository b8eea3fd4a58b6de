// VkAllocationCallbacks that count, and notice what is freed wrongly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <unordered_map>

#include <vulkan/vulkan_core.h>

namespace geodisk::test {

/// Must outlive everything made with its callbacks. May be called from several threads.
class HostMemory {
  public:
    HostMemory();
    HostMemory(const HostMemory&) = delete;
    HostMemory& operator=(const HostMemory&) = delete;

    const VkAllocationCallbacks* callbacks() const { return &callbacks_; }
    std::uint64_t allocations() const { return allocations_; }
    std::uint64_t live() const { return sizes_.size(); }
    /// Blocks freed or resized that were not allocated here.
    std::uint64_t misuses() const { return misuses_; }

  private:
    void* allocate(std::size_t size, std::size_t alignment);
    void* reallocate(void* block, std::size_t size, std::size_t alignment);
    void free(void* block);

    VkAllocationCallbacks callbacks_{};
    std::mutex mutex_;
    std::unordered_map<void*, std::size_t> sizes_;
    std::uint64_t allocations_ = 0;
    std::uint64_t misuses_ = 0;
};

} // namespace geodisk::test
