// Power spectra against plain sums, and what chance and lattices must give.
#include <doctest/doctest.h>

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

} // namespace

TEST_CASE("powers are those of plain sums") {
    const BoxParams box = box_of(2, 0.7);
    const std::vector<double> points = random_points(1, 200, box);
    PowerSpectrum spectrum(box, 20);
    spectrum.add(points, {});
    CHECK(spectrum.columns() == 40);
    CHECK(spectrum.rows() == 14);
    for (int column = -40; column <= 40; ++column) {
        for (int row = -14; row <= 14; ++row) {
            const double fx = column / 2.0, fy = row / 0.7;
            std::complex<double> sum = 0;
            for (std::size_t i = 0; i < points.size(); i += 2) {
                sum +=
                    std::polar(1.0, -2 * std::numbers::pi * (fx * points[i] + fy * points[i + 1]));
            }
            const bool is_out = std::hypot(fx, fy) > 20 || (column == 0 && row == 0);
            CHECK(spectrum.power(column, row) ==
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
    CHECK(spectrum.power(16, 0) == doctest::Approx(256));
    CHECK(spectrum.power(0, -16) == doctest::Approx(256));
    CHECK(spectrum.power(16, 32) == doctest::Approx(256));
    CHECK(spectrum.power(15, 0) < 1e-9);
    CHECK(spectrum.power(-7, 11) < 1e-9);
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
    const double before = spectrum.power(3, 4);
    struct Stop {};
    CHECK_THROWS_AS(spectrum.add(random_points(2, 50, box), [](double) { throw Stop(); }), Stop);
    CHECK(spectrum.sets() == 1);
    CHECK(spectrum.power(3, 4) == before);
}
