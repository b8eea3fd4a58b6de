#include <geodisk/count_search.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace geodisk {
namespace {

constexpr double kTolerance = 0.05;
constexpr std::uint32_t kMostTries = 7;
/// Maximum factor between the distances of the first two tries, and of later ones on one side.
constexpr double kFar = 4;
constexpr double kMostFactor = 2;
/// Minimum distance of the next try from both sides, as a part of the interval between them.
constexpr double kMargin = 0.1;
/// Variance of a count by chance, per sample wanted; and the part of it that another distance
/// nearby repeats.
constexpr double kChance = 0.08;
constexpr double kLasting = 0.4;
/// Excess over the wanted count, as a part of it, from which on most samples are on thin parts; and
/// their share then.
constexpr double kAllThin = 0.25;
constexpr double kMostThin = 0.9;
/// Factor between the distances of two tries beyond which their counts show a trend; and beyond
/// which equal counts show that no distance gives fewer samples.
constexpr double kTrend = 1.1;
constexpr double kWide = 1.5;

double square(double x) {
    return x * x;
}

/// Returns the factor on the distance that should give the wanted count. A part of the difference
/// is chance, which need not be made up for. The first distance is right for an area with borders.
/// If it gives far more samples, they are on thin parts: count = a / D^2 + b / D.
double first_factor(double count, double wanted) {
    const double variance = kChance * wanted;
    const double lasting = 1 - std::min(0.5, (1 - kLasting) * variance / square(count - wanted));
    const double ratio = 1 + lasting * (count / wanted - 1);
    const double sure = ratio - 1 - 2 * std::sqrt(variance) / wanted;
    const double thin = std::clamp(sure / kAllThin, 0.0, kMostThin);
    return ratio * (thin + std::sqrt(square(thin) + 4 * (1 - thin) / ratio)) / 2;
}

/// Returns the factor on distance `a` that gives the wanted count by the trend of two tries: count
/// = u / D^2 + v; or u / D + v where it falls as slowly as along thin parts, or as where most parts
/// have one sample. `ratio` is a / b.
double trend_factor(double ratio, double count_a, double count_b, double wanted) {
    const double fallen = count_b / count_a;
    const bool is_slow = (square(fallen) > square(ratio) * ratio) == (ratio < 1);
    const double power = is_slow ? ratio : square(ratio); // Of 1 / D, where that of a is 1.
    double part = (wanted - count_a) / (count_b - count_a);
    if ((count_a > wanted) != (count_b > wanted)) {
        part = std::clamp(part, kMargin, 1 - kMargin);
    } else if (!(part > 1)) { // There is no trend.
        return kMostFactor / ratio;
    }
    const double goal = std::max(1 + part * (power - 1), power / square(kMostFactor));
    return is_slow ? 1 / goal : std::sqrt(1 / goal);
}

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
    std::optional<Try>& own = last.count > wanted_ ? above_ : below_;
    const std::optional<Try> before = std::exchange(own, last);
    const std::optional<Try>& other = last.count > wanted_ ? below_ : above_;
    if (other) {
        return other->distance *
               trend_factor(other->distance / distance, other->count, last.count, wanted_);
    }
    if (before && std::max(before->distance / distance, distance / before->distance) > kTrend) {
        if (distance > kWide * before->distance && last.count >= before->count) {
            return std::nullopt;
        }
        const double next = before->distance * trend_factor(before->distance / distance,
                                                            before->count, last.count, wanted_);
        return std::clamp(next, distance / kMostFactor, distance * kMostFactor);
    }
    // The step grows as long as all tries are on one side.
    double factor = first_factor(last.count, wanted_);
    for (std::uint32_t i = 1; i < tries_; ++i) {
        factor *= factor;
    }
    return distance * std::clamp(factor, 1 / kFar, kFar);
}

} // namespace geodisk
