#include "engine/run/run.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/domain/domain_impl.hpp"
#include "engine/job/plan.hpp"
#include "engine/run/division.hpp"
#include "engine/run/maximal_run.hpp"
#include "engine/run/memory_budget.hpp"
#include "engine/run/run_memory.hpp"
#include "engine/run/run_result.hpp"
#include "engine/run/submissions.hpp"
#include "support/blocks.hpp"
#include "support/try.hpp"
#include "vk/barriers.hpp"

namespace geodisk {
namespace {

/// Returns true if some candidates of the batch in progress may be decided. It cannot be restarted
/// then: one that is blocked for good, but not rejected yet, would be idle again.
bool is_deciding(const gpu::ControlRec& control) {
    return control.slots_used > 0 && control.incomplete == 0;
}

/// One run: its memory, its job and its submissions.
class Run {
  public:
    /// Takes at most so many bytes on the device. `before` reports earlier starts of the run.
    Run(Runner::Impl& runner, const Domain& domain, std::uint64_t max_bytes,
        const RunReport& before, DiskRecords* records)
        : runner_(runner), domain_(domain), max_bytes_(max_bytes), of_(Domain::Impl::of(domain)),
          memory_(*runner.workspace), kept_(runner.jobs[index_of(of_.kernels.domain)]),
          job_(kept_.job), submissions_(runner, memory_, of_), records_(records) {
        report_.seconds = before.seconds;
        report_.starts = before.starts + 1;
    }
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;
    /// Returns the samples, or nothing if the run must start over with room for
    /// `plan.sample_capacity` samples.
    Task<Result<std::optional<SampleSet>>> go(RunPlan& plan);
    const RunReport& report() const { return report_; }

  private:
    Result<Done> prepare(const RunPlan& plan);
    Task<Result<Done>> compile_at_dispatch();
    Task<Result<Done>> upload();
    Task<Result<Done>> stage(BufferRole role, std::size_t at, const UploadPart& part);
    void write_staged();
    Task<Result<Done>> submit_piece();
    Task<Result<Done>> end_piece();
    Task<Result<Advice>> sample();
    Task<Result<Done>> follow(Advice advice);
    Task<Result<std::uint64_t>> candidates(Advice advice);
    /// Bytes that the pool may grow to: at most so many, and as the device has left.
    std::uint64_t pool_bytes(std::uint64_t most) const;
    Result<Done> grow(const RunPlan& grown);
    Result<Done> change_plan(const RunPlan& changed);
    bool is_past_avoided(const Advice& advice) const;
    bool fit_samples(Advice& advice) const;
    Task<Result<Done>> enlarge_samples(std::uint32_t capacity);
    std::uint32_t record_all(VkCommandBuffer commands, Budget& budget);
    void record_samples(VkCommandBuffer commands);
    Task<Result<std::vector<gpu::SampleRec>>> read_samples();
    Task<Result<Done>> read_records();
    Job::Impl& job() { return Job::Impl::of(*job_); }
    const gpu::ControlRec& control() const { return submissions_.control(); }

    Runner::Impl& runner_;
    const Domain& domain_;
    const std::uint64_t max_bytes_;
    const Domain::Impl& of_;
    RunMemory& memory_;
    Runner::Impl::KeptJob& kept_;
    std::optional<Job>& job_;
    Submissions submissions_;
    // Work that follows in the submission that draws the candidates, or puts the samples in order.
    const Submissions::InOne after_begin_ = [this](VkCommandBuffer commands, Budget& budget) {
        return record_all(commands, budget);
    };
    const Submissions::InOne after_finish_ = [this](VkCommandBuffer commands, Budget&) {
        record_samples(commands);
        return 0u;
    };
    struct StagedRecords {
        const UploadPart* part;
        std::size_t begin, count;
        std::size_t place; ///< Among all that are staged.
        std::byte* out;
    };
    std::vector<StagedRecords> staged_; ///< Yet to be written.
    std::size_t staged_records_ = 0;
    bool has_piece_ = false; ///< A piece of the upload is in flight.
    /// Plans for the disks of points to avoid, and for all others, once the pool grew for the
    /// former.
    std::optional<RunPlan> for_avoided_, for_others_;
    bool is_for_avoided_ = false; ///< The plan in use is that for points to avoid.
    DiskRecords* records_;        ///< Destination of what disks record, or null.
    RunReport report_;
};

Result<Done> Run::prepare(const RunPlan& plan) {
    if (plan.pool_bytes() > runner_.options.pool_bytes) {
        return Error{Status::workspace_too_small,
                     "the plan asked for takes a pool of " + std::to_string(plan.pool_bytes()) +
                         " bytes, which may take " + std::to_string(runner_.options.pool_bytes)};
    }
    const auto needs = runner_.sampler.workspace_needs(domain_, plan);
    GEODISK_TRY(needs);
    const std::uint64_t uploaded = upload_bytes(runner_.sampler, domain_);
    GEODISK_TRY(memory_.allocate(*needs, uploaded, max_bytes_));
    if (job_ && kept_.made == memory_.made()) {
        GEODISK_TRY(job_->renew(domain_, plan));
    } else {
        job_.reset();
        auto job = runner_.sampler.make_job(domain_, plan, memory_.workspace());
        GEODISK_TRY(job);
        job_.emplace(std::move(*job));
        kept_.made = memory_.made();
    }
    if (runner_.clock) {
        job().clock = &*runner_.clock;
        runner_.clock->reset();
    }
    submissions_.use(*job_, plan);
    return Done{};
}

/// Dispatches every kernel of the job once with no work groups, since some drivers compile only at
/// the first dispatch. Does nothing if that was done before.
Task<Result<Done>> Run::compile_at_dispatch() {
    if (kept_.dispatched == job().own_pipelines) {
        co_return Done{};
    }
    const auto record = [&](VkCommandBuffer commands) {
        const DeviceTable& vk = job().sampler->vk;
        const gpu::Push push{};
        for (std::size_t i = 0; i < kSetRoles * kKernels; ++i) {
            const std::size_t k = i % kKernels;
            const std::size_t role = i / kKernels;
            const VkPipeline pipeline = job().has(k) ? job().pipeline(k) : VK_NULL_HANDLE;
            const bool is_scan = k == static_cast<std::size_t>(Kernel::sum_blocks) ||
                                 k == static_cast<std::size_t>(Kernel::scan_sums) ||
                                 k == static_cast<std::size_t>(Kernel::scan_blocks);
            if (pipeline == VK_NULL_HANDLE || (role > 0 && !is_scan)) {
                continue;
            }
            // llvmpipe compiles again for buffers of other sizes, so scans take all their sets.
            const VkPipelineLayout layout = job().sampler->pipelines.layout(k);
            vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
            vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1,
                                       &job().sets[role][k], 0, nullptr);
            vk.vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof push,
                                  &push);
            vk.vkCmdDispatch(commands, 0, 0, 0);
            barrier_compute_to_compute(vk, commands);
        }
    };
    auto done = runner_.submitter->submit(record);
    if (done) {
        done = co_await runner_.submitter->ended();
    }
    if (done) {
        kept_.dispatched = job().own_pipelines;
    }
    co_return done;
}

/// Stages what the device lacks. Submits it in pieces if it does not fit; the last piece goes with
/// the first submission of the job.
Task<Result<Done>> Run::upload() {
    std::array<UploadParts, kBufferRoles> all;
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        const auto role = static_cast<BufferRole>(i);
        const std::size_t held =
            memory_.holds(role, of_.meshes) ? runner_.sampler.mesh_bytes(domain_, role) : 0;
        auto parts = of_.upload_parts(job_->plan(), role);
        GEODISK_CO_TRY(parts);
        all[i] = std::move(*parts);
        std::size_t at = 0;
        for (const UploadPart& part : all[i]) {
            if (at >= held) {
                if (auto staged = co_await stage(role, at, part); !staged) {
                    co_return staged;
                }
            }
            at += part.bytes();
        }
        memory_.set_held(role, of_.meshes);
    }
    write_staged();
    co_return co_await end_piece();
}

/// Stages a part of the data of a buffer, from byte `at` of it on.
Task<Result<Done>> Run::stage(BufferRole role, std::size_t at, const UploadPart& part) {
    for (std::size_t done = 0; done < part.records;) {
        const std::size_t count = std::min(part.records - done, memory_.room() / part.record_bytes);
        if (count == 0) {
            if (auto submitted = co_await submit_piece(); !submitted) {
                co_return submitted;
            }
            continue;
        }
        const std::size_t bytes = count * part.record_bytes;
        const auto out = memory_.stage(role, at + done * part.record_bytes, bytes);
        staged_.push_back({&part, done, count, staged_records_, out.data()});
        staged_records_ += count;
        report_.uploaded += bytes;
        done += count;
    }
    co_return Done{};
}

/// Writes what is staged.
void Run::write_staged() {
    for_blocks(runner_.options.threads, staged_records_, [&](std::size_t begin, std::size_t end) {
        auto range = std::ranges::upper_bound(staged_, begin, {}, &StagedRecords::place) - 1;
        for (; begin < end; ++range) {
            const std::size_t first = begin - range->place;
            const std::size_t last = std::min(range->count, end - range->place);
            range->part->write(range->begin + first, range->begin + last,
                               range->out + first * range->part->record_bytes);
            begin = range->place + last;
        }
    });
    staged_.clear();
    staged_records_ = 0;
}

/// Submits what is staged once the piece before is uploaded.
Task<Result<Done>> Run::submit_piece() {
    write_staged();
    auto before = co_await end_piece();
    if (before) {
        before = runner_.submitter->submit(
            [&](VkCommandBuffer commands) { memory_.record_uploads(commands); });
        has_piece_ = bool(before);
    }
    co_return before;
}

Task<Result<Done>> Run::end_piece() {
    if (std::exchange(has_piece_, false)) {
        co_return co_await runner_.submitter->ended();
    }
    co_return Done{};
}

Result<Done> Run::grow(const RunPlan& grown) {
    ++report_.regrown;
    GEODISK_TRY(memory_.enlarge_pool(grown.pool_bytes()));
    if (control().next_sample < of_.avoided) {
        for_others_ = for_others_.value_or(submissions_.plan());
        for_avoided_ = grown;
        is_for_avoided_ = true;
    } else if (for_others_) {
        for_others_ = grown;
    }
    auto set = change_plan(grown);
    kept_.made = memory_.made();
    return set;
}

Result<Done> Run::change_plan(const RunPlan& changed) {
    RunPlan& plan = submissions_.plan();
    const RunPlan before = std::exchange(plan, changed);
    plan.dispatch_items = before.dispatch_items;
    plan.step_budget = before.step_budget;
    plan.detect_passes = before.detect_passes;
    plan.sample_capacity = before.sample_capacity;
    return job_->set_plan(plan, memory_.range(BufferRole::pool));
}

/// Returns true if the plan is that of disks of points to avoid, these are done in this chunk, and
/// the plan can be changed now. They may be far larger than all others and then leave room for few
/// slots.
bool Run::is_past_avoided(const Advice& advice) const {
    const bool is_past = control().next_sample >= of_.avoided && !is_deciding(control());
    return is_for_avoided_ && advice.next == Next::go_on && is_past;
}

Task<Result<Done>> Run::enlarge_samples(std::uint32_t capacity) {
    auto enlarged = co_await memory_.enlarge_samples(job_->sample_bytes(capacity),
                                                     control().accepted, max_bytes_);
    if (!enlarged) {
        co_return enlarged;
    }
    submissions_.plan().sample_capacity = capacity;
    auto set =
        job_->set_samples(capacity, memory_.range(BufferRole::samples),
                          memory_.range(BufferRole::accepted), memory_.range(BufferRole::buckets));
    kept_.made = memory_.made();
    co_return set;
}

/// Samples until the run is complete, or `larger_samples` does not fit and it must start over.
Task<Result<Advice>> Run::sample() {
    for (;;) {
        // Free memory is queried only where it matters.
        const bool grows = control().overflow != 0;
        const std::uint64_t most = grows ? pool_bytes(runner_.options.pool_bytes) : 0;
        auto advice = job().advance(control(), most, LastResort::none);
        if (!advice && grows && advice.error().status == Status::workspace_too_small) {
            // A single disk that is too large for the pool may take all that the device has.
            advice = job_->advance(control(), pool_bytes(~std::uint64_t{0}));
        }
        if (!advice || advice->next == Next::complete ||
            (advice->next == Next::larger_samples && !fit_samples(*advice))) {
            co_return advice;
        }
        GEODISK_CO_TRY(co_await follow(*advice));
    }
}

/// Returns true if the samples advised fit beside the pool as it is. If only the fewest that go on
/// fit, lowers the advice to those and returns true.
bool Run::fit_samples(Advice& advice) const {
    std::uint64_t others = memory_.bytes();
    for (const BufferRole role : {BufferRole::samples, BufferRole::accepted, BufferRole::buckets}) {
        others -= memory_.range(role).size;
    }
    const auto fits = [&](std::uint32_t capacity) {
        const auto bytes = job_->sample_bytes(capacity);
        return others + bytes[0] + bytes[1] + bytes[2] <= max_bytes_;
    };
    // advance() has found that it fits 32 bits.
    const auto least =
        static_cast<std::uint32_t>(min_sample_capacity(control(), job_->plan().slots));
    if (!fits(advice.sample_capacity) && fits(least)) {
        advice.sample_capacity = least;
    }
    return fits(advice.sample_capacity);
}

std::uint64_t Run::pool_bytes(std::uint64_t most) const {
    const std::uint64_t others = memory_.bytes() - memory_.range(BufferRole::pool).size;
    const std::uint64_t allowed = std::min(max_bytes_, runner_.bytes_allowed());
    const std::uint64_t left = allowed > others ? allowed - others : 0;
    // It has what it has.
    return std::max(std::min(left, most), memory_.range(BufferRole::pool).size);
}

Task<Result<Done>> Run::follow(Advice advice) {
    Result<Done> enlarged = Done{};
    bool starts_over = advice.next != Next::go_on; // The batch in progress.
    if (is_past_avoided(advice)) {
        is_for_avoided_ = false;
        starts_over = true;
        enlarged = change_plan(*for_others_);
    }
    switch (advice.next) {
    case Next::begin:
        ++report_.chunks;
        if (for_avoided_ && !std::exchange(is_for_avoided_, true)) {
            enlarged = change_plan(*for_avoided_);
        }
        if (!enlarged) {
            co_return enlarged;
        }
        co_return co_await submissions_.run_passes(record_begin, after_begin_);
    case Next::count:
        co_return co_await submissions_.run_passes(record_count, {});
    case Next::finish:
        co_return co_await submissions_.run_passes(record_finish, after_finish_);
    case Next::larger_pool:
        enlarged = grow(advice.plan);
        break;
    case Next::larger_samples:
        enlarged = co_await enlarge_samples(advice.sample_capacity);
        break;
    default:
        break;
    }
    if (!enlarged) {
        co_return enlarged;
    }
    co_return co_await submissions_.run_rounds(starts_over);
}

/// Records all of the run, if it is small. Returns the rounds in it.
std::uint32_t Run::record_all(VkCommandBuffer commands, Budget& budget) {
    if (of_.stages.is_counted() || budget.items < job_->plan().sample_capacity) {
        return 0;
    }
    const std::uint32_t rounds = submissions_.record_rounds(commands);
    record_finish(commands, job(), budget);
    record_samples(commands);
    return rounds;
}

/// All that there may be, so that they come with the control record.
void Run::record_samples(VkCommandBuffer commands) {
    memory_.record_samples(commands, VkDeviceSize{submissions_.plan().sample_capacity} *
                                         sizeof(gpu::SampleRec));
}

/// Candidates of a run that is complete, which are counted if it stopped early.
Task<Result<std::uint64_t>> Run::candidates(Advice advice) {
    if (advice.candidates == 0) {
        GEODISK_CO_TRY(co_await submissions_.run_passes(record_count, {}));
        const auto counted = job_->advance(control());
        GEODISK_CO_TRY(counted);
        advice = *counted;
    }
    co_return advice.candidates;
}

Task<Result<std::vector<gpu::SampleRec>>> Run::read_samples() {
    std::vector<gpu::SampleRec> samples(control().ready);
    const auto bytes = std::as_writable_bytes(std::span(samples));
    if (const auto there = memory_.samples(); there.size() >= bytes.size()) {
        std::copy_n(there.begin(), bytes.size(), bytes.begin());
        co_return samples;
    }
    GEODISK_CO_TRY(co_await memory_.read(BufferRole::samples, bytes));
    co_return samples;
}

Task<Result<Done>> Run::read_records() {
    std::array<std::uint32_t, 4> head{}; // Their number, the room, the row where they begin.
    auto read = co_await memory_.read(BufferRole::weights, std::as_writable_bytes(std::span(head)));
    if (!read) {
        co_return read;
    }
    records_->wanted = head[0];
    const std::size_t count = std::min(head[0], head[1]);
    std::span<std::byte> out;
    if (of_.kernels.ending == Ending::light) {
        records_->lights.resize(count);
        out = std::as_writable_bytes(std::span(records_->lights));
    } else {
        records_->hits.resize(count);
        out = std::as_writable_bytes(std::span(records_->hits));
    }
    co_return co_await memory_.read(BufferRole::weights, out, head[2] * sizeof head);
}

Task<Result<std::optional<SampleSet>>> Run::go(RunPlan& plan) {
    double start = runner_.now();
    GEODISK_CO_TRY(runner_.sampler.prepare(domain_));
    report_.seconds.compile += runner_.now() - start;
    start = runner_.now();
    GEODISK_CO_TRY(prepare(plan));
    report_.seconds.upload += runner_.now() - start;
    start = runner_.now();
    GEODISK_CO_TRY(co_await compile_at_dispatch());
    report_.seconds.compile += runner_.now() - start;
    start = runner_.now();
    GEODISK_CO_TRY(co_await upload());
    report_.seconds.upload += runner_.now() - start;
    start = runner_.now();
    const auto advice = co_await sample();
    report_.seconds.sample += runner_.now() - start;
    GEODISK_CO_TRY(advice);
    if (advice->next == Next::larger_samples) {
        plan.sample_capacity = std::max(plan.sample_capacity, advice->sample_capacity);
        co_return std::optional<SampleSet>();
    }
    start = runner_.now();
    auto samples = co_await read_samples();
    GEODISK_CO_TRY(samples);
    if (records_ != nullptr) {
        GEODISK_CO_TRY(co_await read_records());
    }
    report_.seconds.readback += runner_.now() - start;
    const auto darts = co_await candidates(*advice);
    GEODISK_CO_TRY(darts);
    report_.candidates = static_cast<std::uint32_t>(*darts);
    report_.dispatches = static_cast<std::uint32_t>(job().dispatches);
    take_counts(control(), report_);
    report_.plan = submissions_.plan();
    const bool has_trimmed = report_.plan.trims || (for_avoided_ && for_avoided_->trims);
    report_.guard = std::max(of_.guard_for(submissions_.plan().error_bound),
                             job().error.error_of(report_.longest_chain, has_trimmed));
    report_.device_bytes = memory_.bytes();
    if (runner_.clock) {
        report_.stages = runner_.clock->seconds();
    }
    co_return std::optional(to_set(of_, *samples, report_));
}

/// A run that fails, whether by an error or an exception, leaves nothing to those to come.
struct Releaser {
    Runner::Impl& runner;
    bool has_succeeded = false;
    ~Releaser() {
        if (!has_succeeded) {
            runner.submitter->give_up();
            runner.release();
            runner.paces.clear();
        }
    }
};

} // namespace

Task<Result<SampleSet>> run(Runner::Impl& runner, const Domain& domain) {
    const auto& maximal = Domain::Impl::of(domain).maximal;
    return maximal ? run_maximal(runner, *maximal) : run_or_divide(runner, domain);
}

Task<Result<SampleSet>> run_job(Runner::Impl& runner, const Domain& domain, DiskRecords* records) {
    GEODISK_CO_TRY(runner.submitter->ready());
    Releaser releaser{runner};
    std::uint64_t most = runner.bytes_allowed();
    std::uint32_t samples = 0; // That there has to be room for.
    RunReport before;
    for (;;) {
        const auto fitting = fit_within(runner, domain, most, samples);
        GEODISK_CO_TRY(fitting);
        RunPlan plan = fitting->plan;
        runner.keep();
        Run run(runner, domain, most, before, records);
        auto set = co_await run.go(plan);
        if (set && *set) {
            releaser.has_succeeded = true;
            co_return std::move(**set);
        }
        before = run.report();
        if (set) {
            samples = plan.sample_capacity;
            continue;
        }
        if (!runner.workspace->was_short()) {
            co_return set.error();
        }
        runner.release();
        const auto less = fit_plan(runner, domain, fitting->bytes / 2, samples);
        if (!less || less->bytes >= fitting->bytes) {
            Error error = set.error();
            error.message += "; the run takes " + std::to_string(fitting->bytes) +
                             " bytes on the device at least";
            co_return error;
        }
        most = less->fits ? fitting->bytes / 2 : (fitting->bytes + less->bytes) / 2;
    }
}

} // namespace geodisk
