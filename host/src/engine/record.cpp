// What a job records. Every step depends on the one before it, so one barrier serves them all.
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <optional>

#include <geodisk/sampler.hpp>

#include "constants.h"
#include "engine/sampler_impl.hpp"
#include "engine/stage_clock.hpp"
#include "records.h"
#include "vk/barriers.hpp"

namespace geodisk {
namespace {

class Recorder {
  public:
    Recorder(VkCommandBuffer commands, const Sampler::Impl& sampler, const Job::Impl& job)
        : commands_(commands), sampler_(sampler), job_(job) {}

    void dispatch(Kernel kernel, Groups groups, const gpu::Push& push,
                  SetRole role = SetRole::workspace) {
        bind(kernel, push, role);
        sampler_.vk.vkCmdDispatch(commands_, groups.x, groups.y, 1);
        barrier_compute_to_compute(sampler_.vk, commands_);
    }

    void dispatch_per_face(Kernel kernel) {
        dispatch(kernel, groups_for(job_.push.faces, sampler_.choices.tuning.local_size),
                 job_.push);
    }

    void dispatch_per_candidate(Kernel kernel, std::uint32_t per_group, const gpu::Push& push) {
        dispatch(kernel, groups_for(push.capacity, per_group), push);
    }

    void dispatch_per_sample(Kernel kernel) {
        const std::uint32_t most = std::max(job_.push.sample_capacity, job_.push.slots);
        dispatch(kernel, groups_for(most, sampler_.choices.tuning.local_size), job_.push);
    }

    /// The size is what `select` left at this offset of the control record.
    void dispatch_indirect(Kernel kernel, VkDeviceSize offset) {
        bind(kernel, job_.push, SetRole::workspace);
        const BufferRange& control = range(BufferRole::control);
        sampler_.vk.vkCmdDispatchIndirect(commands_, control.buffer, control.offset + offset);
        barrier_compute_to_compute(sampler_.vk, commands_);
    }

    /// What was recorded since the last mark belongs to this stage.
    void mark(Stage stage) const {
        if (job_.clock != nullptr) {
            job_.clock->mark(commands_, stage);
        }
    }

    /// Exclusive scan of `count` words.
    void scan(std::uint32_t count, SetRole role) {
        gpu::Push push = job_.push;
        push.scan_count = count;
        const Groups blocks = groups_for(count, gpu::kScanBlock);
        dispatch(Kernel::sum_blocks, blocks, push, role);
        dispatch(Kernel::scan_sums, {1, 1}, push, role);
        dispatch(Kernel::scan_blocks, blocks, push, role);
    }

    void fill(BufferRole role, VkDeviceSize size) const {
        const BufferRange& target = range(role);
        sampler_.vk.vkCmdFillBuffer(commands_, target.buffer, target.offset, size, 0);
    }

    void fill_control(std::size_t first, std::size_t size, std::uint32_t word) const {
        const BufferRange& control = range(BufferRole::control);
        sampler_.vk.vkCmdFillBuffer(commands_, control.buffer, control.offset + first, size, word);
    }

    /// Copies a word of the control record to another.
    void copy_control(std::size_t from, std::size_t to) const {
        const BufferRange& control = range(BufferRole::control);
        const VkBufferCopy copy{control.offset + from, control.offset + to, 4};
        sampler_.vk.vkCmdCopyBuffer(commands_, control.buffer, control.buffer, 1, &copy);
    }

  private:
    const BufferRange& range(BufferRole role) const {
        return job_.workspace[static_cast<std::size_t>(role)];
    }

    void bind(Kernel kernel, const gpu::Push& push, SetRole role) {
        // A round repeats small dispatches; binding anew what is bound costs as much as they do.
        if (kernel == bound_ && role == bound_role_ &&
            std::memcmp(&push, &bound_push_, sizeof push) == 0) {
            return;
        }
        bound_ = kernel;
        bound_role_ = role;
        bound_push_ = push;
        const auto k = static_cast<std::size_t>(kernel);
        const DeviceTable& vk = sampler_.vk;
        const VkPipelineLayout layout = sampler_.pipelines.layout(k);
        vk.vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, job_.pipeline(k));
        vk.vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1,
                                   &job_.sets[static_cast<std::size_t>(role)][k], 0, nullptr);
        vk.vkCmdPushConstants(commands_, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof push,
                              &push);
    }

    VkCommandBuffer commands_;
    const Sampler::Impl& sampler_;
    const Job::Impl& job_;
    std::optional<Kernel> bound_;
    SetRole bound_role_ = SetRole::workspace;
    gpu::Push bound_push_{};
};

} // namespace

void Sampler::record_begin(VkCommandBuffer commands, const Job& job) const noexcept {
    Recorder recorder(commands, *impl_, *job.impl_);
    const gpu::Push& push = job.impl_->push;
    const DomainKernels own = kernels_of(job.impl_->domain);
    const bool has_cells = push.all_single == 0;
    if (push.first_stage == 0) {
        recorder.fill_control(0, sizeof(gpu::ControlRec), 0);
        recorder.fill(BufferRole::pool, VkDeviceSize{push.first_list_row} * 16);
    } else {
        // What was accepted so far is settled, and in order.
        barrier_compute_to_transfer(impl_->vk, commands);
        recorder.copy_control(offsetof(gpu::ControlRec, accepted),
                              offsetof(gpu::ControlRec, settled));
        recorder.copy_control(offsetof(gpu::ControlRec, accepted),
                              offsetof(gpu::ControlRec, ordered));
        recorder.fill_control(0, offsetof(gpu::ControlRec, accepted), 0);
    }
    if (has_cells) {
        recorder.fill(BufferRole::cells, (VkDeviceSize{push.cells} + 2) * 4);
    }
    barrier_transfer_to_compute(impl_->vk, commands);
    recorder.dispatch_per_face(own.count);
    recorder.scan(push.faces * push.stages + 1, SetRole::start_scan);
    recorder.mark(Stage::count);
    if (has_cells) {
        recorder.dispatch_per_candidate(own.bin, gpu::kDrawBlock, push);
        recorder.scan(push.cells + 2, SetRole::cell_scan);
    }
    recorder.mark(Stage::bin);
    recorder.dispatch_per_candidate(own.draw, gpu::kDrawBlock, push);
    recorder.dispatch(Kernel::begin_chunk, {1, 1}, push);
    recorder.mark(Stage::draw);
}

void Sampler::record_rounds(VkCommandBuffer commands, const Job& job,
                            std::uint32_t rounds) const noexcept {
    Recorder recorder(commands, *impl_, *job.impl_);
    const DomainKernels own = kernels_of(job.impl_->domain);
    for (std::uint32_t round = 0; round < rounds; ++round) {
        recorder.dispatch_indirect(own.select, offsetof(gpu::ControlRec, select_x));
        recorder.mark(Stage::select);
        for (std::uint32_t pass = 0; pass < job.impl_->plan.detect_passes; ++pass) {
            recorder.dispatch_indirect(own.detect, offsetof(gpu::ControlRec, detect_x));
        }
        recorder.mark(Stage::detect);
        recorder.dispatch_indirect(Kernel::resolve, offsetof(gpu::ControlRec, groups_x));
        for (std::uint32_t pass = 0; pass < impl_->count_passes(); ++pass) {
            recorder.dispatch_indirect(Kernel::count_calls, offsetof(gpu::ControlRec, count_x));
        }
        recorder.mark(Stage::resolve);
    }
}

void Sampler::record_rewind(VkCommandBuffer commands, const Job& job) const noexcept {
    // The batch was selected with the slots of an earlier plan, never fewer than now.
    Recorder recorder(commands, *impl_, *job.impl_);
    // No lane has a slot, and no row of a table a disk.
    recorder.fill(BufferRole::pool, VkDeviceSize{job.impl_->push.first_list_row} * 16);
    barrier_transfer_to_compute(impl_->vk, commands);
    recorder.dispatch(Kernel::rewind,
                      groups_for(job.impl_->most_slots, impl_->choices.tuning.slot_local_size),
                      job.impl_->push);
    recorder.dispatch(Kernel::resume, {1, 1}, job.impl_->push);
}

void Sampler::record_finish(VkCommandBuffer commands, const Job& job) const noexcept {
    Recorder recorder(commands, *impl_, *job.impl_);
    const gpu::Push& push = job.impl_->push;
    barrier_compute_to_transfer(impl_->vk, commands);
    recorder.fill_control(offsetof(gpu::ControlRec, first_open), 4, gpu::kNoOrder);
    recorder.fill(BufferRole::buckets, (VkDeviceSize{push.buckets} + 2) * 4);
    barrier_transfer_to_compute(impl_->vk, commands);
    recorder.dispatch_per_sample(Kernel::order_count);
    recorder.scan(push.buckets + 2, SetRole::bucket_scan);
    recorder.dispatch_per_sample(Kernel::order_place);
    recorder.dispatch_per_sample(Kernel::order_write);
    barrier_compute_to_transfer(impl_->vk, commands);
    recorder.copy_control(offsetof(gpu::ControlRec, next_ordered),
                          offsetof(gpu::ControlRec, ordered));
    barrier_transfer_to_compute(impl_->vk, commands);
    recorder.mark(Stage::gather);
}

void Job::Impl::record_restart(VkCommandBuffer commands) const {
    Recorder(commands, *sampler, *this).dispatch(Kernel::begin_chunk, {1, 1}, push);
}

void Job::Impl::record_count(VkCommandBuffer commands, std::uint32_t end_order) const {
    Recorder recorder(commands, *sampler, *this);
    gpu::Push counted = push;
    counted.end_order = end_order;
    barrier_compute_to_transfer(sampler->vk, commands);
    recorder.fill_control(offsetof(gpu::ControlRec, below), 4, 0);
    barrier_transfer_to_compute(sampler->vk, commands);
    recorder.dispatch_per_candidate(Kernel::count_orders, gpu::kSelectBlock, counted);
}

} // namespace geodisk
