#include "engine/neighbours/neighbour_memory.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

#include "constants.h"
#include "engine/domain/domain_impl.hpp"
#include "engine/job/buffer_ranges.hpp"
#include "engine/job/sampler_impl.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

constexpr VkDeviceSize kWord = 4;
constexpr VkDeviceSize kMinRange = 16; // Of buffers that may have nothing in them.

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
    const VkDeviceSize each = std::max(VkDeviceSize{pairs} * kWord, kMinRange);
    const VkDeviceSize offsets = cutter.cut(heads);
    const VkDeviceSize targets = cutter.cut(each);
    const VkDeviceSize distances = cutter.cut(each);
    auto buffer =
        make_frame_buffer(sampler, cutter.end(),
                          kWorkspaceUsage | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, MemoryKind::device);
    GEODISK_TRY(buffer);
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
    made->max_sources_ = static_cast<std::uint32_t>(Domain::Impl::of(domain).settled.size());
    GEODISK_TRY(made->allocate(sampler, domain, inputs, frames));
    auto job = sampler.make_job(domain, plan, made->workspace_);
    GEODISK_TRY(job);
    made->job_.emplace(std::move(*job));
    GEODISK_TRY(made->stage(sampler, domain, inputs));
    return made;
}

Result<Done> NeighbourMemory::allocate(const Sampler& sampler, const Domain& domain,
                                       const NeighbourInputs& inputs, std::uint32_t frames) {
    const auto needs = sampler.workspace_needs(domain, plan_);
    GEODISK_TRY(needs);
    layout_ = sampler.lay_out(*needs);
    RangeCutter cutter = cutter_for(sampler);
    cutter.cut(layout_.bytes);
    const auto cut = [&](BufferRange& range, VkDeviceSize bytes) {
        range.size = std::max(bytes, kMinRange);
        range.offset = cutter.cut(range.size);
    };
    const VkDeviceSize entries = VkDeviceSize{room_} * sizeof(gpu::NeighbourRec);
    // Places of entries, and one for the end, take the room of what is sorted.
    static_assert(sizeof(gpu::NeighbourRec) >= 2 * kWord);
    const VkDeviceSize scanned = std::max(max_sources_ + 2, room_ + 1);
    cut(sources_, bytes_of(inputs.sources).size());
    cut(ranges_.limits, bytes_of(inputs.limits).size());
    cut(ranges_.names, bytes_of(inputs.names).size());
    cut(ranges_.rows, (VkDeviceSize{longest_word()} + 1) * kWord);
    cut(ranges_.entries, entries);
    cut(ranges_.sorted, entries);
    cut(ranges_.sums, (scanned + gpu::kScanBlock - 1) / gpu::kScanBlock * kWord);

    auto buffer = make_frame_buffer(sampler, cutter.end(), kWorkspaceUsage, MemoryKind::device);
    GEODISK_TRY(buffer);
    buffer_ = std::move(*buffer);
    auto uploads =
        FrameUploads::create(sampler, domain,
                             bytes_of(inputs.sources).size() + bytes_of(inputs.limits).size() +
                                 bytes_of(inputs.names).size());
    GEODISK_TRY(uploads);
    uploads_ = std::move(*uploads);
    auto told = make_frame_buffer(sampler, frames * sizeof(NeighbourTold),
                                  VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::host);
    GEODISK_TRY(told);
    told_ = std::move(*told);
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
    // Sources come part by part.
    if (auto staged = uploads_.stage_domain(sampler, domain, plan_, layout_, BufferRole::samples);
        !staged) {
        return staged;
    }
    uploads_.stage(sources_.offset, bytes_of(inputs.sources));
    uploads_.stage(ranges_.limits.offset, bytes_of(inputs.limits));
    uploads_.stage(ranges_.names.offset, bytes_of(inputs.names));
    std::memset(told_.bytes().data(), 0, told_.bytes().size());
    return Done{};
}

void NeighbourMemory::record_upload(const DeviceTable& vk, VkCommandBuffer commands) {
    uploads_.record(vk, commands, buffer_.handle());
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
