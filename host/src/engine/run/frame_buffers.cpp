#include "engine/run/frame_buffers.hpp"

#include <cstdint>
#include <cstring>
#include <utility>

#include "engine/domain/domain_impl.hpp"
#include "engine/job/buffer_ranges.hpp"
#include "engine/job/sampler_impl.hpp"
#include "support/try.hpp"

namespace geodisk {

Result<DeviceBuffer> make_frame_buffer(const Sampler& sampler, VkDeviceSize bytes,
                                       VkBufferUsageFlags usage, MemoryKind kind) {
    const Sampler::Impl& engine = Sampler::Impl::of(sampler);
    const auto instance =
        load_instance_table(engine.device.get_instance_proc_addr, engine.device.instance);
    GEODISK_TRY(instance);
    VkPhysicalDeviceMemoryProperties memory{};
    instance->vkGetPhysicalDeviceMemoryProperties(engine.device.physical_device, &memory);
    return DeviceBuffer::create(engine.device, engine.vk, memory, bytes, usage, kind);
}

Result<FrameUploads> FrameUploads::create(const Sampler& sampler, const Domain& domain,
                                          VkDeviceSize more) {
    VkDeviceSize bytes = more;
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        bytes += sampler.upload_size(domain, static_cast<BufferRole>(i));
    }
    auto staging =
        make_frame_buffer(sampler, bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::host);
    GEODISK_TRY(staging);
    FrameUploads made;
    made.staging_ = std::move(*staging);
    return made;
}

Result<Done> FrameUploads::stage_domain(const Sampler& sampler, const Domain& domain,
                                        const RunPlan& plan, const WorkspaceLayout& layout,
                                        std::optional<BufferRole> left_out) {
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        const auto role = static_cast<BufferRole>(i);
        const std::size_t size = sampler.upload_size(domain, role);
        if (size == 0 || role == left_out) {
            continue;
        }
        if (auto written = sampler.write_upload(domain, plan, role, take(layout.offsets[i], size));
            !written) {
            return written;
        }
    }
    return Done{};
}

void FrameUploads::stage(VkDeviceSize to, std::span<const std::byte> bytes) {
    if (!bytes.empty()) {
        std::memcpy(take(to, bytes.size()).data(), bytes.data(), bytes.size());
    }
}

void FrameUploads::record(const DeviceTable& vk, VkCommandBuffer commands, VkBuffer to) {
    for (const Upload& upload : uploads_) {
        const VkBufferCopy region{upload.from, upload.to, upload.bytes};
        vk.vkCmdCopyBuffer(commands, staging_.handle(), to, 1, &region);
    }
    uploads_.clear();
}

std::span<std::byte> FrameUploads::take(VkDeviceSize to, VkDeviceSize bytes) {
    uploads_.push_back({used_, to, bytes});
    const auto place = staging_.bytes().subspan(used_, bytes);
    used_ += bytes;
    return place;
}

} // namespace geodisk
