// Division: a run in parts, for a surface that the device cannot hold.
#pragma once

#include <chrono>
#include <coroutine>
#include <cstdint>
#include <memory>
#include <optional>

#include <geodisk/runner.hpp>
#include <geodisk/status.hpp>

#include "engine/domain/domain_impl.hpp"
#include "engine/run/runner_impl.hpp"
#include "engine/run/task.hpp"
#include "parts/divided_run.hpp"

namespace geodisk {

/// Samples a surface in as few parts as fit, about: where they turn out too large, in twice as
/// many. Has a runner of its own. Destroying it cancels what is left.
class Division {
  public:
    /// Begins, if parts may help: after this error of a run of the whole. Returns null if not. The
    /// domain must outlive it. Errors: those of Runner::create().
    static Result<std::unique_ptr<Division>> begin(const Runner::Impl& runner, const Domain& domain,
                                                   const Error& error);

    /// Waits for progress, at most so long. Resumes whoever awaits the end once it is there.
    void poll(std::chrono::milliseconds patience);
    Progress progress();

    /// Awaits the samples of the run of a runner, whose polls go here meanwhile.
    auto ended(Runner::Impl& runner) {
        struct Awaiter {
            Division& own;
            Runner::Impl& runner;
            bool await_ready() noexcept { return false; }
            void await_suspend(std::coroutine_handle<> waiting) noexcept {
                own.waiting_ = waiting;
                runner.division = &own;
            }
            Result<SampleSet> await_resume() {
                runner.division = nullptr;
                return std::move(*own.end_);
            }
        };
        return Awaiter{*this, runner};
    }

  private:
    Division(Runner runner, const Domain::Impl& of, std::uint32_t parts);
    /// Begins with so many parts.
    void begin_run();
    /// Returns true if it goes on in more parts after this error.
    bool divides_more(const Error& error);

    Runner runner_;
    const WholeJob& job_;
    std::uint32_t candidates_, expected_, parts_, attempts_ = 0;
    std::unique_ptr<DividedRun> run_;
    std::optional<Result<SampleSet>> end_;
    std::coroutine_handle<> waiting_;
};

/// Runs a single job on the whole surface, or in parts where the device cannot hold it. Runner and
/// domain must outlive it.
Task<Result<SampleSet>> run_or_divide(Runner::Impl& runner, const Domain& domain);

} // namespace geodisk
