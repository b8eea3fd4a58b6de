// The devices of a batch, lent to one thread each at a time.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "geodisk/device_run.hpp"
#include "geodisk/options/batch_options.hpp"

namespace geodisk::tools {

/// What `--device` says: each device once, by its index. Without it all usable GPUs, or the best
/// device where there are none; for "all" every usable device. Throws UserError(no_device).
std::vector<std::string> chosen_devices(const std::vector<std::string>& given);

class DevicePool {
  public:
    DevicePool(const std::vector<std::string>& devices, bool validates,
               const RunnerOptions& runner);

    std::size_t size() const { return devices_.size(); }

    /// Opens all, so that what none can do is known before the work. Throws UserError.
    void open(ProgressLine& progress);

    /// Names of the devices, which are open.
    std::vector<std::string> names() const;

    /// A device that is given back when it goes.
    class Loan {
      public:
        Loan(DevicePool& pool, RunDevice& device) : pool_(pool), device_(device) {}
        ~Loan() { pool_.give_back(device_); }
        Loan(const Loan&) = delete;
        Loan& operator=(const Loan&) = delete;

        RunDevice& device() const { return device_; }

      private:
        DevicePool& pool_;
        RunDevice& device_;
    };
    /// Waits until one is free.
    Loan borrow();

  private:
    void give_back(RunDevice& device);

    std::deque<RunDevice> devices_;
    std::mutex mutex_;
    std::condition_variable returned_;
    std::vector<RunDevice*> free_;
};

} // namespace geodisk::tools
