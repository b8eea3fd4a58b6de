// Dart throwing in boxes of R^n, sequential and by phase groups: spacing over all pairs, and as
// many samples as the method promises.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include <doctest/doctest.h>

#include "baselines/box_darts.hpp"
#include "baselines/phase_groups.hpp"
#include "baselines/pool_darts.hpp"
#include "baselines/random.hpp"

using namespace geodisk;

namespace {

using Coordinates = std::vector<double>;

std::span<const double> point(const ref::Box& box, const Coordinates& points, std::size_t i) {
    return std::span(points).subspan(i * box.dimension(), box.dimension());
}

std::size_t count_of(const ref::Box& box, const Coordinates& points) {
    return points.size() / box.dimension();
}

/// The box's cube [0, 1)^n.
ref::Box unit_box(std::size_t dimension, bool is_periodic) {
    return {std::vector<double>(dimension, 1.0), is_periodic};
}

/// Not by Box::distance2: every image of b in the boxes around.
double image_distance(const ref::Box& box, std::span<const double> a, std::span<const double> b) {
    double sum = 0;
    for (std::size_t axis = 0; axis < a.size(); ++axis) {
        double nearest = std::abs(a[axis] - b[axis]);
        for (const double image : {-box.sides[axis], box.sides[axis]}) {
            nearest =
                box.is_periodic ? std::min(nearest, std::abs(a[axis] - b[axis] + image)) : nearest;
        }
        sum += nearest * nearest;
    }
    return std::sqrt(sum);
}

void check_samples(const ref::Box& box, const Coordinates& samples, double min_distance) {
    double closest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count_of(box, samples); ++i) {
        for (std::size_t axis = 0; axis < box.dimension(); ++axis) {
            const double x = point(box, samples, i)[axis];
            REQUIRE((x >= 0 && x < box.sides[axis]));
        }
        for (std::size_t j = 0; j < i; ++j) {
            closest = std::min(closest,
                               image_distance(box, point(box, samples, i), point(box, samples, j)));
        }
    }
    // Around the box the images are rounded differently.
    CHECK(closest >= min_distance * (1 - 1e-12));
}

/// Random points that no sample is closer to than min_distance.
std::uint32_t gaps(const ref::Box& box, const Coordinates& samples, double min_distance,
                   std::uint32_t tries) {
    std::uint32_t found = 0;
    const Coordinates points = ref::draw_points(box, tries, 99);
    for (std::size_t i = 0; i < tries; ++i) {
        bool is_free = true;
        for (std::size_t j = 0; is_free && j < count_of(box, samples); ++j) {
            is_free =
                image_distance(box, point(box, points, i), point(box, samples, j)) >= min_distance;
        }
        found += is_free ? 1u : 0u;
    }
    return found;
}

/// Packing density r * sqrt(2 sqrt(3) N / A) of samples in a rectangle.
double rho(const ref::Box& box, std::size_t count, double min_distance) {
    return 0.5 * min_distance *
           std::sqrt(2 * std::numbers::sqrt3 * static_cast<double>(count) / box.volume());
}

} // namespace

TEST_CASE("random stream: uniform, repeatable, and not that of the candidates") {
    ref::RandomStream random(7);
    ref::RandomStream again(7);
    double sum = 0;
    std::set<std::uint32_t> seen;
    for (int i = 0; i < 100000; ++i) {
        const double x = random.uniform();
        REQUIRE(x == again.uniform());
        REQUIRE((x >= 0 && x < 1));
        sum += x;
        const std::uint32_t n = random.below(5);
        REQUIRE(n == again.below(5));
        seen.insert(n);
    }
    // Five standard deviations.
    CHECK(std::abs(sum / 100000 - 0.5) < 5 / std::sqrt(12.0 * 100000));
    CHECK(seen == std::set<std::uint32_t>{0, 1, 2, 3, 4});
    CHECK(ref::RandomStream(7).word() != ref::philox(7, {0, 0, 0, 0})[0]);
}

TEST_CASE("box: cells around a point hold all within reach, each once") {
    for (const bool is_periodic : {false, true}) {
        for (const double distance : {0.07, 0.21, 0.34, 0.6}) {
            const ref::Box box{{1.0, 0.5, 0.8}, is_periodic};
            const Coordinates points = ref::draw_points(box, 400, 3);
            ref::BoxGrid grid(box, distance);
            for (std::size_t i = 0; i < 400; ++i) {
                grid.add(point(box, points, i));
            }
            for (std::size_t i = 0; i < 400; ++i) {
                std::multiset<std::uint32_t> near;
                grid.for_near(point(box, points, i), [&near](std::uint32_t j) {
                    near.insert(j);
                    return true;
                });
                std::multiset<std::uint32_t> expected;
                for (std::uint32_t j = 0; j < 400; ++j) {
                    if (image_distance(box, point(box, points, i), point(box, points, j)) <
                        distance) {
                        expected.insert(j);
                    }
                }
                REQUIRE(near == expected);
            }
        }
    }
}

TEST_CASE("box darts: a pool gives what brute force gives") {
    const ref::Box boxes[] = {
        unit_box(1, false), unit_box(2, true), {{2.0, 0.3, 0.7}, false}, unit_box(4, true)};
    for (const ref::Box& box : boxes) {
        const double distance = box.dimension() == 1 ? 0.01 : 0.15;
        const Coordinates pool = ref::draw_points(box, 3000, 11);
        const auto ranks = ref::throw_brute_force(3000, [&](std::uint32_t i, std::uint32_t j) {
            return image_distance(box, point(box, pool, i), point(box, pool, j)) < distance;
        });
        Coordinates expected;
        for (const std::uint32_t rank : ranks) {
            const auto p = point(box, pool, rank);
            expected.insert(expected.end(), p.begin(), p.end());
        }
        CHECK(ref::throw_in_order(box, distance, pool) == expected);
    }
}

TEST_CASE("box darts: around samples, in one to six dimensions") {
    const double distances[] = {0.01, 0.05, 0.15, 0.3, 0.45, 0.6};
    for (std::size_t n = 1; n <= 6; ++n) {
        for (const bool is_periodic : {false, true}) {
            INFO(n << " dimensions, " << (is_periodic ? "periodic" : "open"));
            const ref::Box box = unit_box(n, is_periodic);
            const double distance = distances[n - 1];
            const Coordinates samples = ref::throw_around_samples(box, distance, 30, 5);
            check_samples(box, samples, distance);
            // Not maximal, the less so the more dimensions 30 trials have to search.
            CHECK(gaps(box, samples, distance, 2000) < 300);
            CHECK(samples == ref::throw_around_samples(box, distance, 30, 5));
            CHECK(samples != ref::throw_around_samples(box, distance, 30, 6));
        }
    }
}

TEST_CASE("box darts: maximal sampling leaves no gap") {
    const double distances[] = {0.01, 0.05, 0.15, 0.4};
    for (std::size_t n = 1; n <= 4; ++n) {
        for (const bool is_periodic : {false, true}) {
            INFO(n << " dimensions, " << (is_periodic ? "periodic" : "open"));
            const ref::Box box = unit_box(n, is_periodic);
            const double distance = distances[n - 1];
            const Coordinates samples = ref::throw_until_maximal(box, distance, 5);
            check_samples(box, samples, distance);
            CHECK(gaps(box, samples, distance, 20000) == 0);
            CHECK(samples == ref::throw_until_maximal(box, distance, 5));
        }
    }
}

TEST_CASE("box darts: a maximal periodic sample is as dense as random sequential adsorption jams") {
    // Disks that arrive at random cover 0.5470735 of the plane when no other fits (Torquato,
    // Uche and Stillinger 2006).
    const double jammed = std::sqrt(2 * std::numbers::sqrt3 * 0.5470735 / std::numbers::pi);
    const ref::Box box = unit_box(2, true);
    const Coordinates samples = ref::throw_until_maximal(box, 0.01, 1);
    CHECK(rho(box, count_of(box, samples), 0.01) == doctest::Approx(jammed).epsilon(0.005));
}

TEST_CASE("phase groups in boxes: spacing and density") {
    for (const std::size_t n : {2u, 3u}) {
        const ref::Box box{n == 2 ? std::vector{1.0, 0.7} : std::vector{1.0, 0.6, 0.8}, false};
        const double distance = n == 2 ? 0.03 : 0.12;
        const Coordinates samples = ref::throw_in_phase_groups(box, distance, 10, 5);
        check_samples(box, samples, distance);
        CHECK(samples == ref::throw_in_phase_groups(box, distance, 10, 5));
        const Coordinates maximal = ref::throw_until_maximal(box, distance, 5);
        CHECK(samples.size() > maximal.size() * 8 / 10);
        // More trials leave fewer gaps.
        const std::uint32_t few = gaps(box, samples, distance, 5000);
        CHECK(gaps(box, ref::throw_in_phase_groups(box, distance, 300, 5), distance, 5000) < few);
    }
}
