// SharedRun: state that parts of a work share, which run on several threads.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>

#include <geodisk/runner.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Their progress, told one call at a time, and their first error.
class SharedRun {
  public:
    explicit SharedRun(const ProgressCallback& heard) : heard_(heard) {}

    bool goes_on() const { return !is_over_; }

    /// Tells how much is done. Returns false if the work is to stop; it is then `cancelled`, unless
    /// it has failed.
    bool tell(std::uint32_t done, std::uint32_t all) {
        if (heard_ && goes_on()) {
            const std::lock_guard lock(mutex_);
            if (!is_over_ && !heard_(Progress{done, all, 0, 0, 0})) {
                is_over_ = true;
                result_ = Error{Status::cancelled, "cancelled"};
            }
        }
        return goes_on();
    }

    /// Ends the work with the error, if there is one.
    bool check(const Result<Done>& result) {
        if (result) {
            return true;
        }
        const std::lock_guard lock(mutex_);
        is_over_ = true;
        if (result_) {
            result_ = result;
        }
        return false;
    }

    const Result<Done>& result() const { return result_; }

  private:
    const ProgressCallback& heard_;
    std::mutex mutex_;
    std::atomic<bool> is_over_ = false;
    Result<Done> result_ = Done{};
};

} // namespace geodisk
