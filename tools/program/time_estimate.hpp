// Estimate of how long a run will take, by what is done of it.
#pragma once

#include <optional>
#include <string>

namespace geodisk::tools {

/// Runs that are expected to take longer are worth a word.
inline constexpr double kLongRun = 20;

/// Follows one run.
class TimeEstimate {
  public:
    /// `min_part`: less of the work than that says little of the rest.
    explicit TimeEstimate(double min_part = 0) : min_part_(min_part) {}

    /// Notes that the work has not begun after so many seconds, as kernels are compiled. What is
    /// told below is from then on.
    void wait(double seconds) { waited_ = seconds; }
    /// Notes that so much of the work, 0 to 1, is done after so many seconds.
    void note(double seconds, double part);
    /// Seconds of work so far.
    double seconds() const { return seconds_; }
    /// Seconds that are left; none while too little is known.
    std::optional<double> left() const { return left_; }
    /// The same as ", about 5 s left"; "" for less than a second and while too little is known.
    std::string left_text() const;
    /// Seconds that the whole run takes, once, if that is a long time.
    std::optional<double> long_run();
    /// Returns true once, when that long has passed and nobody knows what is left.
    bool is_long_already();

  private:
    double min_part_;
    double waited_ = 0, start_seconds_ = 0, start_part_ = 0, seconds_ = 0;
    bool is_told_ = false, is_told_already_ = false;
    std::optional<double> first_, left_; ///< Seconds when work began; and that are left.
};

} // namespace geodisk::tools
