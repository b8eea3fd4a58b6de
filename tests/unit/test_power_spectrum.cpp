// Power spectra against plain sums, and what chance and lattices must give.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "analysis/power_spectrum.hpp"

using geodisk::BoxParams;
using geodisk::tools::analysis::PowerSpectrum;

namespace {

BoxParams box_of(double width, double height) {
    BoxParams box;
    box.extents = {width, height};
    return box;
}

std::vector<double> random_points(std::uint64_t seed, std::size_t count, const BoxParams& box) {
    std::mt19937_64 random(seed);
    std::vector<double> points;
    for (std::size_t i = 0; i < 2 * count; ++i) {
        points.push_back(static_cast<double>(random() >> 11) * 0x1p-53 * box.extents[i % 2]);
    }
    return points;
}

double power_at(const PowerSpectrum& spectrum, std::int64_t column, std::int64_t row) {
    return spectrum.power(std::array{column, row});
}

} // namespace

TEST_CASE("powers are those of plain sums") {
    const BoxParams box = box_of(2, 0.7);
    const std::vector<double> points = random_points(1, 200, box);
    PowerSpectrum spectrum(box, 20);
    spectrum.add(points, {});
    CHECK(spectrum.most(0) == 40);
    CHECK(spectrum.most(1) == 14);
    for (std::int64_t column = -40; column <= 40; ++column) {
        for (std::int64_t row = -14; row <= 14; ++row) {
            const double fx = static_cast<double>(column) / 2, fy = static_cast<double>(row) / 0.7;
            std::complex<double> sum = 0;
            for (std::size_t i = 0; i < points.size(); i += 2) {
                sum +=
                    std::polar(1.0, -2 * std::numbers::pi * (fx * points[i] + fy * points[i + 1]));
            }
            const bool is_out = std::hypot(fx, fy) > 20 || (column == 0 && row == 0);
            CHECK(power_at(spectrum, column, row) ==
                  doctest::Approx(is_out ? 0 : std::norm(sum) / 200).epsilon(1e-9).scale(1e-6));
        }
    }
}

TEST_CASE("independent points are white, and no direction is another than the others") {
    const BoxParams box = box_of(1, 1);
    PowerSpectrum spectrum(box, 60);
    const int sets = 10;
    for (int seed = 0; seed < sets; ++seed) {
        spectrum.add(random_points(static_cast<std::uint64_t>(seed), 500, box), {});
    }
    CHECK(spectrum.sets() == 10);
    double anisotropy = 0, powers = 0, count = 0;
    const auto rings = spectrum.rings();
    CHECK(rings.size() >= 58);
    for (const auto& ring : rings) {
        powers += ring.mean * ring.count;
        count += ring.count;
        anisotropy += ring.anisotropy * ring.count;
    }
    CHECK(count == doctest::Approx(std::numbers::pi * 60 * 60 / 2).epsilon(0.02));
    CHECK(powers / count == doctest::Approx(1).epsilon(0.03));
    CHECK(anisotropy / count == doctest::Approx(1.0 / sets).epsilon(0.05));
}

TEST_CASE("a lattice has its power in few directions") {
    const BoxParams box = box_of(1, 1);
    std::vector<double> points;
    for (int x = 0; x < 16; ++x) {
        for (int y = 0; y < 16; ++y) {
            points.insert(points.end(), {x / 16.0, y / 16.0});
        }
    }
    PowerSpectrum spectrum(box, 40);
    spectrum.add(points, {});
    CHECK(power_at(spectrum, 16, 0) == doctest::Approx(256));
    CHECK(power_at(spectrum, 0, -16) == doctest::Approx(256));
    CHECK(power_at(spectrum, 16, 32) == doctest::Approx(256));
    CHECK(power_at(spectrum, 15, 0) < 1e-9);
    CHECK(power_at(spectrum, -7, 11) < 1e-9);
    for (const auto& ring : spectrum.rings()) {
        if (ring.frequency > 16 && ring.frequency < 17) {
            CHECK(ring.anisotropy > 10);
        }
    }
}

TEST_CASE("a set that is given up leaves the spectrum as it was") {
    const BoxParams box = box_of(1, 1);
    PowerSpectrum spectrum(box, 10);
    spectrum.add(random_points(1, 50, box), {});
    const double before = power_at(spectrum, 3, 4);
    struct Stop {};
    CHECK_THROWS_AS(spectrum.add(random_points(2, 50, box), [](double) { throw Stop(); }), Stop);
    CHECK(spectrum.sets() == 1);
    CHECK(power_at(spectrum, 3, 4) == before);
}

TEST_CASE("powers in three and four dimensions are those of plain sums") {
    for (const std::vector<double>& sides :
         {std::vector<double>{1, 0.5, 2}, std::vector<double>{0.7, 1, 0.6, 1.3}}) {
        BoxParams box;
        box.extents = sides;
        const std::size_t dimension = sides.size();
        std::mt19937_64 random(7);
        std::vector<double> points;
        for (std::size_t i = 0; i < 30 * dimension; ++i) {
            points.push_back(static_cast<double>(random() >> 11) * 0x1p-53 * sides[i % dimension]);
        }
        const double highest = 4.2;
        PowerSpectrum spectrum(box, highest);
        spectrum.add(points, {});
        std::vector<std::int64_t> most, waves;
        for (const double side : sides) {
            most.push_back(static_cast<std::int64_t>(highest * side));
            waves.push_back(-most.back());
        }
        double within = 0, total = 0;
        for (std::size_t axis = 0; axis < dimension;) {
            std::complex<double> sum = 0;
            double square = 0;
            for (std::size_t i = 0; i < points.size(); i += dimension) {
                double turns = 0;
                for (std::size_t k = 0; k < dimension; ++k) {
                    turns += static_cast<double>(waves[k]) * points[i + k] / sides[k];
                }
                sum += std::polar(1.0, -2 * std::numbers::pi * turns);
            }
            for (std::size_t k = 0; k < dimension; ++k) {
                square += std::pow(static_cast<double>(waves[k]) / sides[k], 2);
            }
            const bool is_out = square > highest * highest || square == 0;
            const double power = is_out ? 0 : std::norm(sum) / 30;
            CHECK(spectrum.power(waves) == doctest::Approx(power).epsilon(1e-9).scale(1e-6));
            within += is_out ? 0 : 1;
            total += power;
            for (axis = 0; axis < dimension && ++waves[axis] > most[axis]; ++axis) {
                waves[axis] = -most[axis];
            }
        }
        double count = 0, powers = 0;
        for (const auto& ring : spectrum.rings()) {
            count += ring.count;
            powers += ring.count * ring.mean;
        }
        // Each and its opposite, but for rings of a single one.
        CHECK(count <= within / 2);
        CHECK(count > within / 2 - 3);
        CHECK(powers == doctest::Approx(total / 2).epsilon(0.05));
    }
}
