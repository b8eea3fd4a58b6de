#include "engine/run/submissions.hpp"

#include <algorithm>
#include <cstring>
#include <string>

#include "constants.h"
#include "engine/run/run_result.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

constexpr std::uint64_t kMaxRounds = 256;
// About those of a run that recomputes few.
constexpr double kDisksPerSample = 1.5;
// Rounds that list candidates, or end a batch.
constexpr std::uint64_t kRoundsBeside = 6;
constexpr std::uint32_t kMaxPasses = 64;
// Submissions that may leave no trace, before the device counts as stuck.
constexpr std::uint32_t kMaxIdle = 8;
// Part of a run that the steps of disks alone may count as done.
constexpr double kMaxExpected = 0.99;
// Items of a pass before it is known how long they take.
constexpr std::uint64_t kItemsOfNew = std::uint64_t{1} << 18;

} // namespace

Submissions::Submissions(Runner::Impl& runner, RunMemory& memory, const Domain::Impl& of)
    : runner_(runner), memory_(memory), of_(of) {}

void Submissions::use(Job& job, const RunPlan& plan) {
    job_ = &job;
    plan_ = plan;
    all_steps_ = kDisksPerSample * of_.all_steps(plan) * std::max(1.0, kMinSlots / of_.samples);
    paces_ = &runner_.paces_of(this->job().variant);
    items_of_new_ = paces_->passes.begin_run(kItemsOfNew);
    paces_->rounds.begin_run(Pace::kFirstItemsOfRounds, plan.lanes);
}

Result<Done> Submissions::submit(const std::function<void(VkCommandBuffer)>& record) {
    submitted_ = runner_.now();
    return runner_.submit_timed([&](VkCommandBuffer commands) {
        memory_.record_uploads(commands);
        record(commands);
        memory_.record_control(commands);
    });
}

Result<double> Submissions::took(Result<Done> end) {
    if (end && runner_.clock) {
        end = runner_.clock->collect();
    }
    GEODISK_TRY(end);
    control_ = memory_.control();
    if (control_.abi != gpu::kAbi && job().begun.is_at_start()) {
        return Error{Status::internal, "the device did not write its control record"};
    }
    runner_.note(how_far());
    return runner_.now() - submitted_;
}

Task<Result<Done>> Submissions::run_passes(Passes record, const InOne& in_one) {
    Pace& passes = paces_->passes;
    bool is_last = false;
    for (std::uint32_t part = 0; !is_last; ++part) {
        if (auto short_enough = shorten(); !short_enough) {
            co_return short_enough;
        }
        Budget budget{kAllDispatches, passes.items(), items_of_new_};
        const gpu::ControlRec before = control_;
        std::uint32_t rounds = 0;
        if (auto done = submit([&](VkCommandBuffer commands) {
                is_last = record(commands, job(), budget);
                if (is_last && part == 0 && in_one) {
                    rounds = in_one(commands, budget);
                }
            });
            !done) {
            co_return done;
        }
        const auto seconds = took(co_await runner_.submitter->ended());
        GEODISK_CO_TRY(seconds);
        passes.took(*seconds, passes.items() - budget.items);
        if (budget.is_in_new) {
            passes.bound(items_of_new_);
        }
        took_rounds(*seconds, rounds, before);
    }
    co_return Done{};
}

void Submissions::took_rounds(double seconds, std::uint32_t rounds, const gpu::ControlRec& before) {
    if (rounds > 0) {
        const std::uint32_t steps = control_.steps - before.steps;
        const RunPlan& plan = job_->plan();
        steps_ += steps;
        paces_->rounds.took(seconds, rounds * items_of_round(plan), steps, plan.lanes);
    }
}

Result<Done> Submissions::shorten() {
    return job_->set_plan(
        shortened(plan_, runner_.options.plan, paces_->passes.items(), paces_->rounds.items()));
}

std::uint32_t Submissions::record_rounds(VkCommandBuffer commands) {
    const RunPlan& plan = job_->plan();
    std::uint64_t rounds = paces_->rounds.items() / items_of_round(plan);
    // A batch computes a disk per slot, however few are samples.
    const double disks = std::max<double>(kDisksPerSample * of_.samples, plan.batch_slots());
    const double steps = disks * std::max(of_.disk_steps(plan, job().constants.capacity), 1.0);
    if (paces_->rounds.fits(steps)) {
        rounds = std::max(rounds, kRoundsBeside +
                                      2 * static_cast<std::uint64_t>(disks) / plan.batch_slots());
    }
    const auto count = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(rounds, 1, kMaxRounds));
    runner_.sampler.record_rounds(commands, *job_, count);
    return count;
}

Task<Result<Done>> Submissions::run_rounds(bool rewind) {
    if (auto short_enough = shorten(); !short_enough) {
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
    GEODISK_CO_TRY(seconds);
    took_rounds(*seconds, rounds, before);
    // Batches that take more than a round: fewer of the other dispatches go idle when a round
    // detects longer.
    const bool is_slow = rounds >= 2 * (control_.batches - before.batches);
    if (control_.incomplete > 0 && is_slow && runner_.options.plan.detect_passes == 0) {
        plan_.detect_passes = std::min(2 * plan_.detect_passes, kMaxPasses);
    }
    co_return check_progress(before);
}

Result<Done> Submissions::check_progress(const gpu::ControlRec& before) {
    idle_ = std::memcmp(&before, &control_, sizeof before) == 0 ? idle_ + 1 : 0;
    if (idle_ == kMaxIdle) {
        return Error{Status::internal, "the device makes no progress: " + std::to_string(kMaxIdle) +
                                           " submissions have changed nothing"};
    }
    return Done{};
}

Progress Submissions::how_far() const {
    const double all = of_.stages.candidates();
    // A large disk may take as long as all others.
    const double stepped = all_steps_ > 0 ? std::min(kMaxExpected, steps_ / all_steps_) : 0;
    const double decided = std::max(job().decided(control_), stepped * all);
    return {static_cast<std::uint32_t>(std::min(decided, all)), static_cast<std::uint32_t>(all),
            control_.accepted - std::min(control_.accepted, of_.avoided), control_.disks,
            wide(control_.windows_low, control_.windows_high)};
}

} // namespace geodisk
