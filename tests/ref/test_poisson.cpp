// Numbers of candidates follow the Poisson law: counts of numbers against its probabilities, by the
// words that candidates have.
#include <algorithm>
#include <cmath>
#include <map>

#include <doctest/doctest.h>

#include "kernels/poisson.hpp"
#include "lib/rng.hpp"
#include "ref/chi_square.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

/// Numbers of candidates of `count` faces.
std::map<std::uint32_t, double> drawn(float mean, std::uint32_t count) {
    std::map<std::uint32_t, double> numbers;
    for (std::uint32_t face = 0; face < count; ++face) {
        const auto words = ref::philox(5, {face, 0, 0, 0xffffffff});
        numbers[ref::poisson(mean, words[0], words[1])] += 1;
    }
    return numbers;
}

/// In bins of at least `least` numbers expected each.
void check_law(float mean, std::uint32_t count, double least = 20) {
    CAPTURE(mean);
    const std::map<std::uint32_t, double> numbers = drawn(mean, count);
    const double m = static_cast<double>(mean);
    const double far = 12 * std::sqrt(m) + 20;
    std::vector<double> counts{0}, expected{0};
    double sum = 0, squares = 0;
    for (auto n = static_cast<std::uint32_t>(std::max(0.0, m - far)); n < m + far; ++n) {
        expected.back() += count * std::exp(n * std::log(m) - m - std::lgamma(n + 1.0));
        const auto found = numbers.find(n);
        const double times = found == numbers.end() ? 0 : found->second;
        counts.back() += times;
        sum += times * n;
        squares += times * (n - m) * (n - m);
        if (expected.back() >= least) {
            expected.push_back(0);
            counts.push_back(0);
        }
    }
    // The remainder of the last bin goes to the one before.
    expected[expected.size() - 2] += expected.back();
    counts[counts.size() - 2] += counts.back();
    expected.pop_back();
    counts.pop_back();
    const auto freedom = static_cast<double>(expected.size()) - 1;
    REQUIRE(freedom >= 1);
    check_chi_square(counts, expected, freedom);
    // Mean and variance, within 5 of their standard errors.
    CHECK(std::abs(sum / count - m) < 5 * std::sqrt(m / count));
    CHECK(std::abs(squares / count - m) < 5 * std::sqrt((m + 2 * m * m) / count));
}

} // namespace

TEST_CASE("poisson: the law, from small means to large ones") {
    for (const float mean : {1e-3f, 0.02f, 0.3f, 1.0f, 2.5f, 5.0f, 7.999f}) {
        check_law(mean, 1'000'000);
    }
    // The whole part by itself, and a rest.
    for (const float mean : {8.0f, 8.5f, 12.0f, 31.7f, 100.0f, 999.5f}) {
        check_law(mean, 400'000);
    }
    for (const float mean : {1e4f, 1e5f}) {
        check_law(mean, 40'000);
    }
}

TEST_CASE("poisson: extremes") {
    CHECK(ref::poisson(0, 0, 0) == 0);
    CHECK(ref::poisson(0x1p-41f, 0, 0) == 0);
    CHECK(ref::poisson(-1, 0, 0) == 0);
    CHECK(ref::poisson(std::nanf(""), 0, 0) == 0);
    CHECK(ref::poisson(1e-9f, 0, 0) == 1); // The first word of 2^32 stands for 2^-33.
    CHECK(ref::poisson(1e-9f, 0, 8) == 0);
    CHECK(ref::poisson(1, ~0u, ~0u) == 0);
    // No word gives a number that the law makes less probable than 2^-32 by much.
    for (const float mean : {0.5f, 4.0f, 7.9f, 8.1f, 50.0f, 1e3f, 1e6f, 0x1p24f}) {
        CAPTURE(mean);
        const float far = 7 * std::sqrt(mean) + 20;
        for (const std::uint32_t whole : {0u, 1u, 1u << 31, ~0u - 1, ~0u}) {
            for (const std::uint32_t rest : {0u, 1u, 1u << 31, ~0u - 1, ~0u}) {
                const auto n = static_cast<float>(ref::poisson(mean, whole, rest));
                CHECK(n >= mean - far);
                CHECK(n <= mean + far);
            }
        }
    }
}
