// Boxes of R^n: parameters, candidates and disks of the reference, by hand and by brute force.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "baselines/box.hpp"
#include "baselines/pool_darts.hpp"
#include "geodisk/box.hpp"
#include "kernels/grid.hpp"
#include "kernels/poisson.hpp"
#include "lib/rng.hpp"
#include "ref/chi_square.hpp"

namespace geodisk::test {
namespace {

BoxParams unit_box(std::size_t dimension, double min_distance, bool is_periodic = false) {
    BoxParams box;
    box.extents.assign(dimension, 1.0);
    box.min_distance = min_distance;
    box.is_periodic = is_periodic;
    return box;
}

void check_refused(const BoxParams& box, const std::string& part) {
    const auto size = pool_size(box);
    REQUIRE(!size);
    CHECK(size.error().status == Status::invalid_argument);
    CHECK_MESSAGE(size.error().message.find(part) != std::string::npos, size.error().message);
}

/// A job with about so many candidates.
BoxParams with_candidates(BoxParams box, double candidates) {
    box.pool_ratio = candidates / expected_count(box);
    return box;
}

std::vector<double> coordinates_of(const BoxParams& box, const std::vector<ref::BoxPoint>& points) {
    const ref::BoxLattice lattice(box);
    std::vector<double> coordinates;
    for (const ref::BoxPoint& point : points) {
        for (std::size_t axis = 0; axis < box.extents.size(); ++axis) {
            coordinates.push_back(lattice.coordinate(axis, point));
        }
    }
    return coordinates;
}

/// Every disk lists just what lies in it by double coordinates; pairs nearer to the limit than
/// rounding may move them do not count.
template <class Real>
void check_disks(const BoxParams& box) {
    constexpr double kRounding = 0x1p-21;
    const std::size_t n = box.extents.size();
    const ref::BoxPool<Real> pool(box);
    REQUIRE(pool.size() > 30);
    REQUIRE(pool.size() < 20000);
    const ref::Box plain{box.extents, box.is_periodic};
    const std::vector<double> points = coordinates_of(box, pool.points);
    const auto point = [&](std::uint32_t i) { return std::span(points).subspan(i * n, n); };
    ref::BoxDetector<Real> detector(pool);
    std::uint32_t wrong = 0;
    for (std::uint32_t i = 0; i < pool.size(); i += 7) {
        std::vector<bool> hit(pool.size(), false);
        detector.run(
            i, [](std::uint32_t) { return true; }, [&](std::uint32_t q) { hit[q] = true; });
        for (std::uint32_t q = 0; q < pool.size(); ++q) {
            const double distance =
                std::sqrt(plain.distance2(point(i), point(q))) / box.min_distance;
            const bool is_tie = std::abs(distance - 1 - kBoxGuard) < kRounding;
            wrong += !is_tie && q != i && hit[q] != (distance < 1 + kBoxGuard);
        }
    }
    CHECK(wrong == 0);
}

/// Sequential dart throwing over the pool by brute force.
void check_set(const BoxParams& box) {
    const std::size_t n = box.extents.size();
    const ref::BoxPool<double> pool(box);
    const std::vector<double> points = coordinates_of(box, ref::draw_in_box(box).points);
    const auto point = [&](std::uint32_t i) { return std::span(points).subspan(i * n, n); };
    const ref::Box plain{box.extents, box.is_periodic};
    const double limit = box.min_distance * (1 + kBoxGuard);
    const auto brute = ref::throw_brute_force(pool.size(), [&](std::uint32_t a, std::uint32_t b) {
        return plain.distance2(point(a), point(b)) < limit * limit;
    });
    CHECK(ref::throw_darts(pool) == brute);
    CHECK(static_cast<double>(brute.size()) > 0.7 * expected_count(box));
    CHECK(static_cast<double>(brute.size()) < 1.3 * expected_count(box) + 10);
}

} // namespace

TEST_CASE("boxes: disks hold what brute force finds") {
    for (std::size_t n = 1; n <= 6; ++n) {
        for (const bool is_periodic : {false, true}) {
            // Cells around the box: one, two, four, five, and many.
            for (const double distance : {1.0, 0.7, 0.48, 0.39, 0.1}) {
                CAPTURE(n);
                CAPTURE(is_periodic);
                CAPTURE(distance);
                const BoxParams box = with_candidates(unit_box(n, distance, is_periodic), 500);
                check_disks<float>(box);
                check_disks<double>(box);
            }
        }
    }
    BoxParams flat = unit_box(3, 0.2, true);
    flat.extents = {1, 0.25, 7};
    check_disks<float>(with_candidates(flat, 2000));
    flat.is_periodic = false;
    flat.extents = {1, 1e-9, 7};
    check_disks<float>(with_candidates(flat, 2000));
}

TEST_CASE("boxes: sets are those of brute force") {
    for (std::size_t n = 1; n <= 4; ++n) {
        for (const bool is_periodic : {false, true}) {
            CAPTURE(n);
            CAPTURE(is_periodic);
            BoxParams box = unit_box(n, 0, is_periodic);
            box.min_distance = distance_for_count(box, 100);
            box.seed = n;
            check_set(box);
        }
    }
}

TEST_CASE("boxes: the table of cells is one to one where it can be") {
    const ref::BoxCellTable<float> all(ref::BoxLattice(unit_box(2, 0.1)), 2000, kBoxGuard);
    CHECK(all.axes[0].cells == 19);
    CHECK(all.axes[0].stride == 1);
    CHECK(all.axes[1].stride == 19);
    CHECK(all.heads == 512);
    const ref::BoxCellTable<float> shared(ref::BoxLattice(unit_box(6, 0.1)), 2000, kBoxGuard);
    CHECK(shared.heads == 4096);
}

TEST_CASE("boxes: lattices") {
    const auto axis = [](double side, double min_distance, bool is_periodic) {
        BoxParams box = unit_box(2, min_distance, is_periodic);
        box.extents = {side, side};
        return ref::BoxLattice(box).axes[0];
    };
    const ref::LatticeAxis around = axis(3.5, 1, true);
    CHECK(around.step == 3.5 * 0x1p-32);
    CHECK(around.length == std::uint64_t{1} << 32);
    CHECK(around.cells == 3);
    CHECK(around.width == 1431655765);
    CHECK(around.last_width == 1431655766);
    CHECK(axis(1.5, 1, true).width == 0); // All of it.
    CHECK(axis(1.5, 1, true).last_width == 0);
    const ref::LatticeAxis open = axis(7.25, 2, false);
    CHECK(open.step == 0x1p-15);
    CHECK(open.length == 237568); // 3.625 distances of 2^16 steps.
    CHECK(open.cells == 4);
    CHECK(open.width == 65536);
    CHECK(open.last_width == 40960);
    const ref::LatticeAxis whole = axis(3, 1, false);
    CHECK(whole.cells == 3);
    CHECK(whole.last_width == whole.width);
    const ref::LatticeAxis small = axis(0.75, 1, false);
    CHECK(small.step == 0x1p-31);
    CHECK(small.cells == 1);
    CHECK(small.last_width == 3u << 29);
    CHECK(axis(65535.5, 1, false).step == 0x1p-16);
    CHECK(axis(65536, 1, false).length == std::uint64_t{1} << 32);
    CHECK(axis(65537, 1, false).step == 0x1p-15);
    CHECK(axis(0x1p24, 1, false).step == 0x1p-8);
    CHECK(axis(0x1p24, 1, false).length == std::uint64_t{1} << 32);
    BoxParams thin = unit_box(2, 1);
    thin.extents[1] = 1e-30;
    CHECK(ref::BoxLattice(thin).axes[1].length == 1);
    // Distances beyond those in the box are measured by them.
    CHECK(ref::BoxLattice(unit_box(2, 1e9)).unit == doctest::Approx(1.01 * std::sqrt(2.0)));
}

TEST_CASE("boxes: a candidate by hand") {
    BoxParams box = unit_box(6, 0.5, true);
    box.extents[5] = 2;
    box.seed = 0x123456789abcdef0;
    // Two cells along each axis but four along the last; the pool's first stage has the lowest
    // words.
    const ref::BoxCandidates drawn = ref::draw_in_box(box);
    const std::array<std::uint32_t, 6> cell{1, 0, 1, 1, 0, 3};
    const auto seed_of = [](const std::array<std::uint32_t, 4>& w) {
        return w[0] | std::uint64_t{w[1]} << 32;
    };
    const std::uint64_t first = seed_of(ref::philox(box.seed, {cell[0], cell[1], cell[2], 0xB0C5}));
    const std::uint64_t seed = seed_of(ref::philox(first, {cell[3], cell[4], cell[5], 0xB0C5}));
    const float mean = ref::stage_intensity(box, 0);
    const auto words = ref::philox(seed, {0xffffffff, 2, 0, 0});
    const std::uint32_t count = ref::poisson(mean, words[0], words[1]);
    const auto in_cell = [&](std::size_t i) {
        for (std::size_t axis = 0; axis < 6; ++axis) {
            if (drawn.points[i][axis] >> (axis == 5 ? 30 : 31) != cell[axis]) {
                return false;
            }
        }
        return drawn.words[i] >> 28 == 2;
    };
    std::map<std::uint32_t, ref::BoxPoint> found;
    for (std::size_t i = 0; i < drawn.points.size(); ++i) {
        if (in_cell(i)) {
            found[drawn.words[i] & 0xfffffff] = drawn.points[i];
        }
    }
    REQUIRE(count > 0);
    CHECK(found.size() == count);
    for (std::uint32_t k = 0; k < count; ++k) {
        const auto a = ref::philox(seed, {k, 2, 0, 0});
        const auto b = ref::philox(seed, {k, 2, 1, 0});
        const std::array<std::uint32_t, 6> inside{a[1], a[2], a[3], b[0], b[1], b[2]};
        REQUIRE(found.count(a[0] >> 4) == 1);
        for (std::size_t axis = 0; axis < 6; ++axis) {
            const std::uint32_t bits = axis == 5 ? 30 : 31;
            CHECK(found[a[0] >> 4][axis] == (cell[axis] << bits | inside[axis] >> (32 - bits)));
        }
    }
}

TEST_CASE("boxes: candidates are uniform, as many as asked for, and in dart order") {
    for (const bool is_periodic : {false, true}) {
        BoxParams box = unit_box(2, 0.2734, is_periodic);
        box.extents = {1.9, 0.6};
        box = with_candidates(box, 200000);
        const ref::BoxLattice lattice(box);
        const ref::BoxCandidates drawn = ref::draw_in_box(box);
        const double area = box.extents[0] * box.extents[1];
        const double expected = static_cast<double>(ref::stage_intensity(box, 0)) *
                                ref::stages_in(box).pool_stages() * area / lattice.unit /
                                lattice.unit;
        const auto total = static_cast<double>(drawn.points.size());
        CHECK(std::abs(total - expected) < 5 * std::sqrt(expected));
        CHECK(std::is_sorted(drawn.words.begin(), drawn.words.end()));
        constexpr std::size_t kColumns = 38, kRows = 12;
        std::vector<double> counts(kColumns * kRows, 0);
        for (const ref::BoxPoint& point : drawn.points) {
            const auto column = static_cast<std::size_t>(lattice.coordinate(0, point) / 0.05);
            const auto row = static_cast<std::size_t>(lattice.coordinate(1, point) / 0.05);
            counts.at(row * kColumns + column) += 1;
        }
        check_chi_square(counts, std::vector(counts.size(), total / (kColumns * kRows)),
                         static_cast<double>(counts.size()) - 1);
    }
}

TEST_CASE("boxes: an open box has the candidates of a part of it") {
    // Cells are a distance wide, and the last one of an axis what is left.
    BoxParams part = unit_box(3, 0.125);
    part.extents = {0.75, 0.625, 0.875};
    BoxParams whole = part;
    whole.extents = {1, 1.125, 1.7};
    REQUIRE(ref::stage_intensity(part, 0) == ref::stage_intensity(whole, 0));
    const ref::BoxCandidates inner = ref::draw_in_box(part);
    const ref::BoxCandidates outer = ref::draw_in_box(whole);
    const ref::BoxLattice lattice(part);
    std::vector<std::pair<std::uint32_t, ref::BoxPoint>> expected, found;
    for (std::size_t i = 0; i < inner.points.size(); ++i) {
        expected.emplace_back(inner.words[i], inner.points[i]);
    }
    for (std::size_t i = 0; i < outer.points.size(); ++i) {
        bool is_inside = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            is_inside = is_inside && outer.points[i][axis] < lattice.axes[axis].length;
        }
        if (is_inside) {
            found.emplace_back(outer.words[i], outer.points[i]);
        }
    }
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    CHECK(found == expected);
}

TEST_CASE("boxes: count and distance belong together") {
    for (std::size_t n = 1; n <= 6; ++n) {
        for (const bool is_periodic : {false, true}) {
            for (const double count : {10.0, 1e3, 1e5}) {
                BoxParams box = unit_box(n, 0, is_periodic);
                box.extents[0] = 3;
                box.min_distance = distance_for_count(box, count);
                CHECK(expected_count(box) == doctest::Approx(count));
                // The shortest to the last bit, so that all mathematical libraries agree on it.
                BoxParams shorter = box;
                shorter.min_distance = std::nextafter(box.min_distance, 0.0);
                CHECK(expected_count(box) <= count);
                CHECK(expected_count(shorter) > count);
                // With borders as near as a power of two comes.
                const double off = is_periodic ? 1 : std::sqrt(2.0);
                const double pool = pool_size(box).value();
                CHECK(pool < 1 + 1.001 * off * std::max(64.0, 20 * count));
                CHECK(pool > 0.999 / off * std::max(64.0, 20 * count) - 1);
            }
        }
    }
    CHECK(pool_size([] {
        BoxParams one = unit_box(2, 0, true);
        one.min_distance = distance_for_count(one, 1);
        return one;
    }()));
    CHECK(expected_count(unit_box(2, 1e9)) == 1);
    CHECK(pool_size(unit_box(2, 1e300)).value() == 64);
}

TEST_CASE("boxes: what cannot be sampled is named") {
    check_refused(unit_box(2, -1.5), "positive finite number, not -1.5");
    check_refused(unit_box(0, 0.1), "1 to 6 sides, not 0");
    check_refused(unit_box(7, 0.1), "1 to 6 sides, not 7");
    for (const double distance : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
        check_refused(unit_box(2, distance), "minimum distance must be a positive finite number");
    }
    for (const double side : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
        BoxParams box = unit_box(3, 0.1);
        box.extents[1] = side;
        check_refused(box, "side 2 of the box must be a positive finite number");
    }
    BoxParams box = unit_box(2, 0.1);
    box.pool_ratio = 0.5;
    check_refused(box, "the pool ratio must be 1 to 10,000, not 0.5");
    check_refused(unit_box(1, 1e-8), "side 1 is 1e+08 times as long");
    check_refused(unit_box(2, 1e-300), "side 1 is 1e+300 times as long");
    check_refused(unit_box(4, 1e-4), "candidates, the maximum is");
    check_refused(unit_box(2, 1.01, true), "shortest side of the periodic box");
    BoxParams thin = unit_box(2, 0, true);
    thin.extents[1] = 1e-3;
    thin.min_distance = distance_for_count(thin, 100);
    check_refused(thin, "shortest side of the periodic box, 0.001");
    CHECK(pool_size(unit_box(2, 1.01, false)));
}

} // namespace geodisk::test
