#include "lib/stages.hpp"

#include <algorithm>
#include <cmath>

namespace geodisk::ref {
namespace {

/// Candidates of a stage of a pool, and of the first stage of darts, per expected sample.
constexpr double kFirstDarts = 5;
constexpr double kMaximumDarts = 640;
/// Bounds of the candidates of a stage of darts.
constexpr double kLargestStage = 8388608; // 2^23
constexpr double kSmallestStage = 64;
constexpr double kMaximumPoolStages = 15;

} // namespace

StageRule StageRule::of(double samples, double pool_ratio, std::uint32_t darts) {
    return {samples, std::max(pool_ratio, kSmallestStage / samples), darts};
}

std::uint32_t StageRule::pool_stages() const {
    const double stages = std::min(std::ceil(ratio / kFirstDarts), kMaximumPoolStages);
    return stages > 1 ? static_cast<std::uint32_t>(stages) : 1;
}

double StageRule::per_sample(std::uint32_t stage) const {
    if (darts == 0) {
        return ratio / pool_stages();
    }
    // All stages of darts have a power of two times five.
    const double bound = std::min(kMaximumDarts, kLargestStage / samples);
    const double largest = std::ldexp(kFirstDarts, std::ilogb(bound / kFirstDarts));
    const int doublings = static_cast<int>(std::min(stage, 64u));
    const double wanted = std::min(std::ldexp(std::min(kFirstDarts, largest), doublings), largest);
    return std::max(wanted, kSmallestStage / samples);
}

} // namespace geodisk::ref
