#include "engine/run.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "constants.h"
#include "engine/domain_impl.hpp"
#include "engine/memory_budget.hpp"
#include "engine/pace.hpp"
#include "engine/plan.hpp"
#include "engine/record.hpp"
#include "engine/run_memory.hpp"

namespace geodisk {
namespace {

constexpr std::uint64_t kMostRounds = 256;
// About those of a run that recomputes few; and that are so few that one submission does for them.
constexpr double kDisksPerSample = 1.5;
constexpr double kFewSteps = 1024;
// Rounds that list candidates, or end a batch.
constexpr std::uint64_t kRoundsBeside = 6;
constexpr std::uint32_t kMostPasses = 64;
// Submissions that may leave no trace, before the device counts as stuck.
constexpr std::uint32_t kMostIdle = 8;
// Counts of candidates before an order until that of a number of darts is found.
constexpr std::uint32_t kMostGuesses = 64;

constexpr std::uint64_t wide(std::uint32_t low, std::uint32_t high) {
    return std::uint64_t{high} << 32 | low;
}

/// One run: its memory, its job and what the device reported last.
class Run {
  public:
    Run(Runner::Impl& runner, const Domain& domain)
        : runner_(runner), domain_(domain), of_(Domain::Impl::of(domain)),
          memory_(*runner.workspace), job_(runner.job), passes_(runner.submission_seconds()),
          rounds_(runner.submission_seconds()) {}
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;
    /// The samples, or none where the run is to start over with the plan as it is then.
    Result<std::optional<SampleSet>> go(const ProgressCallback& progress, RunPlan& plan);

  private:
    Result<Done> prepare(const RunPlan& plan);
    Result<Done> upload();
    Result<Advice> sample(const ProgressCallback& progress);
    Result<Done> follow(const Advice& advice);
    Result<Done> begin_chunk();
    Result<Done> cut_darts();
    Result<Done> run_rounds(bool rewind);
    Result<Done> check_progress(const gpu::ControlRec& before);
    Result<Done> gather_chunk();
    bool has_all() const { return of_.stop_count != 0 && control_.accepted >= of_.stop_count; }
    Job::Impl& job() { return Job::Impl::of(*job_); }
    const Job::Impl& job() const { return Job::Impl::of(*job_); }
    Result<Done> shorten(std::uint64_t items);
    std::uint32_t record_rounds(VkCommandBuffer commands);
    /// That the pool may take.
    std::uint64_t pool_bytes() const;
    Progress how_far() const;
    Result<double> submit(const std::function<void(VkCommandBuffer)>& record);
    using Passes = bool (*)(VkCommandBuffer, Job::Impl&, Budget&);
    Result<Done> run_passes(Passes record,
                            const std::function<void(VkCommandBuffer, Budget&)>& in_one = {});
    Result<std::uint32_t> count_before(std::uint32_t order);
    Result<Done> grow(const RunPlan& grown);
    Result<Done> enlarge_samples(std::uint32_t capacity);
    void record_samples(VkCommandBuffer commands);
    Result<std::vector<gpu::SampleRec>> read_samples();
    SampleSet to_set(const std::vector<gpu::SampleRec>& records) const;

    Runner::Impl& runner_;
    const Domain& domain_;
    const Domain::Impl& of_;
    RunMemory& memory_;
    std::optional<Job>& job_;
    RunPlan wanted_; ///< But for dispatches that have to be shorter.
    Pace passes_, rounds_;
    std::uint32_t idle_ = 0; ///< Submissions of late that left no trace.
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
    const std::uint32_t made = memory_.made();
    const std::uint64_t uploaded = upload_bytes(runner_.sampler, domain_);
    if (auto allocated = memory_.allocate(*needs, uploaded); !allocated) {
        return allocated;
    }
    if (job_ && memory_.made() == made) {
        if (auto renewed = job_->renew(domain_, plan); !renewed) {
            return renewed;
        }
    } else {
        job_.reset();
        auto job = runner_.sampler.make_job(domain_, plan, memory_.workspace());
        if (!job) {
            return job.error();
        }
        job_.emplace(std::move(*job));
    }
    if (runner_.clock) {
        job().clock = &*runner_.clock;
        runner_.clock->reset();
    }
    wanted_ = plan;
    report_.guard = of_.guard_for(plan.error_bound);
    return Done{};
}

/// With the first submission where there is room in the staging, else in some of their own.
Result<Done> Run::upload() {
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        const auto role = static_cast<BufferRole>(i);
        const std::size_t from =
            memory_.holds(role, of_.meshes) ? runner_.sampler.mesh_bytes(domain_, role) : 0;
        const std::size_t size = runner_.sampler.upload_size(domain_, role) - from;
        std::span<std::byte> staged = memory_.stage(role, from, size);
        if (staged.empty() && size > 0) {
            auto before = runner_.submitter->run(
                [&](VkCommandBuffer commands) { memory_.record_uploads(commands); });
            if (!before) {
                return before;
            }
            staged = memory_.stage(role, from, size);
        }
        std::vector<std::byte> large(staged.empty() ? size : 0);
        auto written = size > 0
                           ? runner_.sampler.write_upload(domain_, job_->plan(), role,
                                                          staged.empty() ? large : staged, from)
                           : Result<Done>(Done{});
        if (!written) {
            return written;
        }
        if (auto uploaded = memory_.upload(role, from, large); !uploaded) {
            return uploaded;
        }
        memory_.set_held(role, of_.meshes);
        report_.uploaded += size;
    }
    return Done{};
}

/// Records, and reads the control record afterwards; the seconds it took.
Result<double> Run::submit(const std::function<void(VkCommandBuffer)>& record) {
    const double start = runner_.now();
    auto done = runner_.run_timed([&](VkCommandBuffer commands) {
        memory_.record_uploads(commands);
        record(commands);
        memory_.record_control(commands);
    });
    if (!done) {
        return done.error();
    }
    control_ = memory_.control();
    if (control_.abi != gpu::kAbi && job().begun.is_at_start()) {
        return Error{Status::internal, "the device did not write its control record"};
    }
    return runner_.now() - start;
}

/// Submits passes in as many parts as the time asks for; where one will do, with what `in_one`
/// records.
Result<Done> Run::run_passes(Passes record,
                             const std::function<void(VkCommandBuffer, Budget&)>& in_one) {
    bool is_last = false;
    for (std::uint32_t part = 0; !is_last; ++part) {
        if (auto short_enough = shorten(passes_.items()); !short_enough) {
            return short_enough;
        }
        Budget budget{kAllDispatches, passes_.items()};
        const auto seconds = submit([&](VkCommandBuffer commands) {
            is_last = record(commands, job(), budget);
            if (is_last && part == 0 && in_one) {
                in_one(commands, budget);
            }
        });
        if (!seconds) {
            return seconds.error();
        }
        passes_.took(*seconds, passes_.items() - budget.items);
    }
    return Done{};
}

/// Candidates of the chunk that are of lower order.
Result<std::uint32_t> Run::count_before(std::uint32_t order) {
    auto counted = submit([&](VkCommandBuffer commands) { job().record_count(commands, order); });
    if (!counted) {
        return counted.error();
    }
    return control_.below;
}

Result<Done> Run::grow(const RunPlan& grown) {
    ++report_.regrown;
    if (auto enlarged = memory_.enlarge_pool(grown.pool_bytes()); !enlarged) {
        return enlarged;
    }
    const RunPlan before = std::exchange(wanted_, grown);
    wanted_.dispatch_items = before.dispatch_items;
    wanted_.step_budget = before.step_budget;
    wanted_.detect_passes = before.detect_passes;
    return job_->set_plan(wanted_, memory_.range(BufferRole::pool));
}

Result<Done> Run::enlarge_samples(std::uint32_t capacity) {
    if (auto enlarged = memory_.enlarge_samples(job_->sample_bytes(capacity), control_.accepted);
        !enlarged) {
        return enlarged;
    }
    wanted_.sample_capacity = capacity;
    return job_->set_samples(capacity, memory_.range(BufferRole::samples),
                             memory_.range(BufferRole::accepted),
                             memory_.range(BufferRole::buckets));
}

/// Until the samples are there, or the run has to start over.
Result<Advice> Run::sample(const ProgressCallback& progress) {
    for (;;) {
        // What is free is asked for only where it matters.
        auto advice = job_->advance(control_, control_.overflow != 0 ? pool_bytes() : 0);
        if (!advice || advice->next == Next::complete || advice->next == Next::start_over) {
            return advice;
        }
        if (auto done = follow(*advice); !done) {
            return done.error();
        }
        if (progress && !progress(how_far())) {
            return Error{Status::cancelled, "cancelled"};
        }
    }
}

std::uint64_t Run::pool_bytes() const {
    const std::uint64_t others = memory_.bytes() - memory_.range(BufferRole::pool).size;
    const std::uint64_t allowed = runner_.bytes_allowed();
    const std::uint64_t left = allowed > others ? allowed - others : 0;
    // It has what it has.
    return std::max(std::min(left, runner_.options.pool_bytes),
                    memory_.range(BufferRole::pool).size);
}

Result<Done> Run::follow(const Advice& advice) {
    switch (advice.next) {
    case Next::begin:
        return begin_chunk();
    case Next::finish:
        return gather_chunk();
    case Next::larger_pool:
        if (auto grown = grow(advice.plan); !grown) {
            return grown;
        }
        return run_rounds(true);
    case Next::larger_samples:
        if (auto enlarged = enlarge_samples(advice.sample_capacity); !enlarged) {
            return enlarged;
        }
        return run_rounds(true);
    default:
        return run_rounds(false);
    }
}

/// Dispatches within the time there is.
Result<Done> Run::shorten(std::uint64_t items) {
    return job_->set_plan(shortened(wanted_, runner_.options.plan, items));
}

/// As many as the time allows, or as are expected to do where all disks together are little work.
std::uint32_t Run::record_rounds(VkCommandBuffer commands) {
    const RunPlan& plan = job_->plan();
    std::uint64_t rounds = rounds_.items() / items_of_round(plan);
    const double disks = kDisksPerSample * of_.samples;
    if (disks * std::max(of_.disk_steps(plan, job().push.capacity), 1.0) <= kFewSteps) {
        rounds =
            std::max(rounds, kRoundsBeside + 2 * static_cast<std::uint64_t>(disks) / plan.slots);
    }
    const auto count =
        static_cast<std::uint32_t>(std::clamp<std::uint64_t>(rounds, 1, kMostRounds));
    runner_.sampler.record_rounds(commands, *job_, count);
    return count;
}

/// Draws the candidates, and goes on in the same submission if they are few.
Result<Done> Run::begin_chunk() {
    ++report_.chunks;
    auto begun = run_passes(record_begin, [&](VkCommandBuffer commands, Budget& budget) {
        if (of_.stages.throws == 0 && budget.items >= job_->plan().sample_capacity) {
            record_rounds(commands);
            record_finish(commands, job(), budget);
            record_samples(commands);
        }
    });
    if (!begun) {
        return begun;
    }
    const std::uint32_t throws = of_.stages.throws;
    return throws != 0 && job().thrown + control_.drawn > throws ? cut_darts()
                                                                 : Result<Done>(Done{});
}

/// Finds the order below which there are just as many darts as are to be thrown.
Result<Done> Run::cut_darts() {
    const auto wanted = static_cast<std::uint32_t>(of_.stages.throws - job().thrown);
    std::uint64_t low = 0, high = job().push.end_order;
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
    job().cut_darts = at_low ? low_count : high_count;
    job().push.end_order = static_cast<std::uint32_t>(at_low ? low : high);
    const auto restarted =
        submit([&](VkCommandBuffer commands) { job().record_restart(commands); });
    return restarted ? Result<Done>(Done{}) : restarted.error();
}

Result<Done> Run::run_rounds(bool rewind) {
    if (auto short_enough = shorten(rounds_.items()); !short_enough) {
        return short_enough;
    }
    const gpu::ControlRec before = control_;
    std::uint32_t rounds = 0;
    const auto seconds = submit([&](VkCommandBuffer commands) {
        if (rewind) {
            runner_.sampler.record_rewind(commands, *job_);
        }
        rounds = record_rounds(commands);
    });
    if (!seconds) {
        return seconds.error();
    }
    rounds_.took(*seconds, rounds * items_of_round(job_->plan()), control_.steps - before.steps);
    // Batches that take more than a round: fewer of the other dispatches go idle when a round
    // detects longer.
    const bool is_slow = rounds >= 2 * (control_.iterations - before.iterations);
    if (control_.incomplete > 0 && is_slow && runner_.options.plan.detect_passes == 0) {
        wanted_.detect_passes = std::min(2 * wanted_.detect_passes, kMostPasses);
    }
    return check_progress(before);
}

Result<Done> Run::check_progress(const gpu::ControlRec& before) {
    idle_ = std::memcmp(&before, &control_, sizeof before) == 0 ? idle_ + 1 : 0;
    if (idle_ == kMostIdle) {
        return Error{Status::internal,
                     "the device makes no progress: " + std::to_string(kMostIdle) +
                         " submissions have changed nothing"};
    }
    return Done{};
}

Progress Run::how_far() const {
    const double in_chunk = static_cast<double>(control_.first_order) / job().push.end_order *
                            static_cast<double>(job().darts(control_));
    const double all = of_.stages.candidates();
    const auto before = static_cast<double>(job().thrown);
    return {static_cast<std::uint32_t>(std::min(before + in_chunk, all)),
            static_cast<std::uint32_t>(all), control_.accepted};
}

Result<Done> Run::gather_chunk() {
    return run_passes(record_finish,
                      [&](VkCommandBuffer commands, Budget&) { record_samples(commands); });
}

/// All that there may be, so that they come with the control record.
void Run::record_samples(VkCommandBuffer commands) {
    memory_.record_samples(commands,
                           VkDeviceSize{wanted_.sample_capacity} * sizeof(gpu::SampleRec));
}

Result<std::vector<gpu::SampleRec>> Run::read_samples() {
    std::vector<gpu::SampleRec> samples(control_.ready);
    const auto bytes = std::as_writable_bytes(std::span(samples));
    if (const auto there = memory_.samples(); there.size() >= bytes.size()) {
        std::copy_n(there.begin(), bytes.size(), bytes.begin());
        return samples;
    }
    if (auto read = memory_.read(BufferRole::samples, bytes); !read) {
        return read.error();
    }
    return samples;
}

Result<std::optional<SampleSet>> Run::go(const ProgressCallback& progress, RunPlan& plan) {
    double start = runner_.now();
    if (auto done = runner_.sampler.prepare(domain_); !done) {
        return done.error();
    }
    report_.seconds.compile = runner_.now() - start;
    start = runner_.now();
    if (auto done = prepare(plan); !done) {
        return done.error();
    }
    if (auto done = upload(); !done) {
        return done.error();
    }
    report_.seconds.upload = runner_.now() - start;
    start = runner_.now();
    const auto advice = sample(progress);
    if (!advice) {
        return advice.error();
    }
    if (advice->next == Next::start_over) {
        plan.error_bound = advice->plan.error_bound;
        return std::optional<SampleSet>();
    }
    report_.seconds.sample = runner_.now() - start;
    start = runner_.now();
    auto samples = read_samples();
    if (!samples) {
        return samples.error();
    }
    report_.seconds.readback = runner_.now() - start;
    std::uint64_t darts = job().darts(control_);
    if (has_all()) {
        // Those up to the last sample.
        const auto counted = count_before(samples->back().order + 1);
        if (!counted) {
            return counted.error();
        }
        darts = *counted;
    }
    report_.candidates = static_cast<std::uint32_t>(job().thrown + darts);
    report_.iterations = control_.iterations;
    report_.dispatches = static_cast<std::uint32_t>(job().dispatches);
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
    report_.plan = wanted_;
    if (runner_.clock) {
        report_.stages = runner_.clock->seconds();
    }
    return std::optional(to_set(*samples));
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

/// A run that fails, whether by an error or an exception, leaves nothing to those to come.
struct Releaser {
    Runner::Impl& runner;
    bool has_succeeded = false;
    ~Releaser() {
        if (!has_succeeded) {
            runner.release();
        }
    }
};

} // namespace

Result<SampleSet> run_and_wait(Runner::Impl& runner, const Domain& domain,
                               const ProgressCallback& progress) {
    if (auto usable = runner.submitter->ready(); !usable) {
        return usable.error();
    }
    Releaser releaser{runner};
    auto plan = plan_within(runner, domain, runner.bytes_allowed());
    while (plan) {
        runner.keep();
        Run run(runner, domain);
        auto set = run.go(progress, *plan);
        if (set && *set) {
            releaser.has_succeeded = true;
            return std::move(**set);
        }
        if (set) {
            continue; // With a wider guard.
        }
        if (!runner.workspace->was_short()) {
            return set.error();
        }
        runner.release();
        const auto needs = runner.sampler.workspace_needs(domain, *plan);
        if (!needs) {
            return set.error();
        }
        auto smaller = plan_within(runner, domain, bytes_of(runner.sampler, domain, *needs) / 2);
        if (!smaller) {
            return set.error();
        }
        smaller->error_bound = plan->error_bound;
        plan = std::move(smaller);
    }
    return plan.error();
}

} // namespace geodisk
