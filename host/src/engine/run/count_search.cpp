#include <geodisk/count_search.hpp>

#include <algorithm>
#include <cmath>

namespace geodisk {
namespace {

constexpr double kTolerance = 0.05;
constexpr std::uint32_t kMostTries = 7;
/// Maximum factor between distances of consecutive tries.
constexpr double kMostFactor = 4;
/// Minimum distance of the next try from both sides, as a part of the interval between them.
constexpr double kMargin = 0.1;

} // namespace

// Uses only operations with one possible IEEE 754 result, since the distance decides the samples.
std::optional<double> CountSearch::note(double distance, std::uint64_t count) noexcept {
    const Try last{distance, static_cast<double>(std::max<std::uint64_t>(count, 1))};
    const double miss = std::abs(last.count - wanted_);
    is_nearest_ = tries_ == 0 || miss < least_miss_;
    least_miss_ = is_nearest_ ? miss : least_miss_;
    ++tries_;
    // For small counts, one sample more or less is as close as possible.
    const double allowed = std::max(kTolerance * wanted_, std::min(1.0, wanted_ / 4));
    if (miss <= allowed || tries_ == kMostTries) {
        return std::nullopt;
    }
    (last.count > wanted_ ? above_ : below_) = last;
    if (above_ && below_) {
        // On an area, counts fall with the square of the distance.
        const auto per_square = [](const Try& one) { return 1 / (one.distance * one.distance); };
        const double part = (above_->count - wanted_) / (above_->count - below_->count);
        return 1 / std::sqrt(per_square(*above_) + std::clamp(part, kMargin, 1 - kMargin) *
                                                       (per_square(*below_) - per_square(*above_)));
    }
    // Along thin parts, counts fall with the distance; where each part has one sample, they hardly
    // change. So the step grows as long as all tries are on one side.
    const double ratio = last.count / wanted_;
    double factor = std::sqrt(ratio);
    for (std::uint32_t i = 1; i < tries_; ++i) {
        factor *= factor;
    }
    return distance * std::clamp(factor, 1 / kMostFactor, kMostFactor);
}

} // namespace geodisk
