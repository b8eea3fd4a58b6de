#include "engine/neighbours/neighbour_kernels.hpp"

#include <algorithm>
#include <utility>

#include "bindings.h"
#include "constants.h"
#include "engine/kernels/kernel_table.hpp"
#include "support/try.hpp"
#include "vk/barriers.hpp"
#include "vk/descriptors.hpp"
#include "vk/result.hpp"

namespace geodisk {

Result<std::unique_ptr<NeighbourKernels>> NeighbourKernels::create(const Sampler::Impl& sampler,
                                                                   const NeighbourRanges& ranges) {
    KernelVariant variant;
    variant.domain = DomainKind::lists;
    const auto pipelines = sampler.pipelines.of(variant);
    GEODISK_TRY(pipelines);
    std::unique_ptr<NeighbourKernels> made(new NeighbourKernels(sampler, ranges));
    made->pipelines_ = *pipelines;
    auto done = made->make_views();
    done = done ? made->make_sets() : done;
    return done ? Result<std::unique_ptr<NeighbourKernels>>(std::move(made)) : done.error();
}

NeighbourKernels::~NeighbourKernels() {
    if (sampler_.abandoned) {
        return;
    }
    const VkAllocationCallbacks* const allocator = sampler_.device.host_allocator;
    sampler_.vk.vkDestroyDescriptorPool(sampler_.device.device, pool_, allocator);
    for (const auto& [range, view] : views_) {
        sampler_.vk.vkDestroyBufferView(sampler_.device.device, view, allocator);
    }
}

Result<Done> NeighbourKernels::make_views() {
    if (!sampler_.reads_texels()) {
        return Done{};
    }
    for (const BufferRange& range : {ranges_.rows, ranges_.sorted, ranges_.sums}) {
        VkBufferViewCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
        info.buffer = range.buffer;
        info.format = VK_FORMAT_R32_UINT;
        info.offset = range.offset;
        info.range = range.size / 4 * 4;
        VkBufferView view = VK_NULL_HANDLE;
        const VkResult result = null_unless_success(
            sampler_.vk.vkCreateBufferView(sampler_.device.device, &info,
                                           sampler_.device.host_allocator, &view),
            view);
        if (result != VK_SUCCESS) {
            return vk_error("vkCreateBufferView", result);
        }
        views_.emplace_back(range, view);
    }
    return Done{};
}

const BufferRange& NeighbourKernels::range_of(Role role, std::uint32_t binding) const {
    switch (binding) {
    case gpu::kBindWeights:
        return ranges_.hits;
    case gpu::kBindNames:
        return ranges_.names;
    case gpu::kBindLimits:
        return ranges_.limits;
    case gpu::kBindEntries:
        return role == Role::back ? ranges_.sorted : ranges_.entries;
    case gpu::kBindSorted:
        return role == Role::back ? ranges_.entries : ranges_.sorted;
    case gpu::kBindPlaces:
        return ranges_.sorted;
    case gpu::kBindSums:
        return ranges_.sums;
    case gpu::kBindOffsets:
        return ranges_.offsets;
    case gpu::kBindTargets:
        return ranges_.targets;
    case gpu::kBindDistances:
        return ranges_.distances;
    default: // Rows, or what is scanned in their place.
        return role == Role::places ? ranges_.sorted : ranges_.rows;
    }
}

Result<Done> NeighbourKernels::make_sets() {
    const std::pair<Role, Kernel> all[] = {
        {Role::forward, Kernel::neighbour_count}, {Role::forward, Kernel::neighbour_place},
        {Role::forward, Kernel::neighbour_merge}, {Role::back, Kernel::neighbour_merge},
        {Role::forward, Kernel::neighbour_mark},  {Role::forward, Kernel::neighbour_keep},
        {Role::forward, Kernel::neighbour_write}, {Role::forward, Kernel::sum_blocks},
        {Role::forward, Kernel::scan_sums},       {Role::forward, Kernel::scan_blocks},
        {Role::places, Kernel::sum_blocks},       {Role::places, Kernel::scan_sums},
        {Role::places, Kernel::scan_blocks}};
    std::vector<VkDescriptorPoolSize> sizes;
    std::vector<VkDescriptorSetLayout> layouts;
    for (const auto& [role, kernel] : all) {
        for (const KernelBinding& binding : sampler_.pipelines.interface_of(kernel).bindings) {
            sizes.push_back({binding.type, 1}); // Those of one type add up.
        }
        layouts.push_back(sampler_.pipelines.set_layout(static_cast<std::size_t>(kernel)));
    }
    std::vector<VkDescriptorSet> sets(layouts.size());
    auto done = create_descriptor_pool(sampler_.device, sampler_.vk, sizes,
                                       static_cast<std::uint32_t>(sets.size()), pool_);
    done =
        done ? allocate_descriptor_sets(sampler_.device, sampler_.vk, pool_, layouts, sets) : done;
    if (!done) {
        return done;
    }
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const auto [role, kernel] = all[i];
        for (const KernelBinding& binding : sampler_.pipelines.interface_of(kernel).bindings) {
            const BufferRange& range = range_of(role, binding.number);
            const auto view =
                std::ranges::find(views_, range, &std::pair<BufferRange, VkBufferView>::first);
            write_buffer(sampler_.device, sampler_.vk, sets[i], binding.number, binding.type,
                         {range.buffer, range.offset, range.size},
                         view == views_.end() ? VK_NULL_HANDLE : view->second);
        }
        sets_[{role, kernel}] = sets[i];
    }
    return done;
}

VkPipeline NeighbourKernels::pipeline(Kernel kernel) const {
    const auto k = static_cast<std::size_t>(kernel);
    const VkPipeline own = (*pipelines_)[k];
    return own != VK_NULL_HANDLE ? own : sampler_.pipelines.common()[k];
}

template <class Push>
void NeighbourKernels::pass(VkCommandBuffer commands, Kernel kernel, Role role, std::uint32_t count,
                            std::uint32_t per_group, Push push) const {
    const DeviceTable& vk = sampler_.vk;
    const VkPipelineLayout layout = sampler_.pipelines.layout(static_cast<std::size_t>(kernel));
    const VkDescriptorSet set = sets_.at({role, kernel});
    vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline(kernel));
    vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0,
                               nullptr);
    const std::uint32_t groups = (count + per_group - 1) / per_group;
    for (std::uint32_t group = 0; group < groups; group += kMaxGroups) {
        push.first_group = group;
        vk.vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof push, &push);
        vk.vkCmdDispatch(commands, std::min(groups - group, kMaxGroups), 1, 1);
    }
    barrier_compute_to_compute(vk, commands);
}

void NeighbourKernels::pass(VkCommandBuffer commands, Kernel kernel, Role role, std::uint32_t count,
                            const gpu::NeighbourPush& push) const {
    pass(commands, kernel, role, count, sampler_.choices.tuning.local_size, push);
}

void NeighbourKernels::scan(VkCommandBuffer commands, Role role, std::uint32_t count) const {
    gpu::Push push{};
    push.scan_count = count;
    pass(commands, Kernel::sum_blocks, role, count, gpu::kScanBlock, push);
    pass(commands, Kernel::scan_sums, role, 1, 1, push);
    pass(commands, Kernel::scan_blocks, role, count, gpu::kScanBlock, push);
}

void NeighbourKernels::record_entries(VkCommandBuffer commands,
                                      const gpu::NeighbourPush& push) const {
    pass(commands, Kernel::neighbour_count, Role::forward, push.count, push);
    scan(commands, Role::forward, push.sources + 2);
    pass(commands, Kernel::neighbour_place, Role::forward, push.count, push);
}

void NeighbourKernels::record_merge(VkCommandBuffer commands, const gpu::NeighbourPush& push,
                                    bool back) const {
    pass(commands, Kernel::neighbour_merge, back ? Role::back : Role::forward, push.count, push);
}

void NeighbourKernels::record_mark(VkCommandBuffer commands, const gpu::NeighbourPush& push) const {
    pass(commands, Kernel::neighbour_mark, Role::forward, push.count, push);
}

void NeighbourKernels::record_keep(VkCommandBuffer commands, const gpu::NeighbourPush& push) const {
    pass(commands, Kernel::neighbour_keep, Role::forward, push.count + 1, push);
    scan(commands, Role::places, push.count + 1);
}

void NeighbourKernels::record_write(VkCommandBuffer commands,
                                    const gpu::NeighbourPush& push) const {
    pass(commands, Kernel::neighbour_write, Role::forward, std::max(push.count, push.sources),
         push);
}

} // namespace geodisk
