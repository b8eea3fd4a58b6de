// Wall time.
#pragma once

#include <chrono>

namespace geodisk::tools {

/// Runs from when it is made.
class Stopwatch {
  public:
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

/// Returns the seconds of `work()`.
template <class Work>
double seconds_of(const Work& work) {
    const Stopwatch watch;
    work();
    return watch.seconds();
}

} // namespace geodisk::tools
