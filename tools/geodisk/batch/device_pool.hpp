// The devices of a batch, lent to threads for a run each.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "geodisk/device_run.hpp"
#include "geodisk/options/batch_options.hpp"

namespace geodisk::tools {

/// Returns the devices that `--device` names, each once, by its index. Without it, returns all
/// usable GPUs, or the best device if there are none; for "all" every usable device. Throws
/// UserError(no_device).
std::vector<std::string> chosen_devices(const std::vector<std::string>& given);

class DevicePool {
  public:
    /// Each device does up to `runs` runs side by side, to be busy while one of them waits.
    DevicePool(const std::vector<std::string>& devices, bool validates, const RunnerOptions& runner,
               std::size_t runs);

    /// Returns the number of devices.
    std::size_t size() const { return devices_.size(); }

    /// Opens all, so that what none can do is known before the work. Throws UserError.
    void open(ProgressLine& progress);

    /// Names of the devices, which are open.
    std::vector<std::string> names() const;

  private:
    struct Device {
        std::deque<RunDevice> runs;
        std::vector<RunDevice*> free; ///< Those of `runs` that nobody has.
        bool is_lent_whole = false;
    };

  public:
    /// A device that is given back when it goes.
    class Loan {
      public:
        Loan(DevicePool& pool, Device& device, RunDevice& run, bool is_whole)
            : pool_(pool), device_(device), run_(run), is_whole_(is_whole) {}
        ~Loan() { pool_.give_back(device_, run_, is_whole_); }
        Loan(const Loan&) = delete;
        Loan& operator=(const Loan&) = delete;

        RunDevice& device() const { return run_; }

      private:
        DevicePool& pool_;
        Device& device_;
        RunDevice& run_;
        bool is_whole_;
    };
    /// Waits until a device can do one more run.
    Loan borrow();
    /// Waits until no run is on a device, and frees what others keep there. There is no other until
    /// it is given back.
    Loan borrow_whole();
    /// Returns true if a device may do several runs at once.
    bool is_shared() const { return devices_.front().runs.size() > 1; }

  private:
    void give_back(Device& device, RunDevice& run, bool is_whole);

    std::deque<Device> devices_;
    std::mutex mutex_;
    std::condition_variable returned_;
    std::size_t waiting_ = 0; ///< Threads that want a whole device.
};

} // namespace geodisk::tools
