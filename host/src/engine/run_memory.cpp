#include "engine/run_memory.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "vk/barriers.hpp"

namespace geodisk {
namespace {

constexpr VkDeviceSize kStagingBytes = VkDeviceSize{16} << 20;

} // namespace

RunMemory::~RunMemory() {
    if (runner_.submitter->abandoned()) {
        staging_.abandon();
        for (DeviceBuffer& buffer : buffers_) {
            buffer.abandon();
        }
    }
}

Result<Done> RunMemory::allocate(const WorkspaceNeeds& needs) {
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        if (needs.bytes[i] == 0) {
            continue;
        }
        auto buffer = runner_.allocate(needs.bytes[i], kWorkspaceUsage, MemoryKind::device);
        if (!buffer) {
            return buffer.error();
        }
        buffers_[i] = std::move(*buffer);
    }
    auto staging = runner_.allocate(
        kStagingBytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
        MemoryKind::host);
    if (!staging) {
        return staging.error();
    }
    staging_ = std::move(*staging);
    return Done{};
}

BufferRange RunMemory::range(BufferRole role) const {
    return {buffer(role).handle(), 0, buffer(role).size()};
}

Workspace RunMemory::workspace() const {
    Workspace ranges;
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        ranges[i] = range(static_cast<BufferRole>(i));
    }
    return ranges;
}

std::uint64_t RunMemory::bytes() const {
    std::uint64_t sum = staging_.size();
    for (const DeviceBuffer& buffer : buffers_) {
        sum += buffer.size();
    }
    return sum;
}

Result<Done> RunMemory::upload(BufferRole role, std::span<const std::byte> bytes) {
    const DeviceTable& vk = runner_.engine().vk;
    for (std::size_t done = 0; done < bytes.size();) {
        const std::size_t part = std::min(bytes.size() - done, staging_.bytes().size());
        std::memcpy(staging_.bytes().data(), bytes.data() + done, part);
        auto copied = runner_.submitter->run([&](VkCommandBuffer commands) {
            const VkBufferCopy copy{0, done, part};
            vk.vkCmdCopyBuffer(commands, staging_.handle(), buffer(role).handle(), 1, &copy);
            barrier_transfer_to_compute(vk, commands);
        });
        if (!copied) {
            return copied;
        }
        done += part;
    }
    return Done{};
}

Result<Done> RunMemory::read(BufferRole role, std::span<std::byte> bytes) {
    const DeviceTable& vk = runner_.engine().vk;
    for (std::size_t done = 0; done < bytes.size();) {
        const std::size_t part = std::min(bytes.size() - done, staging_.bytes().size());
        auto copied = runner_.submitter->run([&](VkCommandBuffer commands) {
            const VkBufferCopy copy{done, 0, part};
            vk.vkCmdCopyBuffer(commands, buffer(role).handle(), staging_.handle(), 1, &copy);
            barrier_transfer_to_host(vk, commands);
        });
        if (!copied) {
            return copied;
        }
        std::memcpy(bytes.data() + done, staging_.bytes().data(), part);
        done += part;
    }
    return Done{};
}

void RunMemory::record_control(VkCommandBuffer commands) const {
    const DeviceTable& vk = runner_.engine().vk;
    barrier_compute_to_transfer(vk, commands);
    const VkBufferCopy copy{0, 0, sizeof(gpu::ControlRec)};
    vk.vkCmdCopyBuffer(commands, buffer(BufferRole::control).handle(), staging_.handle(), 1, &copy);
    barrier_transfer_to_host(vk, commands);
}

gpu::ControlRec RunMemory::control() const {
    gpu::ControlRec control;
    std::memcpy(&control, staging_.bytes().data(), sizeof control);
    return control;
}

Result<Done> RunMemory::enlarge_pool(VkDeviceSize bytes) {
    if (bytes > buffer(BufferRole::pool).size()) {
        auto larger = runner_.allocate(bytes, kWorkspaceUsage, MemoryKind::device);
        if (!larger) {
            return larger.error();
        }
        buffer(BufferRole::pool) = std::move(*larger);
    }
    return Done{};
}

Result<Done> RunMemory::enlarge_samples(const std::array<VkDeviceSize, 3>& bytes,
                                        std::uint32_t kept) {
    constexpr std::array kRoles{BufferRole::samples, BufferRole::accepted, BufferRole::buckets};
    std::array<DeviceBuffer, kRoles.size()> larger;
    for (std::size_t i = 0; i < kRoles.size(); ++i) {
        auto allocated = runner_.allocate(bytes[i], kWorkspaceUsage, MemoryKind::device);
        if (!allocated) {
            return allocated.error();
        }
        larger[i] = std::move(*allocated);
    }
    if (kept > 0) {
        const DeviceTable& vk = runner_.engine().vk;
        auto copied = runner_.submitter->run([&](VkCommandBuffer commands) {
            const VkBufferCopy copy{0, 0, VkDeviceSize{kept} * sizeof(gpu::SampleRec)};
            for (std::size_t i = 0; i < 2; ++i) { // What the buckets held is of no use any more.
                vk.vkCmdCopyBuffer(commands, buffer(kRoles[i]).handle(), larger[i].handle(), 1,
                                   &copy);
            }
            barrier_transfer_to_compute(vk, commands);
        });
        if (!copied) {
            if (runner_.submitter->abandoned()) {
                for (DeviceBuffer& buffer : larger) {
                    buffer.abandon();
                }
            }
            return copied;
        }
    }
    for (std::size_t i = 0; i < kRoles.size(); ++i) {
        buffer(kRoles[i]) = std::move(larger[i]);
    }
    return Done{};
}

} // namespace geodisk
