// Parts that a recording engine has: one large buffer that it cuts into ranges, buffers to upload
// and download through, command buffers, and other work in the same frame.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <geodisk/context.hpp>
#include <geodisk/sampler.hpp>

#include "engine/run/submitter.hpp"
#include "vk/buffer.hpp"

namespace geodisk::test {

class Workshop {
  public:
    static constexpr std::uint64_t kPoolBytes = std::uint64_t{4} << 20;
    // The engine's side of barriers with the job's.
    static constexpr SyncScope kUploaded{VK_PIPELINE_STAGE_TRANSFER_BIT,
                                         VK_ACCESS_TRANSFER_WRITE_BIT};
    static constexpr SyncScope kCopied{VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT};

    /// Fills the large buffer with a pattern.
    explicit Workshop(const Context& context);

    /// Ranges of just the bytes needed, none where that is none, as close to each other as
    /// alignment allows with a gap between them.
    Workspace cut(const WorkspaceNeeds& needs);
    /// Takes all ranges back.
    void start_over();

    std::span<std::byte> upload_bytes() const { return upload_.bytes(); }
    std::span<std::byte> download_bytes() const { return download_.bytes(); }
    void record_upload(VkCommandBuffer commands, const BufferRange& to, std::size_t from,
                       std::size_t size) const;
    void record_download(VkCommandBuffer commands, const BufferRange& from,
                         VkDeviceSize size) const;
    void barrier(VkCommandBuffer commands, SyncScope from, SyncScope to) const;

    /// Records, submits and waits; before and after `record` the engine writes to ranges of its
    /// own, next to the job's.
    void frame(std::uint32_t number, const std::function<void(VkCommandBuffer)>& record);

    std::vector<std::byte> contents();
    /// Words outside the ranges that are not as the engine left them.
    std::size_t damage();

  private:
    struct Owned {
        VkDeviceSize offset;
        std::uint32_t value;
    };

    void fill(VkCommandBuffer commands, Owned& owned, std::uint32_t value) const;

    DeviceRefs device_;
    DeviceTable vk_;
    VkDeviceSize alignment_ = 0;
    std::optional<Submitter> submitter_;
    DeviceBuffer large_;
    DeviceBuffer upload_;
    DeviceBuffer download_;
    VkDeviceSize used_ = 0;
    std::vector<BufferRange> ranges_;
    Owned before_{};
    Owned after_{};
};

} // namespace geodisk::test
