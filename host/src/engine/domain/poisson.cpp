#include "engine/domain/poisson.hpp"

#include "support/rounded.hpp"

namespace geodisk {
namespace {

// As in shaders/lib/poisson.glsl.
constexpr float kSmallestProbability = 0x1p-32f;
constexpr float kSmallestMean = 0x1p-40f;
constexpr float kLargestTailMean = 8;
constexpr std::uint32_t kMaxTailSteps = 64;
constexpr int kMaxFactor = 8; // Terms of the series of 1 - exp(-r).

/// Returns a number in (0, 1).
float unit_fraction(std::uint32_t word) {
    const float low = static_cast<float>(word & 255u) + 0.5f;
    return (static_cast<float>(word >> 8) * 256.0f + low) * 0x1p-32f;
}

/// Returns, for a mean below kLargestTailMean, how many n have P(N >= n) above the fraction.
std::uint32_t poisson_tail(float mean, std::uint32_t word) {
    const float fraction = unit_fraction(word);
    const float r = mean * 0.0625f;
    float series = 1;
    for (int k = kMaxFactor; k >= 2; --k) {
        series = 1.0f - r * (1.0f / static_cast<float>(k)) * series;
    }
    float any = r * series; // P(N >= n + 1)
    float p = 1.0f - any;   // P(N = n)
    for (int i = 0; i < 4; ++i) {
        p = p * p;
        any = any * (2.0f - any);
    }
    std::uint32_t n = 0;
    while (fraction < any && p > kSmallestProbability && n < kMaxTailSteps) {
        ++n;
        p = ratio(p * mean, static_cast<float>(n));
        any = any - p;
    }
    return n;
}

/// Returns a number for an integer mean of at least 8, from the mode outwards.
std::uint32_t poisson_walk(std::uint32_t mean, std::uint32_t word) {
    const auto c = static_cast<float>(mean);
    const float e = ratio(1.0f, 12.0f * c) - ratio(1.0f, 360.0f * ((c * c) * c));
    const float series = (1.0f - e) + 0.5f * (e * e);
    const float most = ratio(1.0f, root(6.2831855f * c)) * series;
    std::uint32_t above = mean, below = mean;
    float p_above = most, p_below = most;
    float rest = unit_fraction(word) - most;
    while (rest >= 0 &&
           (p_above > kSmallestProbability || (below > 0 && p_below > kSmallestProbability))) {
        ++above;
        p_above = p_above * ratio(c, static_cast<float>(above));
        rest = rest - p_above;
        if (rest < 0) {
            return above;
        }
        if (below > 0) {
            p_below = p_below * ratio(static_cast<float>(below), c);
            --below;
            rest = rest - p_below;
            if (rest < 0) {
                return below;
            }
        }
    }
    return mean;
}

} // namespace

std::uint32_t poisson(float mean, std::uint32_t first, std::uint32_t second) {
    if (!(mean >= kSmallestMean)) {
        return 0;
    }
    const std::uint32_t whole = mean < kLargestTailMean ? 0 : static_cast<std::uint32_t>(mean);
    const std::uint32_t count = poisson_tail(mean - static_cast<float>(whole), second);
    return whole > 0 ? count + poisson_walk(whole, first) : count;
}

} // namespace geodisk
