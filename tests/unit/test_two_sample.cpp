// The test that tells whether spectra differ: how often it is wrong, and how often it finds what is
// there.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "paper/two_sample.hpp"

using namespace geodisk::paper;
using geodisk::tools::analysis::SurfaceSpectrum;

namespace {

constexpr std::size_t kHarmonics = 300, kSets = 8;
constexpr std::uint32_t kDeals = 200;
constexpr int kRuns = 100;

/// Powers of Gaussian sums, as those of many samples; in the second half of the sets some are
/// multiplied.
template <class Factor>
SurfaceSpectrum make_spectrum(std::uint64_t seed, const Factor& factor) {
    SurfaceSpectrum spectrum{1, {}, {}};
    for (std::size_t i = 0; i < kHarmonics; ++i) {
        spectrum.frequencies.push_back(std::sqrt(static_cast<double>(i + 1) / 3.14159));
    }
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    for (std::size_t set = 0; set < 2 * kSets; ++set) {
        std::vector<double>& powers = spectrum.powers.emplace_back();
        for (std::size_t i = 0; i < kHarmonics; ++i) {
            const double sum = normal(random);
            powers.push_back(sum * sum * (set < kSets ? 1 : factor(i)));
        }
    }
    return spectrum;
}

std::vector<std::size_t> half(std::size_t first) {
    std::vector<std::size_t> sets;
    for (std::size_t i = 0; i < kSets; ++i) {
        sets.push_back(first + i);
    }
    return sets;
}

SpectrumDifference compare(const SurfaceSpectrum& spectrum, std::uint64_t seed) {
    return compare_groups(spectrum, half(0), half(kSets), kDeals, seed);
}

/// The powers of each ring raised or lowered, by about `size` in their logarithm.
double changed_rings(std::size_t harmonic, double size) {
    const auto ring =
        static_cast<std::size_t>(std::sqrt(static_cast<double>(harmonic + 1) / 3.14159));
    return std::exp(ring % 2 == 0 ? size : -size);
}

} // namespace

TEST_CASE("groups of one law differ as often as chance allows") {
    int means = 0, anisotropies = 0;
    for (int run = 0; run < kRuns; ++run) {
        const auto seed = static_cast<std::uint64_t>(run);
        const SpectrumDifference found =
            compare(make_spectrum(seed, [](std::size_t) { return 1.0; }), seed);
        means += found.radial_mean.p < 0.05 ? 1 : 0;
        anisotropies += found.anisotropy.p < 0.05 ? 1 : 0;
    }
    // More than 14 come once in ten thousand times of a binomial law with 5 expected.
    CHECK(means <= 14);
    CHECK(anisotropies <= 14);
}

TEST_CASE("a difference of the detectable size is found nine times of ten") {
    double detectable = 0;
    for (int run = 0; run < kRuns; ++run) {
        const auto seed = static_cast<std::uint64_t>(run);
        detectable += compare(make_spectrum(seed, [](std::size_t) { return 1.0; }), seed)
                          .radial_mean.detectable /
                      kRuns;
    }
    CHECK(detectable > 0.02);
    CHECK(detectable < 0.3);
    int found = 0;
    for (int run = 0; run < kRuns; ++run) {
        const auto seed = std::uint64_t{1000} + static_cast<std::uint64_t>(run);
        const SurfaceSpectrum spectrum = make_spectrum(
            seed, [&](std::size_t harmonic) { return changed_rings(harmonic, detectable); });
        found += compare(spectrum, seed).radial_mean.p < 0.05 ? 1 : 0;
    }
    CHECK(found >= 78);
    CHECK(found <= 99);
}

TEST_CASE("waves that all sets prefer show in the anisotropy alone") {
    int found = 0;
    for (int run = 0; run < 20; ++run) {
        const auto seed = static_cast<std::uint64_t>(run);
        const SpectrumDifference difference = compare(
            make_spectrum(seed, [](std::size_t harmonic) { return harmonic % 2 == 0 ? 0.2 : 1.8; }),
            seed);
        found += difference.anisotropy.p < 0.01 ? 1 : 0;
        CHECK(difference.anisotropy.size > difference.anisotropy.detectable / 2);
    }
    CHECK(found >= 19);
}
