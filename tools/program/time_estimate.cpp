#include "program/time_estimate.hpp"

#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

// Seconds of work at first that say little of the rest, as memory for disks grows; and those that
// do.
constexpr double kWarmUp = 1;
constexpr double kTrial = 2;

} // namespace

void TimeEstimate::note(double seconds, double part) {
    seconds -= waited_;
    seconds_ = seconds;
    if (part > 0 && !first_) { // Drawing candidates says little of the disks.
        first_ = seconds;
    }
    if (!first_ || seconds - *first_ < kWarmUp) {
        start_seconds_ = seconds;
        start_part_ = part;
    } else if (seconds - start_seconds_ >= kTrial && part > start_part_ &&
               part - start_part_ >= min_part_) {
        left_ = (1 - part) * (seconds - start_seconds_) / (part - start_part_);
    }
}

std::optional<double> TimeEstimate::long_run() {
    if (is_told_ || !left_ || seconds_ + *left_ < kLongRun) {
        return std::nullopt;
    }
    is_told_ = true;
    return seconds_ + *left_;
}

bool TimeEstimate::is_long_already() {
    const bool is_news = !is_told_already_ && !left_ && seconds_ >= kLongRun;
    is_told_already_ = is_told_already_ || is_news;
    return is_news;
}

std::string TimeEstimate::left_text() const {
    return left_ && *left_ >= 1 ? ", about " + seconds_text(*left_) + " left" : "";
}

} // namespace geodisk::tools
