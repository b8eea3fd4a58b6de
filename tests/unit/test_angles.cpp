// Sines, cosines and angles: those of the C library, but for the last bits.
#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "geometry/angles.hpp"

namespace geodisk::tools {
namespace {

constexpr double kLastBits = 1e-15;

TEST_CASE("sines and cosines are right to the last bits") {
    for (int i = -20000; i <= 20000; ++i) {
        const double angle = i * 0.00123;
        REQUIRE(std::abs(sine(angle) - std::sin(angle)) < kLastBits);
        REQUIRE(std::abs(cosine(angle) - std::cos(angle)) < kLastBits);
    }
    CHECK(sine(0) == 0);
    CHECK(cosine(0) == 1);
    CHECK(std::abs(sine(std::numbers::pi)) < kLastBits);
    CHECK(std::abs(cosine(std::numbers::pi) + 1) < kLastBits);
}

TEST_CASE("angles are right to the last bits") {
    for (int i = 0; i <= 10000; ++i) {
        const double angle = std::numbers::pi * i / 10000;
        for (const double length : {1e-100, 1.0, 1e100}) {
            const double y = length * std::abs(std::sin(angle)), x = length * std::cos(angle);
            REQUIRE(std::abs(angle_of(y, x) - std::atan2(y, x)) < 5 * kLastBits);
        }
    }
    CHECK(angle_of(0, 2) == 0);
    CHECK(angle_of(0, 0) == 0);
    CHECK(angle_of(3, 0) == doctest::Approx(std::numbers::pi / 2));
    CHECK(angle_of(0, -2) == doctest::Approx(std::numbers::pi));
}

} // namespace
} // namespace geodisk::tools
