#include "kernels/poisson.hpp"

#include "lib/scalar.hpp"

namespace geodisk::ref {
namespace {

constexpr float kSmallestMean = 0x1p-40f;
/// From this mean on, its integer part is drawn separately.
constexpr float kWalkedMean = 8;
/// Less probable numbers are ignored.
constexpr float kSmallestProbability = 0x1p-32f;
constexpr std::uint32_t kMaxOfTail = 64;

/// Returns the middle of one of 2^32 equal parts of [0, 1].
float unit_fraction(std::uint32_t u) {
    return (static_cast<float>(u >> 8) * 256.0f + (static_cast<float>(u & 255u) + 0.5f)) * 0x1p-32f;
}

/// Returns 1 - exp(-r), 0 <= r < 0.5, by its series.
float one_less_exp(float r) {
    float rest = 1.0f;
    for (int k = 8; k > 1; --k) {
        rest = 1.0f - (r * (1.0f / static_cast<float>(k))) * rest;
    }
    return r * rest;
}

/// Returns, for a mean from 0 to 8, the largest n with P(N >= n) above the target.
std::uint32_t poisson_tail(float mean, std::uint32_t word) {
    const float target = unit_fraction(word);
    // P(N >= 1) is below the mean except for rounding.
    if (target > mean * 1.001f) {
        return 0;
    }
    const float t = one_less_exp(mean * 0.0625f);
    float p = 1.0f - t; // P(N = n)
    float q = t;        // P(N >= n + 1)
    for (int i = 0; i < 4; ++i) {
        p = p * p;
        q = q * (2.0f - q);
    }
    std::uint32_t n = 0;
    while (target < q && p > kSmallestProbability && n < kMaxOfTail) {
        ++n;
        p = ratio(p * mean, static_cast<float>(n));
        q = q - p;
    }
    return n;
}

/// Returns a number for an integer mean, by inversion outwards from the mode; its probability is
/// from Stirling's series.
std::uint32_t poisson_walk(std::uint32_t mean, std::uint32_t word) {
    const auto c = static_cast<float>(mean);
    const float e1 = ratio(1.0f, 12.0f * c);
    const float e3 = ratio(1.0f, 360.0f * ((c * c) * c));
    const float e = e1 - e3;
    const float p = ratio(1.0f, root(6.2831855f * c)) * ((1.0f - e) + 0.5f * (e * e));
    std::uint32_t above = mean, below = mean;
    float p_above = p, p_below = p;
    float target = unit_fraction(word) - p;
    if (target < 0) {
        return mean;
    }
    while (p_above > kSmallestProbability || (below > 0 && p_below > kSmallestProbability)) {
        ++above;
        p_above = p_above * ratio(c, static_cast<float>(above));
        target = target - p_above;
        if (target < 0) {
            return above;
        }
        if (below > 0) {
            p_below = p_below * ratio(static_cast<float>(below), c);
            --below;
            target = target - p_below;
            if (target < 0) {
                return below;
            }
        }
    }
    return mean;
}

} // namespace

std::uint32_t poisson(float mean, std::uint32_t whole_word, std::uint32_t rest_word) {
    if (!(mean >= kSmallestMean)) {
        return 0;
    }
    const std::uint32_t whole = mean < kWalkedMean ? 0 : static_cast<std::uint32_t>(mean);
    const float rest = mean - static_cast<float>(whole);
    return (whole > 0 ? poisson_walk(whole, whole_word) : 0) + poisson_tail(rest, rest_word);
}

} // namespace geodisk::ref
