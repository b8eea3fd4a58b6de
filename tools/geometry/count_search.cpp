#include "geometry/count_search.hpp"

#include <algorithm>
#include <cmath>

namespace geodisk::tools {
namespace {

constexpr double kTolerance = 0.05;
constexpr std::uint32_t kMostTries = 7;
/// Along thin parts counts fall with the distance alone, where parts have one sample each, hardly.
constexpr double kLeastExponent = 0.25;
/// From a try to the next.
constexpr double kMostFactor = 4;
/// Of the way between two tries, that the next keeps from both.
constexpr double kMargin = 0.1;

} // namespace

std::optional<double> CountSearch::note(double distance, std::uint64_t count) {
    const Try last{distance, static_cast<double>(std::max<std::uint64_t>(count, 1))};
    const double miss = std::abs(last.count - wanted_);
    is_nearest_ = !least_miss_ || miss < *least_miss_;
    least_miss_ = is_nearest_ ? miss : *least_miss_;
    ++tries_;
    // One sample more or less of few is as close as can be asked for.
    const double allowed = std::max(kTolerance * wanted_, std::min(1.0, wanted_ / 4));
    if (miss <= allowed || tries_ == kMostTries) {
        return std::nullopt;
    }
    const std::optional<Try> before = last.count > wanted_ ? above_ : below_;
    (last.count > wanted_ ? above_ : below_) = last;
    if (above_ && below_) {
        const double part =
            std::log(above_->count / wanted_) / std::log(above_->count / below_->count);
        return above_->distance * std::pow(below_->distance / above_->distance,
                                           std::clamp(part, kMargin, 1 - kMargin));
    }
    if (before && before->count != last.count) {
        const double slope =
            std::log(before->count / last.count) / std::log(last.distance / before->distance);
        exponent_ = std::clamp(slope, kLeastExponent, exponent_);
    } else if (before) {
        exponent_ = std::max(exponent_ / 2, kLeastExponent);
    }
    const double factor = std::pow(last.count / wanted_, 1 / exponent_);
    return distance * std::clamp(factor, 1 / kMostFactor, kMostFactor);
}

} // namespace geodisk::tools
