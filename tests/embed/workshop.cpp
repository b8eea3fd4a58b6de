#include "workshop.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "gpu/device_run.hpp"
#include "vk/barriers.hpp"

namespace geodisk::test {
namespace {

constexpr std::uint32_t kPattern = 0xc5c5c5c5;
constexpr VkDeviceSize kLargeBytes = VkDeviceSize{24} << 20;
constexpr VkDeviceSize kOwnBytes = 64; ///< Bytes of the engine's own work at either end of a frame.

constexpr VkDeviceSize up(VkDeviceSize x, VkDeviceSize unit) {
    return (x + unit - 1) / unit * unit;
}

} // namespace

Workshop::Workshop(const Context& context)
    : device_(context.device()), vk_(expect(load_device_table(device_))) {
    const DeviceLimits& limits = context.report().limits;
    alignment_ = std::max<VkDeviceSize>({limits.min_storage_buffer_offset_alignment,
                                         limits.min_texel_buffer_offset_alignment, kOwnBytes});
    submitter_.emplace(
        expect(Submitter::create(device_, vk_, context.queue(), std::chrono::seconds(300))));
    const auto instance =
        expect(load_instance_table(device_.get_instance_proc_addr, device_.instance));
    VkPhysicalDeviceMemoryProperties memory{};
    instance.vkGetPhysicalDeviceMemoryProperties(device_.physical_device, &memory);
    const auto make = [&](VkDeviceSize bytes, VkBufferUsageFlags usage, MemoryKind kind) {
        return expect(DeviceBuffer::create(device_, vk_, memory, bytes, usage, kind));
    };
    large_ = make(kLargeBytes, kWorkspaceUsage, MemoryKind::device);
    upload_ = make(kLargeBytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::host);
    download_ = make(kLargeBytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::host);
    start_over();
}

void Workshop::start_over() {
    ranges_.clear();
    used_ = 0;
    before_ = after_ = {0, kPattern};
    expect(submitter_->run([&](VkCommandBuffer commands) {
        vk_.vkCmdFillBuffer(commands, large_.handle(), 0, VK_WHOLE_SIZE, kPattern);
    }));
}

Workspace Workshop::cut(const WorkspaceNeeds& needs) {
    Workspace workspace;
    before_.offset = used_;
    used_ += alignment_;
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        if (needs.bytes[i] == 0) {
            continue;
        }
        workspace[i] = {large_.handle(), used_, needs.bytes[i]};
        ranges_.push_back(workspace[i]);
        used_ = up(used_ + needs.bytes[i] + 16, alignment_);
    }
    after_.offset = used_;
    used_ += alignment_;
    if (used_ > large_.size()) {
        throw std::runtime_error("the large buffer is too small");
    }
    return workspace;
}

void Workshop::record_upload(VkCommandBuffer commands, const BufferRange& to, std::size_t from,
                             std::size_t size) const {
    const VkBufferCopy copy{from, to.offset, size};
    vk_.vkCmdCopyBuffer(commands, upload_.handle(), to.buffer, 1, &copy);
}

void Workshop::record_download(VkCommandBuffer commands, const BufferRange& from,
                               VkDeviceSize size) const {
    const VkBufferCopy copy{from.offset, 0, size};
    vk_.vkCmdCopyBuffer(commands, from.buffer, download_.handle(), 1, &copy);
    // One download after the other, and then the host.
    record_barrier(vk_, commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
                   VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_HOST_BIT,
                   VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_HOST_READ_BIT);
}

void Workshop::barrier(VkCommandBuffer commands, SyncScope from, SyncScope to) const {
    record_barrier(vk_, commands, from.stages, from.access, to.stages, to.access);
}

void Workshop::fill(VkCommandBuffer commands, Owned& owned, std::uint32_t value) const {
    owned.value = value;
    vk_.vkCmdFillBuffer(commands, large_.handle(), owned.offset, kOwnBytes, value);
}

void Workshop::frame(std::uint32_t number, const std::function<void(VkCommandBuffer)>& record) {
    expect(submitter_->run([&](VkCommandBuffer commands) {
        fill(commands, before_, 2 * number);
        record(commands);
        fill(commands, after_, 2 * number + 1);
    }));
}

std::vector<std::byte> Workshop::contents() {
    // Not over what the job has downloaded: that goes on to be looked at.
    std::vector<std::byte> kept(download_.bytes().begin(), download_.bytes().end());
    expect(submitter_->run([&](VkCommandBuffer commands) {
        record_download(commands, {large_.handle(), 0, large_.size()}, large_.size());
    }));
    std::vector<std::byte> result(download_.bytes().begin(), download_.bytes().end());
    std::copy(kept.begin(), kept.end(), download_.bytes().begin());
    return result;
}

std::size_t Workshop::damage() {
    const std::vector<std::byte> bytes = contents();
    std::vector<std::uint32_t> expected(bytes.size() / 4, kPattern);
    for (const Owned& owned : {before_, after_}) {
        std::fill_n(expected.begin() + static_cast<std::ptrdiff_t>(owned.offset / 4), kOwnBytes / 4,
                    owned.value);
    }
    std::vector<bool> theirs(expected.size(), false);
    for (const BufferRange& range : ranges_) {
        std::fill_n(theirs.begin() + static_cast<std::ptrdiff_t>(range.offset / 4), range.size / 4,
                    true);
    }
    std::size_t damaged = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        std::uint32_t word;
        std::memcpy(&word, bytes.data() + i * 4, 4);
        damaged += !theirs[i] && word != expected[i] ? 1u : 0u;
    }
    return damaged;
}

} // namespace geodisk::test
