#include "engine/neighbours/neighbour_memory.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

#include "constants.h"
#include "engine/domain/domain_impl.hpp"
#include "engine/job/buffer_ranges.hpp"
#include "engine/job/sampler_impl.hpp"

namespace geodisk {
namespace {

constexpr VkDeviceSize kWord = 4;
constexpr VkDeviceSize kLeastRange = 16; // Of buffers that may have nothing in them.

Result<DeviceBuffer> make(const Sampler& sampler, VkDeviceSize bytes, VkBufferUsageFlags usage,
                          MemoryKind kind) {
    const Sampler::Impl& engine = Sampler::Impl::of(sampler);
    const auto instance =
        load_instance_table(engine.device.get_instance_proc_addr, engine.device.instance);
    if (!instance) {
        return instance.error();
    }
    VkPhysicalDeviceMemoryProperties memory{};
    instance->vkGetPhysicalDeviceMemoryProperties(engine.device.physical_device, &memory);
    return DeviceBuffer::create(engine.device, engine.vk, memory, bytes, usage, kind);
}

RangeCutter cutter_for(const Sampler& sampler) {
    return RangeCutter(range_alignment(sampler.report().limits));
}

std::span<const std::byte> bytes_of(const auto& values) {
    return std::as_bytes(std::span(values));
}

} // namespace

Result<ListMemory> ListMemory::create(const Sampler& sampler, std::uint32_t sources,
                                      std::uint32_t pairs) {
    RangeCutter cutter = cutter_for(sampler);
    const VkDeviceSize heads = (VkDeviceSize{sources} + 2) * kWord;
    const VkDeviceSize each = std::max(VkDeviceSize{pairs} * kWord, kLeastRange);
    const VkDeviceSize offsets = cutter.cut(heads);
    const VkDeviceSize targets = cutter.cut(each);
    const VkDeviceSize distances = cutter.cut(each);
    auto buffer = make(sampler, cutter.end(), kWorkspaceUsage | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
                       MemoryKind::device);
    if (!buffer) {
        return buffer.error();
    }
    ListMemory made;
    made.offsets_ = {buffer->handle(), offsets, heads};
    made.targets_ = {buffer->handle(), targets, each};
    made.distances_ = {buffer->handle(), distances, each};
    made.pairs_ = pairs;
    made.buffer_ = std::move(*buffer);
    return made;
}

void ListMemory::record_clear(const DeviceTable& vk, VkCommandBuffer commands) const {
    vk.vkCmdFillBuffer(commands, buffer(), offsets_.offset, offsets_.size, 0);
}

void ListMemory::record_copy(const DeviceTable& vk, VkCommandBuffer commands,
                             const ListMemory& from, std::uint32_t pairs) const {
    std::vector<VkBufferCopy> copies{{from.offsets_.offset, offsets_.offset, offsets_.size}};
    if (pairs > 0) {
        copies.push_back({from.targets_.offset, targets_.offset, pairs * kWord});
        copies.push_back({from.distances_.offset, distances_.offset, pairs * kWord});
    }
    vk.vkCmdCopyBuffer(commands, from.buffer(), buffer(), static_cast<std::uint32_t>(copies.size()),
                       copies.data());
}

Result<std::unique_ptr<NeighbourMemory>>
NeighbourMemory::create(const Sampler& sampler, const Domain& domain, const RunPlan& plan,
                        std::uint32_t room, const NeighbourInputs& inputs, std::uint32_t frames) {
    auto made = std::make_unique<NeighbourMemory>();
    made->plan_ = plan;
    made->room_ = room;
    made->most_sources_ = static_cast<std::uint32_t>(Domain::Impl::of(domain).settled.size());
    if (auto allocated = made->allocate(sampler, domain, inputs, frames); !allocated) {
        return allocated.error();
    }
    auto job = sampler.make_job(domain, plan, made->workspace_);
    if (!job) {
        return job.error();
    }
    made->job_.emplace(std::move(*job));
    if (auto staged = made->stage(sampler, domain, inputs); !staged) {
        return staged.error();
    }
    return made;
}

Result<Done> NeighbourMemory::allocate(const Sampler& sampler, const Domain& domain,
                                       const NeighbourInputs& inputs, std::uint32_t frames) {
    const auto needs = sampler.workspace_needs(domain, plan_);
    if (!needs) {
        return needs.error();
    }
    layout_ = sampler.lay_out(*needs);
    RangeCutter cutter = cutter_for(sampler);
    cutter.cut(layout_.bytes);
    const auto cut = [&](BufferRange& range, VkDeviceSize bytes) {
        range.size = std::max(bytes, kLeastRange);
        range.offset = cutter.cut(range.size);
    };
    const VkDeviceSize entries = VkDeviceSize{room_} * sizeof(gpu::NeighbourRec);
    // Places of entries, and one for the end, take the room of what is sorted.
    static_assert(sizeof(gpu::NeighbourRec) >= 2 * kWord);
    const VkDeviceSize scanned = std::max(most_sources_ + 2, room_ + 1);
    cut(sources_, bytes_of(inputs.sources).size());
    cut(ranges_.limits, bytes_of(inputs.limits).size());
    cut(ranges_.names, bytes_of(inputs.names).size());
    cut(ranges_.rows, (VkDeviceSize{longest_word()} + 1) * kWord);
    cut(ranges_.entries, entries);
    cut(ranges_.sorted, entries);
    cut(ranges_.sums, (scanned + gpu::kScanBlock - 1) / gpu::kScanBlock * kWord);

    VkDeviceSize staged = bytes_of(inputs.sources).size() + bytes_of(inputs.limits).size() +
                          bytes_of(inputs.names).size();
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        staged += sampler.upload_size(domain, static_cast<BufferRole>(i));
    }
    const auto allocated = [&](DeviceBuffer& buffer, VkDeviceSize bytes, VkBufferUsageFlags usage,
                               MemoryKind kind) -> Result<Done> {
        auto made = make(sampler, bytes, usage, kind);
        if (!made) {
            return made.error();
        }
        buffer = std::move(*made);
        return Done{};
    };
    auto done = allocated(buffer_, cutter.end(), kWorkspaceUsage, MemoryKind::device);
    done = done ? allocated(staging_, staged, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::host)
                : done;
    done = done ? allocated(told_, frames * sizeof(NeighbourTold), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                            MemoryKind::host)
                : done;
    if (!done) {
        return done;
    }
    workspace_ = layout_.in(buffer_.handle());
    for (BufferRange* const range : {&sources_, &ranges_.limits, &ranges_.names, &ranges_.rows,
                                     &ranges_.entries, &ranges_.sorted, &ranges_.sums}) {
        range->buffer = buffer_.handle();
    }
    ranges_.hits = range(BufferRole::weights);
    return Done{};
}

Result<Done> NeighbourMemory::stage(const Sampler& sampler, const Domain& domain,
                                    const NeighbourInputs& inputs) {
    VkDeviceSize from = 0;
    const auto take = [&](VkDeviceSize to, VkDeviceSize bytes) {
        uploads_.push_back({from, to, bytes});
        const auto place = staging_.bytes().subspan(from, bytes);
        from += bytes;
        return place;
    };
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        const auto role = static_cast<BufferRole>(i);
        const std::size_t size = sampler.upload_size(domain, role);
        // Sources come part by part.
        if (size == 0 || role == BufferRole::samples) {
            continue;
        }
        if (auto written =
                sampler.write_upload(domain, plan_, role, take(layout_.offsets[i], size));
            !written) {
            return written;
        }
    }
    const auto put = [&](const BufferRange& to, std::span<const std::byte> bytes) {
        if (!bytes.empty()) {
            std::memcpy(take(to.offset, bytes.size()).data(), bytes.data(), bytes.size());
        }
    };
    put(sources_, bytes_of(inputs.sources));
    put(ranges_.limits, bytes_of(inputs.limits));
    put(ranges_.names, bytes_of(inputs.names));
    std::memset(told_.bytes().data(), 0, told_.bytes().size());
    return Done{};
}

void NeighbourMemory::record_upload(const DeviceTable& vk, VkCommandBuffer commands) {
    for (const Upload& upload : uploads_) {
        const VkBufferCopy region{upload.from, upload.to, upload.bytes};
        vk.vkCmdCopyBuffer(commands, staging_.handle(), buffer_.handle(), 1, &region);
    }
    uploads_.clear();
}

void NeighbourMemory::record_part(const DeviceTable& vk, VkCommandBuffer commands,
                                  std::uint32_t first, std::uint32_t sources) const {
    vk.vkCmdFillBuffer(commands, buffer_.handle(), ranges_.hits.offset, kWord, 0);
    const VkBufferCopy copy{sources_.offset + first * sizeof(gpu::SampleRec),
                            range(BufferRole::samples).offset, sources * sizeof(gpu::SampleRec)};
    vk.vkCmdCopyBuffer(commands, buffer_.handle(), buffer_.handle(), 1, &copy);
}

void NeighbourMemory::record_clear_rows(const DeviceTable& vk, VkCommandBuffer commands) const {
    vk.vkCmdFillBuffer(commands, buffer_.handle(), ranges_.rows.offset,
                       (VkDeviceSize{longest_word()} + 1) * kWord, 0);
}

void NeighbourMemory::record_told(const DeviceTable& vk, VkCommandBuffer commands,
                                  const ListMemory& lists, std::uint32_t first,
                                  std::uint32_t sources, std::uint32_t turn) const {
    const VkDeviceSize to = turn * sizeof(NeighbourTold);
    const VkBufferCopy copies[] = {
        {range(BufferRole::control).offset, to + offsetof(NeighbourTold, control),
         sizeof(gpu::ControlRec)},
        {ranges_.hits.offset, to + offsetof(NeighbourTold, head), 4 * kWord},
        {ranges_.rows.offset + (VkDeviceSize{sources} + 1) * kWord,
         to + offsetof(NeighbourTold, entries), kWord},
        {ranges_.rows.offset + longest_word() * kWord, to + offsetof(NeighbourTold, longest),
         kWord}};
    vk.vkCmdCopyBuffer(commands, buffer_.handle(), told_.handle(),
                       static_cast<std::uint32_t>(std::size(copies)), copies);
    const VkBufferCopy pairs{lists.offsets().offset + (VkDeviceSize{first} + sources) * kWord,
                             to + offsetof(NeighbourTold, pairs), kWord};
    vk.vkCmdCopyBuffer(commands, lists.buffer(), told_.handle(), 1, &pairs);
}

NeighbourTold NeighbourMemory::told(std::uint32_t turn) const {
    NeighbourTold told;
    std::memcpy(&told, told_.bytes().data() + turn * sizeof told, sizeof told);
    return told;
}

} // namespace geodisk
