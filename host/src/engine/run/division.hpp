// Division: a run in parts, for a surface that the device cannot hold.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

#include <geodisk/runner.hpp>
#include <geodisk/status.hpp>

#include "engine/domain/domain_impl.hpp"
#include "engine/run/runner_impl.hpp"
#include "parts/divided_run.hpp"

namespace geodisk {

/// Samples a surface in as few parts as fit, about: where they turn out too large, in twice as
/// many. Has a runner of its own.
class Division {
  public:
    /// Begins, if parts may help: after this error of a run of the whole. Returns null if not. The
    /// domain must outlive it. Errors: those of Runner::create().
    static Result<std::unique_ptr<Division>> begin(const Runner::Impl& runner, const Domain& domain,
                                                   const ProgressCallback& progress,
                                                   const Error& error);

    /// As Runner::poll().
    Result<std::optional<SampleSet>> poll(std::chrono::milliseconds patience);
    Progress progress();

  private:
    Division(Runner runner, const WholeJob& job, ProgressCallback on_progress,
             std::uint32_t candidates)
        : runner_(std::move(runner)), job_(job), on_progress_(std::move(on_progress)),
          candidates_(candidates) {}
    /// Begins with so many parts.
    void begin_run();
    /// Returns true if it goes on in more parts after this error.
    bool divides_more(const Error& error);

    Runner runner_;
    const WholeJob& job_;
    ProgressCallback on_progress_;
    std::uint32_t candidates_, expected_ = 0, parts_ = 2, attempts_ = 0;
    bool goes_on_ = true;
    std::unique_ptr<DividedRun> run_;
};

} // namespace geodisk
