// Buffers of what an engine records over several frames, and what is uploaded into them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <geodisk/domain.hpp>
#include <geodisk/sampler.hpp>

#include "vk/buffer.hpp"

namespace geodisk {

/// Allocates a buffer on the sampler's device.
Result<DeviceBuffer> make_frame_buffer(const Sampler& sampler, VkDeviceSize bytes,
                                       VkBufferUsageFlags usage, MemoryKind kind);

/// Uploads into one buffer, by staging memory of their own. Movable.
class FrameUploads {
  public:
    /// Allocates memory for all uploads of a domain, and so many bytes more.
    static Result<FrameUploads> create(const Sampler& sampler, const Domain& domain,
                                       VkDeviceSize more);

    /// Stages those of the domain, for buffers laid out so, but for the one that is left out.
    Result<Done> stage_domain(const Sampler& sampler, const Domain& domain, const RunPlan& plan,
                              const WorkspaceLayout& layout,
                              std::optional<BufferRole> left_out = std::nullopt);
    /// Stages bytes for this offset of the buffer.
    void stage(VkDeviceSize to, std::span<const std::byte> bytes);

    /// Records all, once.
    void record(const DeviceTable& vk, VkCommandBuffer commands, VkBuffer to);
    /// Frees the staging memory, after the uploads have completed.
    void free() { staging_ = DeviceBuffer(); }

  private:
    struct Upload {
        VkDeviceSize from, to, bytes; ///< Offsets in the staging memory and in the buffer.
    };

    /// Returns staging memory for the next upload.
    std::span<std::byte> take(VkDeviceSize to, VkDeviceSize bytes);

    DeviceBuffer staging_;
    std::vector<Upload> uploads_;
    VkDeviceSize used_ = 0;
};

} // namespace geodisk
