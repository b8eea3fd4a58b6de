// Commands that a job records. Every step depends on the one before it, so one barrier serves them
// all.
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <optional>
#include <utility>

#include <geodisk/sampler.hpp>

#include "constants.h"
#include "engine/job/record.hpp"
#include "engine/job/stage_clock.hpp"
#include "records.h"
#include "vk/barriers.hpp"
#include "vk/debug.hpp"

namespace geodisk {
namespace {

// Bytes of cleared memory per item.
constexpr VkDeviceSize kClearBytes = 64;

/// Records dispatches, and clears of memory, one after the other. Sequences of them may be cut
/// anywhere: a cursor tells where the next recording goes on.
class Recorder {
  public:
    Recorder(VkCommandBuffer commands, Job::Impl& job) : Recorder(commands, job, whole_, all_) {}
    /// From the cursor on, as much as the budget allows.
    Recorder(VkCommandBuffer commands, Job::Impl& job, Cursor& cursor, Budget& budget)
        : commands_(commands), sampler_(*job.sampler), job_(job), cursor_(cursor), budget_(budget) {
    }
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;
    ~Recorder() { mark(); }

    /// A pass over `count` items, `per_group` to a work group. Dispatches of it are bounded.
    void pass(Kernel kernel, std::uint64_t count, std::uint32_t per_group, const gpu::Push& push,
              SetRole role = SetRole::workspace) {
        in_parts(count, per_group, [&](std::uint64_t first, std::uint64_t part) {
            gpu::Push own = push;
            own.first_group = static_cast<std::uint32_t>(first / per_group);
            bind(kernel, own, role);
            sampler_.vk.vkCmdDispatch(
                commands_, static_cast<std::uint32_t>((part + per_group - 1) / per_group), 1, 1);
            barrier_compute_to_compute(sampler_.vk, commands_);
        });
    }

    void pass_over_faces(Kernel kernel) {
        pass(kernel, job_.constants.faces, sampler_.choices.tuning.local_size, job_.push);
    }

    void pass_over_candidates(Kernel kernel, std::uint32_t per_group, const gpu::Push& push) {
        pass(kernel, job_.constants.capacity, per_group, push);
    }

    void pass_over_samples(Kernel kernel) {
        pass(kernel, std::max(job_.push.sample_capacity, job_.push.slots),
             sampler_.choices.tuning.local_size, job_.push);
    }

    void single(Kernel kernel, const gpu::Push& push, SetRole role = SetRole::workspace) {
        pass(kernel, 1, 1, push, role);
    }

    /// The size is what `select` left at this offset of the control record.
    void dispatch_indirect(Kernel kernel, VkDeviceSize offset) {
        dispatch_indirect(kernel, offset, job_.push);
    }
    void dispatch_indirect(Kernel kernel, VkDeviceSize offset, const gpu::Push& push) {
        in_parts(1, 1, [&](std::uint64_t, std::uint64_t) {
            bind(kernel, push, SetRole::workspace);
            const BufferRange& control = range(BufferRole::control);
            sampler_.vk.vkCmdDispatchIndirect(commands_, control.buffer, control.offset + offset);
            barrier_compute_to_compute(sampler_.vk, commands_);
        });
    }

    /// Exclusive scan of `count` words.
    void scan(std::uint32_t count, SetRole role) {
        gpu::Push push = job_.push;
        push.scan_count = count;
        pass(Kernel::sum_blocks, count, gpu::kScanBlock, push, role);
        single(Kernel::scan_sums, push, role);
        pass(Kernel::scan_blocks, count, gpu::kScanBlock, push, role);
    }

    void clear(BufferRole role, VkDeviceSize size) {
        const BufferRange& target = range(role);
        const std::uint64_t items = (size + kClearBytes - 1) / kClearBytes;
        in_parts(items, 1, [&](std::uint64_t first, std::uint64_t part) {
            const VkDeviceSize begin = first * kClearBytes;
            const VkDeviceSize end = std::min((first + part) * kClearBytes, size);
            transfer([&] {
                sampler_.vk.vkCmdFillBuffer(commands_, target.buffer, target.offset + begin,
                                            end - begin, 0);
            });
        });
    }

    /// Records what `what` does by the functions that follow.
    template <class Change>
    void change(const Change& what) {
        in_parts(1, 1, [&](std::uint64_t, std::uint64_t) { transfer(what); });
    }
    void fill(std::size_t first, std::size_t size, std::uint32_t word) const {
        const BufferRange& control = range(BufferRole::control);
        sampler_.vk.vkCmdFillBuffer(commands_, control.buffer, control.offset + first, size, word);
    }
    void fill_generation() const {
        fill(offsetof(gpu::ControlRec, generation), 4, job_.generation);
    }
    /// Zeros but for the generation, which is the job's.
    void fill_below(std::size_t end) const {
        constexpr std::size_t kAt = offsetof(gpu::ControlRec, generation);
        fill(0, kAt, 0);
        fill_generation();
        fill(kAt + 4, end - kAt - 4, 0);
    }
    void copy(std::size_t from, std::size_t to) const { copy_word(BufferRole::control, from, to); }
    /// Copies the order of a sample that is in order.
    void copy_order(std::uint32_t sample, std::size_t to) const {
        copy_word(BufferRole::samples,
                  sample * sizeof(gpu::SampleRec) + offsetof(gpu::SampleRec, order), to);
    }
    void write_constants() const {
        const BufferRange& target = range(BufferRole::constants);
        sampler_.vk.vkCmdUpdateBuffer(commands_, target.buffer, target.offset,
                                      sizeof job_.constants, &job_.constants);
    }

    /// Assigns everything recorded from now on to this stage.
    void stage(Stage stage) {
        mark();
        stage_ = stage;
    }

    /// Returns true if the sequence was recorded to its end. The next one then begins again.
    bool is_complete() {
        if (cursor_.step < step_) {
            return false;
        }
        cursor_ = {};
        return true;
    }

  private:
    /// Calls record(first, count) for parts of `count` items, of whole work groups but the last.
    template <class Record>
    void in_parts(std::uint64_t count, std::uint64_t per_group, const Record& record) {
        if (step_++ != cursor_.step) {
            return; // Recorded before, or to come.
        }
        const bool is_new = cursor_.done == 0;
        while (cursor_.done < count) {
            budget_.is_in_new = is_new && cursor_.done >= budget_.items_of_new;
            if (budget_.is_spent()) {
                return;
            }
            const std::uint64_t groups = std::clamp<std::uint64_t>(
                std::min<std::uint64_t>(
                    {job_.plan.dispatch_items, budget_.items, budget_.items_of_new}) /
                    per_group,
                1, kMaxGroups);
            const std::uint64_t part = std::min(count - cursor_.done, groups * per_group);
            label();
            record(cursor_.done, part);
            cursor_.done += part;
            --budget_.dispatches;
            budget_.items -= std::min(budget_.items, part);
            ++job_.dispatches;
            has_unmarked_ = true;
        }
        cursor_ = {cursor_.step + 1, 0};
    }

    /// Copies a word to the control record.
    void copy_word(BufferRole role, std::size_t from, std::size_t to) const {
        const BufferRange& source = range(role);
        const BufferRange& control = range(BufferRole::control);
        const VkBufferCopy copy{source.offset + from, control.offset + to, 4};
        sampler_.vk.vkCmdCopyBuffer(commands_, source.buffer, control.buffer, 1, &copy);
    }

    template <class Commands>
    void transfer(const Commands& commands) {
        barrier_compute_to_transfer(sampler_.vk, commands_);
        commands();
        barrier_transfer_to_compute(sampler_.vk, commands_);
    }

    /// Begins that of the stage, with the first it has.
    void label() {
        if (stage_ && !is_labelled_) {
            begin_label(sampler_.vk, commands_, to_string(*stage_));
            is_labelled_ = true;
        }
    }

    /// Ends what is recorded of a stage.
    void mark() {
        if (is_labelled_) {
            end_label(sampler_.vk, commands_);
            is_labelled_ = false;
        }
        if (job_.clock != nullptr && has_unmarked_ && stage_) {
            job_.clock->mark(commands_, *stage_);
        }
        has_unmarked_ = false;
    }

    const BufferRange& range(BufferRole role) const {
        return job_.workspace[static_cast<std::size_t>(role)];
    }

    void bind(Kernel kernel, const gpu::Push& push, SetRole role) {
        // A round repeats small dispatches; binding anew what is bound costs as much as they do.
        // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): the device gets bits, not values.
        const bool same_push = std::memcmp(&push, &bound_push_, sizeof push) == 0;
        if (kernel == bound_ && role == bound_role_ && same_push) {
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
    Job::Impl& job_;
    Cursor whole_;
    Budget all_;
    Cursor& cursor_;
    Budget& budget_;
    std::uint32_t step_ = 0; ///< Step of the sequence, whether recorded or not.
    std::optional<Stage> stage_;
    bool has_unmarked_ = false;
    bool is_labelled_ = false;
    std::optional<Kernel> bound_;
    SetRole bound_role_ = SetRole::workspace;
    gpu::Push bound_push_{};
};

/// Counts, sorts by cell and draws the candidates of the stages at hand.
void draw_candidates(Recorder& recorder, Job::Impl& job) {
    const gpu::Push& push = job.push;
    const DomainKernels own = kernels_of(job.variant.domain);
    recorder.clear(BufferRole::cells,
                   job.has_cells() ? (VkDeviceSize{job.constants.cells} + 2) * 4 : 0);
    recorder.pass_over_faces(own.count);
    recorder.scan(job.constants.faces * push.stages + 1, SetRole::start_scan);
    if (job.has_cells()) {
        recorder.stage(Stage::bin);
        recorder.pass_over_candidates(own.bin, gpu::kDrawBlock, push);
        recorder.scan(job.constants.cells + 2, SetRole::cell_scan);
    }
    recorder.stage(Stage::draw);
    recorder.pass_over_candidates(own.draw, gpu::kDrawBlock, push);
}

} // namespace

bool record_begin(VkCommandBuffer commands, Job::Impl& job, Budget& budget) {
    if (job.begun.is_at_start() && !budget.is_spent()) {
        job.generation = next_number();
        job.is_begin_due = false;
    }
    Recorder recorder(commands, job, job.begun, budget);
    const gpu::Push& push = job.push;
    recorder.stage(Stage::count);
    recorder.change([&] { recorder.write_constants(); });
    recorder.change([&] {
        // All samples accepted so far are settled and in order.
        constexpr std::size_t kAccepted = offsetof(gpu::ControlRec, accepted);
        constexpr std::size_t kSettled = offsetof(gpu::ControlRec, settled);
        constexpr std::size_t kOrdered = offsetof(gpu::ControlRec, ordered);
        constexpr std::size_t kRest = offsetof(gpu::ControlRec, next_ordered);
        static_assert(kSettled == kAccepted + 4 && kOrdered == kSettled + 4 &&
                      kRest == kOrdered + 4);
        if (push.first_stage == 0) {
            recorder.fill(kAccepted, kRest - kAccepted, job.existing);
            recorder.fill(kRest, sizeof(gpu::ControlRec) - kRest, 0);
        } else {
            recorder.copy(kAccepted, kSettled);
            recorder.copy(kAccepted, kOrdered);
        }
        recorder.fill_below(kAccepted);
    });
    // Another plan divides the pool in another way: rows of tables would be taken for those of
    // later disks.
    const bool is_used = push.first_stage > 0 && !job.is_pool_divided;
    recorder.clear(BufferRole::pool, is_used ? 0 : VkDeviceSize{push.first_list_row} * 16);
    if (job.stages.is_drawn()) {
        draw_candidates(recorder, job);
    }
    recorder.single(Kernel::begin_chunk, push);
    if (job.has_shares) {
        recorder.pass_over_candidates(Kernel::drop, 32 * gpu::kWideLanes, push);
    }
    job.is_end_changed = false;
    const bool is_complete = recorder.is_complete();
    job.is_pool_divided = job.is_pool_divided && !is_complete;
    return is_complete;
}

bool record_count(VkCommandBuffer commands, Job::Impl& job, Budget& budget) {
    if (job.counted.is_at_start()) {
        if (!job.is_count_due) {
            return true;
        }
        if (!budget.is_spent()) {
            job.generation = next_number();
            job.is_count_due = false;
            job.is_stop_counted = !job.awaits_cut;
        }
    }
    Recorder recorder(commands, job, job.counted, budget);
    recorder.stage(Stage::count);
    recorder.change([&] {
        recorder.fill(offsetof(gpu::ControlRec, below), 4, 0);
        constexpr std::size_t kTo = offsetof(gpu::ControlRec, counted_order);
        if (job.is_stop_counted) {
            recorder.copy_order(job.constants.stop_count - 1, kTo);
        } else {
            recorder.fill(kTo, 4, job.cut->guess() - 1);
        }
    });
    recorder.pass_over_candidates(Kernel::count_orders, gpu::kSelectBlock, job.push);
    recorder.change([&] { recorder.fill_generation(); }); // Copies tell of it from now on.
    return recorder.is_complete();
}

bool record_finish(VkCommandBuffer commands, Job::Impl& job, Budget& budget) {
    Recorder recorder(commands, job, job.finished, budget);
    recorder.stage(Stage::gather);
    recorder.change(
        [&] { recorder.fill(offsetof(gpu::ControlRec, first_open), 4, gpu::kNoOrder); });
    recorder.clear(BufferRole::buckets, (VkDeviceSize{job.constants.buckets} + 2) * 4);
    recorder.pass_over_samples(Kernel::order_count);
    recorder.scan(job.constants.buckets + 2, SetRole::bucket_scan);
    recorder.pass_over_samples(Kernel::order_place);
    recorder.pass_over_samples(Kernel::order_write);
    recorder.change([&] {
        recorder.copy(offsetof(gpu::ControlRec, next_ordered), offsetof(gpu::ControlRec, ordered));
    });
    return recorder.is_complete();
}

namespace {

/// Records what is left of other calls: nothing may come between. At most one has something left.
void record_rest(VkCommandBuffer commands, Job::Impl& job, const Cursor* but = nullptr) {
    Budget all;
    const auto rest = [&](const Cursor& cursor, const auto& record) {
        if (&cursor != but && !cursor.is_at_start()) {
            record(commands, job, all);
        }
    };
    rest(job.begun, geodisk::record_begin);
    rest(job.counted, geodisk::record_count);
    rest(job.finished, geodisk::record_finish);
}

void add_select(Recorder& recorder, Job::Impl& job) {
    recorder.stage(Stage::select);
    if (std::exchange(job.is_end_changed, false)) {
        recorder.single(Kernel::resume, job.push);
    }
    recorder.dispatch_indirect(kernels_of(job.variant.domain).select,
                               offsetof(gpu::ControlRec, select_x));
}

void add_detect(Recorder& recorder, Job::Impl& job) {
    recorder.stage(Stage::detect);
    const bool by_groups = job.variant.groups && job.plan.disks_by == DisksBy::groups;
    const Kernel kernel = by_groups ? Kernel::group_detect : lanes_kernel(job.variant);
    const gpu::Push large = job.large_push();
    for (std::uint32_t pass = 0; pass < job.plan.detect_passes; ++pass) {
        recorder.dispatch_indirect(kernel, offsetof(gpu::ControlRec, detect_x));
        if (job.push.large_groups > 0) {
            recorder.dispatch_indirect(Kernel::group_detect, offsetof(gpu::ControlRec, large_x),
                                       large);
        }
    }
}

void add_resolve(Recorder& recorder) {
    recorder.stage(Stage::resolve);
    recorder.dispatch_indirect(Kernel::resolve, offsetof(gpu::ControlRec, groups_x));
}

} // namespace

bool Sampler::record_begin(VkCommandBuffer commands, Job& job,
                           std::uint32_t dispatches) const noexcept {
    record_rest(commands, *job.impl_, &job.impl_->begun);
    Budget budget{dispatches};
    return geodisk::record_begin(commands, *job.impl_, budget);
}

bool Sampler::record_count(VkCommandBuffer commands, Job& job,
                           std::uint32_t dispatches) const noexcept {
    record_rest(commands, *job.impl_, &job.impl_->counted);
    Budget budget{dispatches};
    return geodisk::record_count(commands, *job.impl_, budget);
}

void Sampler::record_select(VkCommandBuffer commands, Job& job) const noexcept {
    record_rest(commands, *job.impl_);
    Recorder recorder(commands, *job.impl_);
    add_select(recorder, *job.impl_);
}

void Sampler::record_detect(VkCommandBuffer commands, Job& job) const noexcept {
    record_rest(commands, *job.impl_);
    Recorder recorder(commands, *job.impl_);
    add_detect(recorder, *job.impl_);
}

void Sampler::record_resolve(VkCommandBuffer commands, Job& job) const noexcept {
    record_rest(commands, *job.impl_);
    Recorder recorder(commands, *job.impl_);
    add_resolve(recorder);
}

void Sampler::record_rounds(VkCommandBuffer commands, Job& job,
                            std::uint32_t rounds) const noexcept {
    record_rest(commands, *job.impl_);
    Recorder recorder(commands, *job.impl_);
    for (std::uint32_t round = 0; round < rounds; ++round) {
        add_select(recorder, *job.impl_);
        add_detect(recorder, *job.impl_);
        add_resolve(recorder);
    }
}

void Sampler::record_rewind(VkCommandBuffer commands, Job& job) const noexcept {
    record_rest(commands, *job.impl_);
    job.impl_->generation = next_number();
    // The batch was selected with the slots of an earlier plan, never fewer than now.
    Recorder recorder(commands, *job.impl_);
    const gpu::Push& push = job.impl_->push;
    recorder.change([&] { recorder.fill_generation(); });
    // No lane has a slot, and no row of a table a disk.
    recorder.clear(BufferRole::pool, VkDeviceSize{push.first_list_row} * 16);
    job.impl_->is_pool_divided = false;
    recorder.pass(Kernel::rewind, job.impl_->max_slots, impl_->choices.tuning.slot_local_size,
                  push);
    recorder.change([&] {
        for (const std::size_t word :
             {offsetof(gpu::ControlRec, slots_used), offsetof(gpu::ControlRec, undecided),
              offsetof(gpu::ControlRec, overflow)}) {
            recorder.fill(word, 4, 0);
        }
    });
    recorder.single(Kernel::resume, push);
    job.impl_->is_end_changed = false;
}

bool Sampler::record_finish(VkCommandBuffer commands, Job& job,
                            std::uint32_t dispatches) const noexcept {
    record_rest(commands, *job.impl_, &job.impl_->finished);
    Budget budget{dispatches};
    return geodisk::record_finish(commands, *job.impl_, budget);
}

} // namespace geodisk
