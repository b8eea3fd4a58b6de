#include <geodisk/count_search.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace geodisk {
namespace {

constexpr double kTolerance = 0.05;
constexpr std::uint32_t kMaxTries = 7;
/// Limits of an exact search: the part of a count that may be too much; tries, and tries while none
/// has given enough.
constexpr double kMaxExcess = 0.01;
constexpr std::uint32_t kExactTries = 6;
constexpr std::uint32_t kMaxExactTries = 12;
/// Samples expected at a distance up to which an exact search goes on where smaller distances give
/// no more, but some.
constexpr double kMaxExpected = 0x1p17;
/// Stands for no sample at all in an exact search.
constexpr double kNone = 0.5;
/// Maximum factor between the distances of the first two tries, and of later ones on one side.
constexpr double kFar = 4;
constexpr double kMaxFactor = 2;
/// Minimum distance of the next try from both sides, as a part of the interval between them.
constexpr double kMargin = 0.1;
/// Variance of a count by chance, per sample wanted; and the part of it that another distance
/// nearby repeats.
constexpr double kChance = 0.08;
constexpr double kLasting = 0.4;
/// Excess over the wanted count, as a part of it, from which on most samples are on thin parts; and
/// their share then.
constexpr double kAllThin = 0.25;
constexpr double kMaxThin = 0.9;
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
double about_factor(double count, double wanted) {
    const double variance = kChance * wanted;
    const double lasting = 1 - std::min(0.5, (1 - kLasting) * variance / square(count - wanted));
    const double ratio = 1 + lasting * (count / wanted - 1);
    const double sure = ratio - 1 - 2 * std::sqrt(variance) / wanted;
    const double thin = std::clamp(sure / kAllThin, 0.0, kMaxThin);
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
        return kMaxFactor / ratio;
    }
    const double goal = std::max(1 + part * (power - 1), power / square(kMaxFactor));
    return is_slow ? 1 / goal : std::sqrt(1 / goal);
}

} // namespace

CountSearch CountSearch::exact(std::uint64_t count) noexcept {
    CountSearch search(static_cast<double>(count));
    const double excess = std::floor(kMaxExcess * search.wanted_);
    search.max_ = search.wanted_ + excess;
    search.aim_ = search.wanted_ + excess / 2;
    return search;
}

bool CountSearch::ends_with(double distance, double count) noexcept {
    const bool is_first = tries_++ == 0;
    first_distance_ = is_first ? distance : first_distance_;
    if (max_) {
        is_nearest_ = count >= wanted_ && distance > best_distance_;
        best_distance_ = is_nearest_ ? distance : best_distance_;
        return (count >= wanted_ && count <= *max_) ||
               tries_ >= (best_distance_ > 0 ? kExactTries : kMaxExactTries);
    }
    const double miss = std::abs(std::max(count, 1.0) - wanted_);
    is_nearest_ = is_first || miss < min_miss_;
    min_miss_ = is_nearest_ ? miss : min_miss_;
    // For small counts, one sample more or less is as close as possible.
    const double allowed = std::max(kTolerance * wanted_, std::min(1.0, wanted_ / 4));
    return miss <= allowed || tries_ == kMaxTries;
}

double CountSearch::first_factor(double count) const noexcept {
    // A distance close by repeats most of the chance, so an exact search makes up for it.
    double factor = max_ ? std::sqrt(count / aim_) : about_factor(count, wanted_);
    // The step grows as long as all tries are on one side.
    for (std::uint32_t i = max_ ? 2 : 1; i < tries_; ++i) {
        factor *= factor;
    }
    return std::clamp(factor, 1 / kFar, kFar);
}

// Uses only operations with one possible IEEE 754 result, since the distance decides the samples.
std::optional<double> CountSearch::note(double distance, std::uint64_t count) noexcept {
    if (ends_with(distance, static_cast<double>(count))) {
        return std::nullopt;
    }
    const Try last{distance, std::max(static_cast<double>(count), max_ ? kNone : 1)};
    const bool is_above = last.count > wanted_;
    std::optional<Try>& own = is_above ? above_ : below_;
    const std::optional<Try> before = std::exchange(own, last);
    std::optional<Try>& other = is_above ? below_ : above_;
    const bool is_again = std::exchange(was_above_, is_above) == is_above;
    if (other) {
        if (max_ && is_again && before) { // The other side is far off; go nearer to it.
            other->count = aim_ + (other->count - aim_) / 2;
        }
        return other->distance *
               trend_factor(other->distance / distance, other->count, last.count, aim_);
    }
    if (before && std::max(before->distance / distance, distance / before->distance) > kTrend) {
        const double goal = before->distance * trend_factor(before->distance / distance,
                                                            before->count, last.count, aim_);
        const double next = std::clamp(goal, distance / kMaxFactor, distance * kMaxFactor);
        const bool is_stuck = distance > kWide * before->distance
                                  ? last.count >= before->count
                                  : max_ && kWide * distance < before->distance &&
                                        last.count <= before->count &&
                                        (last.count == kNone ||
                                         wanted_ * square(first_distance_ / next) > kMaxExpected);
        return is_stuck ? std::nullopt : std::optional(next);
    }
    return distance * first_factor(last.count);
}

} // namespace geodisk
