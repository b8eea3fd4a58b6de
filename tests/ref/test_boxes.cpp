// Boxes of R^n: parameters, candidates and disks of the reference, by hand and by brute force.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "baselines/box.hpp"
#include "geodisk/box.hpp"
#include "kernels/grid.hpp"
#include "lib/rng.hpp"

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

/// Every disk lists just what lies in it by double coordinates; pairs nearer to the limit than
/// rounding may move them do not count.
template <class Real>
void check_disks(const BoxParams& box, std::uint32_t candidates) {
    constexpr double kRounding = 0x1p-21;
    const std::size_t n = box.extents.size();
    const ref::BoxPool<Real> pool(box, candidates);
    const ref::Box plain{box.extents, box.is_periodic};
    std::vector<double> points(n * candidates);
    const auto point = [&](std::uint32_t i) { return std::span(points).subspan(i * n, n); };
    for (std::uint32_t i = 0; i < candidates; ++i) {
        candidate_point(box, i, point(i));
    }
    ref::BoxDetector<Real> detector(pool);
    std::uint32_t wrong = 0;
    for (std::uint32_t i = 0; i < candidates; i += 7) {
        std::vector<bool> hit(candidates, false);
        detector.run(
            i, [](std::uint32_t) { return true; }, [&](std::uint32_t q) { hit[q] = true; });
        for (std::uint32_t q = 0; q < candidates; ++q) {
            const double distance =
                std::sqrt(plain.distance2(point(i), point(q))) / box.min_distance;
            const bool is_tie = std::abs(distance - 1 - kBoxGuard) < kRounding;
            wrong += !is_tie && q != i && hit[q] != (distance < 1 + kBoxGuard);
        }
    }
    CHECK(wrong == 0);
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
                check_disks<float>(unit_box(n, distance, is_periodic), 500);
                check_disks<double>(unit_box(n, distance, is_periodic), 500);
            }
        }
    }
    BoxParams flat = unit_box(3, 0.2, true);
    flat.extents = {1, 0.25, 7};
    check_disks<float>(flat, 2000);
    flat.is_periodic = false;
    flat.extents = {1, 1e-9, 7};
    check_disks<float>(flat, 2000);
}

TEST_CASE("boxes: the table of cells is one to one where it can be") {
    const ref::BoxCellTable<float> all(unit_box(2, 0.1), 2000);
    CHECK(all.axes[0].cells == 19);
    CHECK(all.axes[0].stride == 1);
    CHECK(all.axes[1].stride == 19);
    CHECK(all.heads == 512);
    const ref::BoxCellTable<float> shared(unit_box(6, 0.1), 2000);
    CHECK(shared.heads == 4096);
}

TEST_CASE("boxes: candidates are the words of the stream, coordinate by coordinate") {
    BoxParams box = unit_box(6, 0.5);
    box.extents[5] = 4;
    box.seed = 0x123456789abcdef0;
    double point[6];
    candidate_point(box, 77, point);
    const auto first = ref::philox(box.seed, 77);
    const auto second = ref::philox(box.seed, 77, 1);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(point[i] == first[i] * 0x1p-32);
    }
    CHECK(point[4] == second[0] * 0x1p-32);
    CHECK(point[5] == second[1] * 0x1p-30);
    CHECK(first != second);
}

TEST_CASE("boxes: count and distance belong together") {
    for (std::size_t n = 1; n <= 6; ++n) {
        for (const bool is_periodic : {false, true}) {
            for (const double count : {10.0, 1e3, 1e5}) {
                BoxParams box = unit_box(n, 0, is_periodic);
                box.extents[0] = 3;
                box.min_distance = distance_for_count(box, count);
                CHECK(expected_count(box) == doctest::Approx(count));
                CHECK(pool_size(box).value() == doctest::Approx(std::max(64.0, 20 * count)));
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
    check_refused(box, "pool ratio");
    check_refused(unit_box(1, 1e-8), "side 1 is 1e+08 times as long");
    check_refused(unit_box(2, 1e-300), "side 1 is 1e+300 times as long");
    check_refused(unit_box(4, 1e-4), "candidates, the most is");
    check_refused(unit_box(2, 1.01, true), "shortest side of the periodic box");
    BoxParams thin = unit_box(2, 0, true);
    thin.extents[1] = 1e-3;
    thin.min_distance = distance_for_count(thin, 100);
    check_refused(thin, "shortest side of the periodic box, 0.001");
    CHECK(pool_size(unit_box(2, 1.01, false)));
}

} // namespace geodisk::test
