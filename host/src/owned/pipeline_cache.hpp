// The pipeline cache of a Context, and the file that keeps it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <vulkan/vulkan_core.h>

#include "owned/pipeline_file.hpp"

namespace geodisk {

/// Owns a VkPipelineCache. Must be closed before the device is destroyed.
class PipelineCache {
  public:
    PipelineCache() = default;
    PipelineCache(const PipelineCache&) = delete;
    PipelineCache& operator=(const PipelineCache&) = delete;

    /// Creates the cache with the contents of `file`. Leaves the handle null if the driver cannot.
    void open(VkDevice device, PFN_vkGetDeviceProcAddr get_device_proc_addr, PipelineFile file);

    VkPipelineCache handle() const noexcept { return handle_; }

    /// Writes the file if the contents have changed, and destroys the cache.
    void close() noexcept;

  private:
    void write_file() const;

    VkDevice device_ = VK_NULL_HANDLE;
    VkPipelineCache handle_ = VK_NULL_HANDLE;
    PFN_vkGetPipelineCacheData get_data_ = nullptr;
    PFN_vkDestroyPipelineCache destroy_ = nullptr;
    std::optional<PipelineFile> file_;
    std::vector<std::byte> loaded_; ///< Contents of the file.
};

} // namespace geodisk
