// Messages that --verbose prints about the device and runs on it.
#pragma once

#include <chrono>
#include <cstdint>

#include <geodisk/device.hpp>
#include <geodisk/runner.hpp>

namespace geodisk::tools {

/// Lines on standard error, if it is enabled.
class DeviceLog {
  public:
    explicit DeviceLog(bool enabled) : enabled_(enabled) {}

    bool is_enabled() const { return enabled_; }

    void tell_device(const DeviceReport& device, const Tuning& tuning, double open_seconds,
                     double compile_seconds) const;
    /// At its begin; `expected` samples, about.
    void tell_task(double min_distance, double expected);
    /// While it runs, every ten seconds.
    void tell_progress(const Progress& state);
    void tell_run(const RunReport& run) const;

  private:
    bool enabled_;
    std::chrono::steady_clock::time_point last_told_{};
};

} // namespace geodisk::tools
