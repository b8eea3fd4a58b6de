#include "engine/run.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "constants.h"
#include "engine/domain_impl.hpp"
#include "engine/plan.hpp"
#include "engine/run_memory.hpp"

namespace geodisk {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// Submissions start small and grow towards this time, so that no watchdog bites and progress and
// cancellation stay prompt.
constexpr double kTargetSeconds = 0.1;
constexpr std::uint32_t kMostRounds = 256;
constexpr std::uint32_t kMostPasses = 64;
// Counts of candidates before an order until that of a number of darts is found.
constexpr std::uint32_t kMostGuesses = 64;

constexpr std::uint64_t wide(std::uint32_t low, std::uint32_t high) {
    return std::uint64_t{high} << 32 | low;
}

/// One run: its memory, its job and what the device reported last.
class Run {
  public:
    Run(Runner::Impl& runner, const Domain& domain)
        : runner_(runner), domain_(domain), of_(Domain::Impl::of(domain)), memory_(runner) {}
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;
    ~Run() {
        if (runner_.submitter->abandoned()) {
            runner_.settle(); // For the job.
        }
    }

    Result<SampleSet> go(const ProgressCallback& progress, const RunPlan& plan);

  private:
    Result<Done> prepare(const RunPlan& plan);
    Result<Done> upload();
    Result<Done> sample(const ProgressCallback& progress);
    Result<Done> begin_chunk();
    Result<Done> cut_darts();
    Result<Done> decide_chunk(const ProgressCallback& progress);
    Result<Done> gather_chunk();
    std::uint32_t stages_left() const;
    bool has_all() const { return of_.stop_count != 0 && control_.accepted >= of_.stop_count; }
    Progress how_far() const;
    Result<Done> submit(const std::function<void(VkCommandBuffer)>& record);
    Result<Done> run_rounds(std::uint32_t rounds, bool rewind);
    Result<std::uint32_t> count_before(std::uint32_t order);
    Result<Done> act_on_overflow();
    Result<Done> grow();
    Result<Done> detect_longer();
    Result<Done> enlarge_samples();
    Result<std::vector<gpu::SampleRec>> read_samples();
    SampleSet to_set(const std::vector<gpu::SampleRec>& records) const;

    Runner::Impl& runner_;
    const Domain& domain_;
    const Domain::Impl& of_;
    RunMemory memory_;
    std::optional<Job> job_;
    std::uint32_t slots_ = 0; ///< Of the first plan.
    std::uint32_t lanes_ = 0;
    std::uint32_t next_stage_ = 0;  ///< The first behind those of this chunk.
    std::uint64_t thrown_ = 0;      ///< Candidates of the chunks before this one.
    std::uint64_t chunk_darts_ = 0; ///< Candidates of this chunk that take part.
    gpu::ControlRec control_{};
    RunReport report_;
};

Result<Done> Run::prepare(const RunPlan& plan) {
    if (plan.pool_bytes() > runner_.options.pool_bytes) {
        return Error{Status::workspace_too_small,
                     "the plan asked for takes a pool of " + std::to_string(plan.pool_bytes()) +
                         " bytes, which may take " + std::to_string(runner_.options.pool_bytes)};
    }
    const auto needs = runner_.sampler.workspace_needs(domain_, plan);
    if (!needs) {
        return needs.error();
    }
    if (auto allocated = memory_.allocate(*needs); !allocated) {
        return allocated;
    }
    auto job = runner_.sampler.make_job(domain_, plan, memory_.workspace());
    if (!job) {
        return job.error();
    }
    job_.emplace(std::move(*job));
    if (runner_.clock) {
        Job::Impl::of(*job_).clock = &*runner_.clock;
        runner_.clock->reset();
    }
    slots_ = plan.slots;
    lanes_ = plan.lanes;
    report_.guard = of_.guard_for(plan.error_bound);
    return Done{};
}

Result<Done> Run::upload() {
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        const auto role = static_cast<BufferRole>(i);
        std::vector<std::byte> bytes(runner_.sampler.upload_size(domain_, role));
        if (bytes.empty()) {
            continue;
        }
        auto written = runner_.sampler.write_upload(domain_, job_->plan(), role, bytes);
        if (!written) {
            return written;
        }
        if (auto uploaded = memory_.upload(role, bytes); !uploaded) {
            return uploaded;
        }
    }
    return Done{};
}

/// Records, and reads the control record afterwards.
Result<Done> Run::submit(const std::function<void(VkCommandBuffer)>& record) {
    auto done = runner_.run_timed([&](VkCommandBuffer commands) {
        record(commands);
        memory_.record_control(commands);
    });
    if (!done) {
        return done;
    }
    control_ = memory_.control();
    if (control_.abi != gpu::kAbi) {
        return Error{Status::internal, "the device did not write its control record"};
    }
    return Done{};
}

Result<Done> Run::run_rounds(std::uint32_t rounds, bool rewind) {
    return submit([&](VkCommandBuffer commands) {
        if (rewind) {
            runner_.sampler.record_rewind(commands, *job_);
        }
        runner_.sampler.record_rounds(commands, *job_, rounds);
    });
}

/// Candidates of the chunk that are of lower order.
Result<std::uint32_t> Run::count_before(std::uint32_t order) {
    auto counted = submit(
        [&](VkCommandBuffer commands) { Job::Impl::of(*job_).record_count(commands, order); });
    if (!counted) {
        return counted.error();
    }
    return control_.below;
}

Result<Done> Run::grow() {
    if ((control_.overflow & gpu::kOverflowChain) != 0) {
        return Error{Status::internal, "a window crossed more than " +
                                           std::to_string(gpu::kLongestChain) +
                                           " edges; the mesh defeats single precision"};
    }
    // As many slots as the job was made with, if the pool may be as large as that takes.
    RunPlan before = job_->plan();
    before.slots = slots_;
    before.lanes = lanes_;
    const auto grown =
        runner_.sampler.grow_plan(before, control_.overflow, runner_.options.pool_bytes);
    if (!grown) {
        return grown.error();
    }
    ++report_.regrown;
    if (auto enlarged = memory_.enlarge_pool(grown->pool_bytes()); !enlarged) {
        return enlarged;
    }
    return job_->set_plan(*grown, memory_.range(BufferRole::pool));
}

/// Batches take more than a round: fewer of the other dispatches go idle when a round detects
/// longer.
Result<Done> Run::detect_longer() {
    RunPlan plan = job_->plan();
    plan.detect_passes = std::min(2 * plan.detect_passes, kMostPasses);
    return job_->set_plan(plan);
}

/// Room for half as many samples again, and a batch.
Result<Done> Run::enlarge_samples() {
    const DeviceLimits& limits = runner_.sampler.report().limits;
    const std::uint64_t most = limits.max_storage_buffer_range / sizeof(gpu::SampleRec);
    const std::uint64_t least = std::uint64_t{control_.accepted} + job_->plan().slots + 1;
    const std::uint64_t capacity = std::min(least + control_.accepted / 2, std::max(most, least));
    if (capacity > most) {
        return Error{Status::job_too_large,
                     "the " + std::to_string(control_.accepted) + " samples so far take " +
                         std::to_string(capacity * sizeof(gpu::SampleRec)) + " bytes, but " +
                         runner_.sampler.report().name + " binds at most " +
                         std::to_string(limits.max_storage_buffer_range) +
                         "; raise the minimum distance"};
    }
    const auto room = static_cast<std::uint32_t>(capacity);
    if (auto enlarged = memory_.enlarge_samples(job_->sample_bytes(room), control_.accepted);
        !enlarged) {
        return enlarged;
    }
    return job_->set_samples(room, memory_.range(BufferRole::samples),
                             memory_.range(BufferRole::accepted),
                             memory_.range(BufferRole::buckets));
}

/// Stages to draw next.
std::uint32_t Run::stages_left() const {
    const Stages& stages = of_.stages;
    if (has_all()) {
        return 0;
    }
    if (stages.throws != 0) {
        return thrown_ < stages.throws ? 1 : 0;
    }
    return std::min(stages.pool_stages() - next_stage_, job_->plan().stages);
}

Result<Done> Run::sample(const ProgressCallback& progress) {
    for (std::uint32_t count = stages_left(); count > 0; count = stages_left()) {
        if (auto chunk = job_->set_stages(next_stage_, count); !chunk) {
            return chunk;
        }
        next_stage_ += count;
        if (auto begun = begin_chunk(); !begun) {
            return begun;
        }
        if (auto decided = decide_chunk(progress); !decided) {
            return decided;
        }
        if (auto gathered = gather_chunk(); !gathered) {
            return gathered;
        }
        thrown_ += chunk_darts_;
        ++report_.chunks;
    }
    return Done{};
}

Result<Done> Run::begin_chunk() {
    auto begun =
        submit([&](VkCommandBuffer commands) { runner_.sampler.record_begin(commands, *job_); });
    if (!begun) {
        return begun;
    }
    if ((control_.overflow & gpu::kOverflowCandidates) != 0) {
        return Error{Status::internal, "a stage has " + std::to_string(control_.drawn) +
                                           " candidates, and there is room for " +
                                           std::to_string(Job::Impl::of(*job_).push.capacity)};
    }
    chunk_darts_ = control_.drawn;
    const std::uint32_t throws = of_.stages.throws;
    return throws != 0 && thrown_ + control_.drawn > throws ? cut_darts() : Result<Done>(Done{});
}

/// Finds the order below which there are just as many darts as are to be thrown.
Result<Done> Run::cut_darts() {
    const auto wanted = static_cast<std::uint32_t>(of_.stages.throws - thrown_);
    std::uint64_t low = 0, high = Job::Impl::of(*job_).push.end_order;
    std::uint64_t low_count = 0, high_count = control_.drawn;
    for (std::uint32_t guess = 0; high_count != wanted && low_count != wanted; ++guess) {
        // Orders are spread evenly, so a few guesses by proportion do; halves where they do not.
        const double part = guess < kMostGuesses / 4
                                ? static_cast<double>(wanted - low_count) /
                                      static_cast<double>(high_count - low_count)
                                : 0.5;
        const auto step = static_cast<std::uint64_t>(part * static_cast<double>(high - low));
        const std::uint64_t middle = low + std::clamp<std::uint64_t>(step, 1, high - low - 1);
        const auto count = count_before(static_cast<std::uint32_t>(middle));
        if (!count) {
            return count.error();
        }
        (*count < wanted ? low : high) = middle;
        (*count < wanted ? low_count : high_count) = *count;
        if (high - low <= 1) {
            break; // Several of one order: they all take part.
        }
    }
    const bool at_low = low_count == wanted;
    chunk_darts_ = at_low ? low_count : high_count;
    Job::Impl::of(*job_).push.end_order = static_cast<std::uint32_t>(at_low ? low : high);
    return submit([&](VkCommandBuffer commands) { Job::Impl::of(*job_).record_restart(commands); });
}

Result<Done> Run::decide_chunk(const ProgressCallback& progress) {
    std::uint32_t rounds = 1;
    while (control_.done == 0) {
        const bool rewind = control_.overflow != 0;
        if (rewind) {
            if (auto acted = act_on_overflow(); !acted) {
                return acted;
            }
        }
        const auto start = Clock::now();
        const std::uint32_t batches = control_.iterations;
        if (auto done = run_rounds(rounds, rewind); !done) {
            return done;
        }
        if (control_.incomplete > 0 && rounds >= 2 * (control_.iterations - batches)) {
            if (auto more = detect_longer(); !more) {
                return more;
            }
        }
        const double took = seconds_since(start);
        rounds = took < kTargetSeconds / 2   ? std::min(2 * rounds, kMostRounds)
                 : took > 2 * kTargetSeconds ? std::max(rounds / 2, 1u)
                                             : rounds;
        if (progress && !progress(how_far())) {
            return Error{Status::cancelled, "cancelled"};
        }
    }
    return Done{};
}

Progress Run::how_far() const {
    const double in_chunk = static_cast<double>(control_.first_order) /
                            Job::Impl::of(*job_).push.end_order * static_cast<double>(chunk_darts_);
    const double all = of_.stages.candidates();
    return {static_cast<std::uint32_t>(std::min(static_cast<double>(thrown_) + in_chunk, all)),
            static_cast<std::uint32_t>(all), control_.accepted};
}

Result<Done> Run::act_on_overflow() {
    return (control_.overflow & gpu::kOverflowSamples) != 0 ? enlarge_samples() : grow();
}

Result<Done> Run::gather_chunk() {
    return submit(
        [&](VkCommandBuffer commands) { runner_.sampler.record_finish(commands, *job_); });
}

Result<std::vector<gpu::SampleRec>> Run::read_samples() {
    std::vector<gpu::SampleRec> samples(control_.ready);
    if (auto read = memory_.read(BufferRole::samples, std::as_writable_bytes(std::span(samples)));
        !read) {
        return read.error();
    }
    return samples;
}

Result<SampleSet> Run::go(const ProgressCallback& progress, const RunPlan& plan) {
    auto start = Clock::now();
    if (auto done = runner_.sampler.prepare(domain_); !done) {
        return done.error();
    }
    report_.seconds.compile = seconds_since(start);
    start = Clock::now();
    if (auto done = prepare(plan); !done) {
        return done.error();
    }
    if (auto done = upload(); !done) {
        return done.error();
    }
    report_.seconds.upload = seconds_since(start);
    start = Clock::now();
    if (auto done = sample(progress); !done) {
        return done.error();
    }
    report_.seconds.sample = seconds_since(start);
    start = Clock::now();
    auto samples = read_samples();
    if (!samples) {
        return samples.error();
    }
    report_.seconds.readback = seconds_since(start);
    if (has_all()) {
        thrown_ -= chunk_darts_;
        // Those up to the last sample.
        const auto darts = count_before(samples->back().order + 1);
        if (!darts) {
            return darts.error();
        }
        thrown_ += *darts;
    }
    report_.candidates = static_cast<std::uint32_t>(thrown_);
    report_.iterations = control_.iterations;
    report_.dispatches = static_cast<std::uint32_t>(Job::Impl::of(*job_).dispatches);
    report_.disks = control_.disks;
    report_.windows = wide(control_.windows_low, control_.windows_high);
    report_.tested = wide(control_.tested_low, control_.tested_high);
    report_.most_waiting = control_.most_waiting;
    report_.longest_chain = control_.longest_chain;
    report_.most_vertices = control_.most_vertices;
    report_.most_conflicts = control_.most_conflicts;
    report_.trips = wide(control_.trips_low, control_.trips_high);
    report_.lane_trips = wide(control_.lane_trips_low, control_.lane_trips_high);
    std::copy(std::begin(control_.call_bins), std::end(control_.call_bins),
              report_.calls.candidates.begin());
    report_.calls.calls = wide(control_.calls_low, control_.calls_high);
    report_.device_bytes = memory_.bytes();
    report_.plan = job_->plan();
    if (runner_.clock) {
        report_.stages = runner_.clock->seconds();
    }
    return to_set(*samples);
}

SampleSet Run::to_set(const std::vector<gpu::SampleRec>& records) const {
    SampleSet set{{}, {}, report_};
    const std::size_t n = of_.dimension;
    set.samples.reserve(n == 0 ? records.size() : 0);
    set.points.resize(n * records.size());
    for (std::size_t i = 0; i < records.size(); ++i) {
        const gpu::SampleRec& record = records[i];
        if (n > 0) {
            of_.coordinates(record, std::span(set.points).subspan(n * i, n));
        } else {
            set.samples.push_back(
                {record.face,
                 {1.0f - record.weight1 - record.weight2, record.weight1, record.weight2}});
        }
    }
    return set;
}

/// What Sampler plans, with fewer stages where memory asks for that, and what the caller wants.
Result<RunPlan> first_plan(const Runner::Impl& runner, const Domain& domain) {
    auto plan = runner.sampler.plan_run(domain, runner.options.pool_bytes);
    if (!plan) {
        return plan;
    }
    const Domain::Impl& of = Domain::Impl::of(domain);
    const std::uint64_t in_memory = runner.memory_for_candidates() / of.bytes_per_candidate;
    plan->stages = std::min(plan->stages, stages_at_once(of.stages, in_memory));
    return overridden(*plan, runner.options.plan);
}

} // namespace

Result<SampleSet> run_and_wait(Runner::Impl& runner, const Domain& domain,
                               const ProgressCallback& progress) {
    if (auto usable = runner.submitter->ready(); !usable) {
        return usable.error();
    }
    auto plan = first_plan(runner, domain);
    while (plan) {
        Run run(runner, domain);
        auto set = run.go(progress, *plan);
        if (!set) {
            return set;
        }
        const RunPlan wider = runner.sampler.widen_plan(domain, *plan, set->report.longest_chain);
        if (wider.error_bound == plan->error_bound) {
            return set;
        }
        *plan = wider; // Start over.
    }
    return plan.error();
}

} // namespace geodisk
