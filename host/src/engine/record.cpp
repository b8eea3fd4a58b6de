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

// Chains of conflicts are short: two passes decide nearly every batch, and what they leave goes on
// in the next round.
constexpr std::uint32_t kResolvePasses = 2;

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

    void dispatch_per_candidate(Kernel kernel) {
        dispatch(kernel, groups_for(job_.push.candidates, sampler_.tuning.local_size), job_.push);
    }

    /// The size is what `select` left at this offset of the control record.
    void dispatch_indirect(Kernel kernel, VkDeviceSize offset) {
        bind(kernel, job_.push, SetRole::workspace);
        const BufferRange& control = range(BufferRole::control);
        sampler_.vk.vkCmdDispatchIndirect(commands_, control.buffer, control.offset + offset);
        barrier_compute_to_compute(sampler_.vk, commands_);
    }

    /// Geodesic disks are for lanes to share, straight ones are all alike.
    void dispatch_detect() {
        const bool has_lanes = sampler_.domain == Domain::surface;
        dispatch_indirect(kernels_of(sampler_.domain).detect,
                          has_lanes ? offsetof(gpu::ControlRec, detect_x)
                                    : offsetof(gpu::ControlRec, groups_x));
    }

    void dispatch_per_slot(Kernel kernel) {
        dispatch_indirect(kernel, offsetof(gpu::ControlRec, groups_x));
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
        dispatch(Kernel::scan_blocks, blocks, push, role);
        dispatch(Kernel::scan_sums, {1, 1}, push, role);
        dispatch(Kernel::scan_add, blocks, push, role);
    }

    void fill(BufferRole role, VkDeviceSize size) const {
        const BufferRange& target = range(role);
        sampler_.vk.vkCmdFillBuffer(commands_, target.buffer, target.offset, size, 0);
    }

    /// What was accepted so far is settled; the rest of the control record is made ready for more.
    void settle() const {
        const BufferRange& control = range(BufferRole::control);
        const VkBufferCopy copy{control.offset + offsetof(gpu::ControlRec, accepted),
                                control.offset + offsetof(gpu::ControlRec, settled),
                                sizeof gpu::ControlRec::settled};
        sampler_.vk.vkCmdCopyBuffer(commands_, control.buffer, control.buffer, 1, &copy);
        fill(BufferRole::control, offsetof(gpu::ControlRec, accepted));
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
        vk.vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, sampler_.pipelines[k]);
        vk.vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, sampler_.layouts[k],
                                   0, 1, &job_.sets[static_cast<std::size_t>(role)][k], 0, nullptr);
        vk.vkCmdPushConstants(commands_, sampler_.layouts[k], VK_SHADER_STAGE_COMPUTE_BIT, 0,
                              sizeof push, &push);
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
    const DomainKernels own = kernels_of(impl_->domain);
    const std::uint32_t starts = push.cells + 1;
    if (push.first_rank == 0) {
        recorder.fill(BufferRole::control, sizeof(gpu::ControlRec) + VkDeviceSize{push.slots} * 4);
        recorder.fill(BufferRole::pool, VkDeviceSize{push.first_list_row} * 16);
    } else {
        barrier_compute_to_transfer(impl_->vk, commands);
        recorder.settle();
    }
    recorder.fill(BufferRole::cells, VkDeviceSize{starts} * 4);
    barrier_transfer_to_compute(impl_->vk, commands);
    recorder.dispatch_per_candidate(own.candidates);
    recorder.mark(Stage::draw);
    recorder.scan(starts, SetRole::cell_scan);
    recorder.dispatch_per_candidate(Kernel::bin_place);
    recorder.dispatch_per_candidate(own.fill);
    recorder.mark(Stage::bin);
}

void Sampler::record_rounds(VkCommandBuffer commands, const Job& job,
                            std::uint32_t rounds) const noexcept {
    Recorder recorder(commands, *impl_, *job.impl_);
    const gpu::Push& push = job.impl_->push;
    for (std::uint32_t round = 0; round < rounds; ++round) {
        recorder.dispatch_indirect(Kernel::find_idle, offsetof(gpu::ControlRec, find_x));
        recorder.dispatch(Kernel::select, {1, 1}, push);
        recorder.dispatch_per_slot(kernels_of(impl_->domain).activate);
        recorder.mark(Stage::select);
        for (std::uint32_t pass = 0; pass < job.impl_->plan.detect_passes; ++pass) {
            recorder.dispatch_detect();
        }
        recorder.mark(Stage::detect);
        recorder.dispatch_per_slot(Kernel::block);
        for (std::uint32_t pass = 0; pass < kResolvePasses; ++pass) {
            recorder.dispatch_per_slot(Kernel::resolve);
        }
        for (std::uint32_t pass = 0; pass < impl_->count_passes(); ++pass) {
            recorder.dispatch_per_slot(Kernel::count_calls);
        }
        recorder.mark(Stage::resolve);
    }
}

void Sampler::record_rewind(VkCommandBuffer commands, const Job& job) const noexcept {
    // The batch was selected with the slots of an earlier plan, never fewer than now.
    Recorder recorder(commands, *impl_, *job.impl_);
    const BufferRange& slots = job.impl_->workspace[static_cast<std::size_t>(BufferRole::slots)];
    // No lane has a slot, and no row of a table a disk.
    recorder.fill(BufferRole::pool, VkDeviceSize{job.impl_->push.first_list_row} * 16);
    barrier_transfer_to_compute(impl_->vk, commands);
    recorder.dispatch(Kernel::rewind,
                      groups_for(slots.size / sizeof(gpu::SlotRec), impl_->tuning.slot_local_size),
                      job.impl_->push);
}

void Sampler::record_finish(VkCommandBuffer commands, const Job& job) const noexcept {
    Recorder recorder(commands, *impl_, *job.impl_);
    const gpu::Push& push = job.impl_->push;
    recorder.dispatch_per_candidate(Kernel::compact_mark);
    recorder.scan(push.candidates, SetRole::workspace);
    recorder.dispatch_per_candidate(Kernel::compact_gather);
    // In boxes the ranks say all.
    if (impl_->domain != Domain::box) {
        recorder.dispatch(
            Kernel::compact_fill,
            groups_for(std::min(push.sample_capacity, push.candidates), impl_->tuning.local_size),
            push);
    }
    recorder.mark(Stage::gather);
}

} // namespace geodisk
