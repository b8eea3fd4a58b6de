// Tests that counts of samples are distinguished from those of an even spread.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "analysis/evenness.hpp"

using namespace geodisk::tools::analysis;

namespace {

/// Counts of 1,000 independent points in each set; region 0 gets `more` times its part.
std::vector<std::vector<double>> random_counts(std::uint64_t seed, const std::vector<double>& areas,
                                               double more) {
    std::mt19937_64 random(seed);
    double all = 0;
    for (const double area : areas) {
        all += area;
    }
    all += (more - 1) * areas[0];
    std::vector<std::vector<double>> sets(12, std::vector<double>(areas.size(), 0));
    for (std::vector<double>& counts : sets) {
        for (int i = 0; i < 1000; ++i) {
            double at = static_cast<double>(random() >> 11) * 0x1p-53 * all;
            std::size_t region = 0;
            for (; region + 1 < areas.size(); ++region) {
                const double area = areas[region] * (region == 0 ? more : 1);
                if (at < area) {
                    break;
                }
                at -= area;
            }
            counts[region] += 1;
        }
    }
    return sets;
}

} // namespace

TEST_CASE("tails of chi-square are those of tables") {
    CHECK(chi_square_tail(18.307, 10) == doctest::Approx(0.05).epsilon(0.01));
    CHECK(chi_square_tail(23.209, 10) == doctest::Approx(0.01).epsilon(0.02));
    CHECK(chi_square_tail(30.336, 31) == doctest::Approx(0.5).epsilon(0.01));
    CHECK(chi_square_tail(0, 31) == doctest::Approx(1));
}

TEST_CASE("even counts pass as often as they should, uneven ones do not") {
    const std::vector<double> areas = {1, 2, 0.5, 1, 1, 3, 0, 1.5};
    int rejected = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const auto even = test_evenness(random_counts(seed, areas, 1), areas);
        REQUIRE(even);
        CHECK(even->sets == 12);
        CHECK(even->regions == 7);
        CHECK(even->freedom == 6);
        rejected += even->p < 0.05;
        CHECK(even->dispersion == doctest::Approx(0.86).epsilon(0.5)); // Of a multinomial.
        CHECK(test_evenness(random_counts(seed, areas, 1.4), areas)->p < 0.05);
    }
    CHECK(rejected < 30); // 10 of 200, and more as the variance is an estimate.
    CHECK(rejected > 1);
}

TEST_CASE("what tells nothing is no test") {
    const std::vector<double> areas = {1, 1};
    CHECK_FALSE(test_evenness(std::vector<std::vector<double>>{{3, 4}}, areas));
    CHECK_FALSE(test_evenness(std::vector<std::vector<double>>{{3}, {4}}, std::vector<double>{1}));
    CHECK_FALSE(test_evenness(std::vector<std::vector<double>>{{3, 3}, {3, 3}}, areas));
    CHECK_FALSE(test_evenness(std::vector<std::vector<double>>{}, areas));
}

TEST_CASE("regions hang together and are of equal area, as far as faces allow") {
    std::vector<double> centers, areas;
    for (int x = 0; x < 32; ++x) {
        for (int y = 0; y < 8; ++y) {
            centers.insert(centers.end(), {x / 32.0, y / 32.0});
            areas.push_back(1.0 / 1024);
        }
    }
    const Regions regions = make_regions(centers, 2, areas, 16);
    REQUIRE(regions.areas.size() == 16);
    for (const double area : regions.areas) {
        CHECK(area == doctest::Approx(0.25 / 16));
    }
    // Squares of 4 by 4.
    for (std::size_t a = 0; a < areas.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            if (regions.of_face[a] == regions.of_face[b]) {
                CHECK(std::abs(centers[2 * a] - centers[2 * b]) < 4 / 32.0);
                CHECK(std::abs(centers[2 * a + 1] - centers[2 * b + 1]) < 4 / 32.0);
            }
        }
    }
    // More regions than faces leave some empty.
    const Regions few = make_regions(std::vector<double>{0, 1}, 1, std::vector<double>{1, 1}, 8);
    double sum = 0;
    for (const double area : few.areas) {
        sum += area;
    }
    CHECK(sum == 2);
    CHECK(few.of_face[0] != few.of_face[1]);
}
