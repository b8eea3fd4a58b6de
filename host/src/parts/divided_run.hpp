// DividedRun: samples a surface in parts, one after another on one device.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/status.hpp>

#include "engine/domain/domain_impl.hpp"
#include "parts/local_exchange.hpp"
#include "parts/sample_parts.hpp"

namespace geodisk {

/// The set is that of the whole. Each part has a thread, which mostly waits; the caller's thread
/// only polls. The runner is not to be used meanwhile.
class DividedRun {
  public:
    /// Begins. The job, what it refers to and the runner must outlive it. Throws std::bad_alloc,
    /// and std::system_error where no thread can be started.
    DividedRun(Runner& runner, const WholeJob& job, std::uint32_t parts);
    /// Cancels what is left.
    ~DividedRun();
    DividedRun(const DividedRun&) = delete;
    DividedRun& operator=(const DividedRun&) = delete;

    /// Waits until there is progress, the samples are there, or so long. Returns the samples, or
    /// nothing yet. Errors: those of sample_parts(). Once it has returned samples or an error, the
    /// run has ended.
    Result<std::optional<SampleSet>> poll(std::chrono::milliseconds patience);
    /// Returns how far all parts are together, about.
    Progress progress();
    /// Ends the run soon, with Status::cancelled.
    void cancel();

  private:
    void work(std::size_t part);
    bool note(std::size_t part, const Progress& now);

    Runner& runner_;
    Cut cut_;
    WholeSurface whole_;
    std::vector<std::unique_ptr<LocalExchange>> exchanges_;
    std::mutex mutex_; ///< Guards all below.
    std::condition_variable changed_;
    std::optional<Result<SampleSet>> result_;
    std::size_t working_; ///< Parts that have not ended.
    bool has_news_ = false;
    bool is_cancelled_ = false;
    std::size_t latest_ = 0;  ///< Part of the progress that was noted last.
    Progress done_{}, now_{}; ///< Of all runs of parts before, and of the latest.
    std::vector<std::thread> threads_;
};

} // namespace geodisk
