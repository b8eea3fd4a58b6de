#include "engine/run/run.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "constants.h"
#include "engine/domain/domain_impl.hpp"
#include "engine/job/plan.hpp"
#include "engine/job/record.hpp"
#include "engine/run/memory_budget.hpp"
#include "engine/run/pace.hpp"
#include "engine/run/run_memory.hpp"
#include "engine/run/run_result.hpp"

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
// Part of a run that the steps of disks alone may count as done.
constexpr double kMostExpected = 0.99;
// Items of a pass before it is known how long they take.
constexpr std::uint64_t kItemsOfNew = std::uint64_t{1} << 18;
// Counts of candidates before an order until that of a number of darts is found.
constexpr std::uint32_t kMostGuesses = 64;

/// One run: its memory, its job and what the device reported last.
class Run {
  public:
    /// Takes at most so many bytes on the device. `before` tells of earlier starts of the run.
    Run(Runner::Impl& runner, const Domain& domain, std::uint64_t most_bytes,
        const RunReport& before)
        : runner_(runner), domain_(domain), most_bytes_(most_bytes), of_(Domain::Impl::of(domain)),
          memory_(*runner.workspace), kept_(runner.jobs[index_of(of_.kernels.domain)]),
          job_(kept_.job), passes_(runner.submission_seconds()),
          rounds_(runner.submission_seconds()) {
        report_.seconds = before.seconds;
    }
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;
    /// The samples, or none where the run is to start over with the plan as it is then.
    Task<Result<std::optional<SampleSet>>> go(RunPlan& plan);
    const RunReport& report() const { return report_; }

  private:
    Result<Done> prepare(const RunPlan& plan);
    Task<Result<Done>> upload();
    Task<Result<Advice>> sample();
    Task<Result<Done>> follow(Advice advice);
    Task<Result<Done>> begin_chunk();
    Task<Result<Done>> cut_darts();
    Task<Result<Done>> run_rounds(bool rewind);
    Result<Done> check_progress(const gpu::ControlRec& before);
    Task<Result<Done>> gather_chunk();
    bool has_all() const { return of_.stop_count != 0 && control_.accepted >= of_.stop_count; }
    Job::Impl& job() { return Job::Impl::of(*job_); }
    const Job::Impl& job() const { return Job::Impl::of(*job_); }
    Result<Done> shorten(std::uint64_t items);
    std::uint32_t record_rounds(VkCommandBuffer commands);
    /// Bytes that the pool may grow to: at most so many, and as the device has left.
    std::uint64_t pool_bytes(std::uint64_t most) const;
    Progress how_far() const;
    Result<Done> submit(const std::function<void(VkCommandBuffer)>& record);
    Result<double> took(Result<Done> end);
    using Passes = bool (*)(VkCommandBuffer, Job::Impl&, Budget&);
    using InOne = void (Run::*)(VkCommandBuffer, Budget&);
    Task<Result<Done>> run_passes(Passes record, InOne in_one);
    Task<Result<std::uint32_t>> count_before(std::uint32_t order);
    Result<Done> grow(const RunPlan& grown);
    bool fit_samples(Advice& advice) const;
    Task<Result<Done>> enlarge_samples(std::uint32_t capacity);
    void record_all(VkCommandBuffer commands, Budget& budget);
    void record_samples(VkCommandBuffer commands, Budget&);
    Task<Result<std::vector<gpu::SampleRec>>> read_samples();

    Runner::Impl& runner_;
    const Domain& domain_;
    const std::uint64_t most_bytes_;
    const Domain::Impl& of_;
    RunMemory& memory_;
    Runner::Impl::KeptJob& kept_;
    std::optional<Job>& job_;
    RunPlan wanted_; ///< But for dispatches that have to be shorter.
    Pace passes_, rounds_;
    double submitted_ = 0;   ///< When.
    std::uint32_t idle_ = 0; ///< Submissions of late that left no trace.
    gpu::ControlRec control_{};
    double steps_ = 0;     ///< Of all rounds.
    double all_steps_ = 0; ///< That are expected.
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
    const std::uint64_t uploaded = upload_bytes(runner_.sampler, domain_);
    if (auto allocated = memory_.allocate(*needs, uploaded, most_bytes_); !allocated) {
        return allocated;
    }
    if (job_ && kept_.made == memory_.made()) {
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
        kept_.made = memory_.made();
    }
    if (runner_.clock) {
        job().clock = &*runner_.clock;
        runner_.clock->reset();
    }
    wanted_ = plan;
    all_steps_ = kDisksPerSample * of_.all_steps() * std::max(1.0, kLeastSlots / of_.samples);
    report_.guard = of_.guard_for(plan.error_bound);
    return Done{};
}

/// With the first submission where there is room in the staging, else in some of their own.
Task<Result<Done>> Run::upload() {
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        const auto role = static_cast<BufferRole>(i);
        const std::size_t from =
            memory_.holds(role, of_.meshes) ? runner_.sampler.mesh_bytes(domain_, role) : 0;
        const std::size_t size = runner_.sampler.upload_size(domain_, role) - from;
        std::span<std::byte> staged = memory_.stage(role, from, size);
        if (staged.empty() && size > 0) {
            auto before = runner_.submitter->submit(
                [&](VkCommandBuffer commands) { memory_.record_uploads(commands); });
            if (before) {
                before = co_await runner_.submitter->ended();
            }
            if (!before) {
                co_return before;
            }
            staged = memory_.stage(role, from, size);
        }
        std::vector<std::byte> large(staged.empty() ? size : 0);
        auto written = size > 0
                           ? runner_.sampler.write_upload(domain_, job_->plan(), role,
                                                          staged.empty() ? large : staged, from)
                           : Result<Done>(Done{});
        if (!written) {
            co_return written;
        }
        if (auto uploaded = co_await memory_.upload(role, from, large); !uploaded) {
            co_return uploaded;
        }
        memory_.set_held(role, of_.meshes);
        report_.uploaded += size;
    }
    co_return Done{};
}

Result<Done> Run::submit(const std::function<void(VkCommandBuffer)>& record) {
    submitted_ = runner_.now();
    return runner_.submit_timed([&](VkCommandBuffer commands) {
        memory_.record_uploads(commands);
        record(commands);
        memory_.record_control(commands);
    });
}

/// Once it has ended, reads the control record; the seconds it took.
Result<double> Run::took(Result<Done> end) {
    if (end && runner_.clock) {
        end = runner_.clock->collect();
    }
    if (!end) {
        return end.error();
    }
    control_ = memory_.control();
    if (control_.abi != gpu::kAbi && job().begun.is_at_start()) {
        return Error{Status::internal, "the device did not write its control record"};
    }
    runner_.progress = how_far();
    return runner_.now() - submitted_;
}

/// Submits passes in as many parts as the time asks for; where one will do, with what `in_one`
/// records.
Task<Result<Done>> Run::run_passes(Passes record, InOne in_one) {
    bool is_last = false;
    for (std::uint32_t part = 0; !is_last; ++part) {
        if (auto short_enough = shorten(passes_.items()); !short_enough) {
            co_return short_enough;
        }
        Budget budget{kAllDispatches, passes_.items(), kItemsOfNew};
        if (auto done = submit([&](VkCommandBuffer commands) {
                is_last = record(commands, job(), budget);
                if (is_last && part == 0) {
                    (this->*in_one)(commands, budget);
                }
            });
            !done) {
            co_return done;
        }
        const auto seconds = took(co_await runner_.submitter->ended());
        if (!seconds) {
            co_return seconds.error();
        }
        passes_.took(*seconds, passes_.items() - budget.items);
        if (budget.is_in_new) {
            passes_.bound(kItemsOfNew);
        }
    }
    co_return Done{};
}

/// Candidates of the chunk that are of lower order.
Task<Result<std::uint32_t>> Run::count_before(std::uint32_t order) {
    if (auto done = submit([&](VkCommandBuffer commands) { job().record_count(commands, order); });
        !done) {
        co_return done.error();
    }
    const auto counted = took(co_await runner_.submitter->ended());
    if (!counted) {
        co_return counted.error();
    }
    co_return control_.below;
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
    auto set = job_->set_plan(wanted_, memory_.range(BufferRole::pool));
    kept_.made = memory_.made();
    return set;
}

Task<Result<Done>> Run::enlarge_samples(std::uint32_t capacity) {
    auto enlarged = co_await memory_.enlarge_samples(job_->sample_bytes(capacity),
                                                     control_.accepted, most_bytes_);
    if (!enlarged) {
        co_return enlarged;
    }
    wanted_.sample_capacity = capacity;
    auto set =
        job_->set_samples(capacity, memory_.range(BufferRole::samples),
                          memory_.range(BufferRole::accepted), memory_.range(BufferRole::buckets));
    kept_.made = memory_.made();
    co_return set;
}

/// Until the samples are there, or the run has to start over.
Task<Result<Advice>> Run::sample() {
    for (;;) {
        // What is free is asked for only where it matters.
        const bool grows = control_.overflow != 0;
        auto advice = job_->advance(control_, grows ? pool_bytes(runner_.options.pool_bytes) : 0);
        if (!advice && grows && advice.error().status == Status::workspace_too_small) {
            // A single disk that is too large for the pool may take all that the device has.
            advice = job_->advance(control_, pool_bytes(~std::uint64_t{0}));
        }
        if (!advice || advice->next == Next::complete || advice->next == Next::start_over) {
            co_return advice;
        }
        if (advice->next == Next::larger_samples && !fit_samples(*advice)) {
            advice->next = Next::start_over;
            co_return advice;
        }
        if (auto done = co_await follow(*advice); !done) {
            co_return done.error();
        }
    }
}

/// Whether there is room for the samples advised, or fewer that go on, beside the pool as it is.
bool Run::fit_samples(Advice& advice) const {
    std::uint64_t others = memory_.bytes();
    for (const BufferRole role : {BufferRole::samples, BufferRole::accepted, BufferRole::buckets}) {
        others -= memory_.range(role).size;
    }
    const auto fits = [&](std::uint32_t capacity) {
        const auto bytes = job_->sample_bytes(capacity);
        return others + bytes[0] + bytes[1] + bytes[2] <= most_bytes_;
    };
    // advance() has found that it fits 32 bits.
    const auto least =
        static_cast<std::uint32_t>(least_sample_capacity(control_, job_->plan().slots));
    if (!fits(advice.sample_capacity) && fits(least)) {
        advice.sample_capacity = least;
    }
    return fits(advice.sample_capacity);
}

std::uint64_t Run::pool_bytes(std::uint64_t most) const {
    const std::uint64_t others = memory_.bytes() - memory_.range(BufferRole::pool).size;
    const std::uint64_t allowed = std::min(most_bytes_, runner_.bytes_allowed());
    const std::uint64_t left = allowed > others ? allowed - others : 0;
    // It has what it has.
    return std::max(std::min(left, most), memory_.range(BufferRole::pool).size);
}

Task<Result<Done>> Run::follow(Advice advice) {
    if (advice.next == Next::begin) {
        co_return co_await begin_chunk();
    }
    if (advice.next == Next::finish) {
        co_return co_await gather_chunk();
    }
    Result<Done> enlarged = Done{};
    if (advice.next == Next::larger_pool) {
        enlarged = grow(advice.plan);
    } else if (advice.next == Next::larger_samples) {
        enlarged = co_await enlarge_samples(advice.sample_capacity);
    }
    if (!enlarged) {
        co_return enlarged;
    }
    co_return co_await run_rounds(advice.next != Next::go_on);
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
    if (disks * std::max(of_.disk_steps(plan, job().constants.capacity), 1.0) <= kFewSteps) {
        rounds =
            std::max(rounds, kRoundsBeside + 2 * static_cast<std::uint64_t>(disks) / plan.slots);
    }
    const auto count =
        static_cast<std::uint32_t>(std::clamp<std::uint64_t>(rounds, 1, kMostRounds));
    runner_.sampler.record_rounds(commands, *job_, count);
    return count;
}

/// What goes on in the submission that draws the candidates, if they are few.
void Run::record_all(VkCommandBuffer commands, Budget& budget) {
    if (of_.stages.throws == 0 && budget.items >= job_->plan().sample_capacity) {
        record_rounds(commands);
        record_finish(commands, job(), budget);
        record_samples(commands, budget);
    }
}

Task<Result<Done>> Run::begin_chunk() {
    ++report_.chunks;
    auto begun = co_await run_passes(record_begin, &Run::record_all);
    if (!begun) {
        co_return begun;
    }
    const std::uint32_t throws = of_.stages.throws;
    if (throws != 0 && job().thrown + control_.drawn > throws) {
        co_return co_await cut_darts();
    }
    co_return Done{};
}

/// Finds the order below which there are just as many darts as are to be thrown.
Task<Result<Done>> Run::cut_darts() {
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
        const auto count = co_await count_before(static_cast<std::uint32_t>(middle));
        if (!count) {
            co_return count.error();
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
    if (auto done = submit([&](VkCommandBuffer commands) { job().record_restart(commands); });
        !done) {
        co_return done;
    }
    const auto restarted = took(co_await runner_.submitter->ended());
    co_return restarted ? Result<Done>(Done{}) : restarted.error();
}

Task<Result<Done>> Run::run_rounds(bool rewind) {
    if (auto short_enough = shorten(rounds_.items()); !short_enough) {
        co_return short_enough;
    }
    const gpu::ControlRec before = control_;
    std::uint32_t rounds = 0;
    if (auto done = submit([&](VkCommandBuffer commands) {
            if (rewind) {
                runner_.sampler.record_rewind(commands, *job_);
            }
            rounds = record_rounds(commands);
        });
        !done) {
        co_return done;
    }
    const auto seconds = took(co_await runner_.submitter->ended());
    if (!seconds) {
        co_return seconds.error();
    }
    steps_ += control_.steps - before.steps;
    rounds_.took(*seconds, rounds * items_of_round(job_->plan()), control_.steps - before.steps);
    // Batches that take more than a round: fewer of the other dispatches go idle when a round
    // detects longer.
    const bool is_slow = rounds >= 2 * (control_.iterations - before.iterations);
    if (control_.incomplete > 0 && is_slow && runner_.options.plan.detect_passes == 0) {
        wanted_.detect_passes = std::min(2 * wanted_.detect_passes, kMostPasses);
    }
    co_return check_progress(before);
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
    const double decided = static_cast<double>(job().thrown) + in_chunk;
    // A large disk may take as long as all others.
    const double stepped = all_steps_ > 0 ? std::min(kMostExpected, steps_ / all_steps_) : 0;
    return {static_cast<std::uint32_t>(std::min(std::max(decided, stepped * all), all)),
            static_cast<std::uint32_t>(all), control_.accepted, control_.disks,
            wide(control_.windows_low, control_.windows_high)};
}

Task<Result<Done>> Run::gather_chunk() {
    co_return co_await run_passes(record_finish, &Run::record_samples);
}

/// All that there may be, so that they come with the control record.
void Run::record_samples(VkCommandBuffer commands, Budget&) {
    memory_.record_samples(commands,
                           VkDeviceSize{wanted_.sample_capacity} * sizeof(gpu::SampleRec));
}

Task<Result<std::vector<gpu::SampleRec>>> Run::read_samples() {
    std::vector<gpu::SampleRec> samples(control_.ready);
    const auto bytes = std::as_writable_bytes(std::span(samples));
    if (const auto there = memory_.samples(); there.size() >= bytes.size()) {
        std::copy_n(there.begin(), bytes.size(), bytes.begin());
        co_return samples;
    }
    if (auto read = co_await memory_.read(BufferRole::samples, bytes); !read) {
        co_return read.error();
    }
    co_return samples;
}

Task<Result<std::optional<SampleSet>>> Run::go(RunPlan& plan) {
    double start = runner_.now();
    if (auto done = runner_.sampler.prepare(domain_); !done) {
        co_return done.error();
    }
    report_.seconds.compile += runner_.now() - start;
    start = runner_.now();
    if (auto done = prepare(plan); !done) {
        co_return done.error();
    }
    if (auto done = co_await upload(); !done) {
        co_return done.error();
    }
    report_.seconds.upload += runner_.now() - start;
    start = runner_.now();
    const auto advice = co_await sample();
    if (!advice) {
        co_return advice.error();
    }
    report_.seconds.sample += runner_.now() - start;
    if (advice->next == Next::start_over) {
        plan.error_bound = advice->plan.error_bound;
        plan.sample_capacity = std::max(plan.sample_capacity, advice->sample_capacity);
        co_return std::optional<SampleSet>();
    }
    start = runner_.now();
    auto samples = co_await read_samples();
    if (!samples) {
        co_return samples.error();
    }
    report_.seconds.readback += runner_.now() - start;
    std::uint64_t darts = job().darts(control_);
    if (has_all()) {
        // Those up to the last sample.
        const auto counted = co_await count_before(samples->back().order + 1);
        if (!counted) {
            co_return counted.error();
        }
        darts = *counted;
    }
    report_.candidates = static_cast<std::uint32_t>(job().thrown + darts);
    report_.dispatches = static_cast<std::uint32_t>(job().dispatches);
    take_counts(control_, report_);
    report_.device_bytes = memory_.bytes();
    report_.plan = wanted_;
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
        }
    }
};

} // namespace

Task<Result<SampleSet>> run(Runner::Impl& runner, const Domain& domain) {
    if (auto usable = runner.submitter->ready(); !usable) {
        co_return usable.error();
    }
    Releaser releaser{runner};
    std::uint64_t most = runner.bytes_allowed();
    std::uint32_t samples = 0; // That there has to be room for.
    double error_bound = 0;
    RunReport before;
    for (;;) {
        const auto fitting = fit_within(runner, domain, most, samples);
        if (!fitting) {
            co_return fitting.error();
        }
        RunPlan plan = fitting->plan;
        plan.error_bound = std::max(plan.error_bound, error_bound);
        runner.keep();
        Run run(runner, domain, most, before);
        auto set = co_await run.go(plan);
        if (set && *set) {
            releaser.has_succeeded = true;
            co_return std::move(**set);
        }
        if (set) { // To start over, with a wider guard or more room for samples.
            samples = plan.sample_capacity;
            error_bound = plan.error_bound;
            before = run.report();
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
