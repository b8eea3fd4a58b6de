// The certificate that samples leave no gap.
#include <doctest/doctest.h>

#include "coverage.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {
namespace {

/// A square of side 1.
TestMesh square() {
    TestMesh mesh;
    mesh.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    mesh.triangles = {0, 1, 2, 0, 2, 3};
    return mesh;
}

/// Returns what disks around the corners 0 and 2, with this radius, leave of the square.
ref::Coverage covered_from_corners(double radius) {
    const PreparedMesh mesh = prepared(square());
    ref::Surface<double> surface(mesh, 1);
    ref::CoverageCheck check(surface, {}, 1);
    for (const ref::FacePoint<double> corner : {ref::FacePoint<double>{0, 0, 0}, {0, 0, 1}}) {
        check.add_avoided(corner, radius);
    }
    check.sort();
    check.test(0);
    check.test(1);
    return check.result();
}

} // namespace

TEST_SUITE("coverage") {
    TEST_CASE("two disks at opposite corners cover a square once they reach the others") {
        CHECK_FALSE(covered_from_corners(1.0001).uncovered.has_value());
        const ref::Coverage gap = covered_from_corners(0.99);
        REQUIRE(gap.uncovered.has_value());
        // The farthest points are the other corners.
        CHECK(gap.largest == doctest::Approx(1 / 0.99).epsilon(0.01));
        CHECK_FALSE(gap.is_beyond);
        CHECK(covered_from_corners(0.5).is_beyond);
    }

    TEST_CASE("without a disk a surface is uncovered") {
        const PreparedMesh mesh = prepared(square());
        const ref::Surface<double> surface(mesh, 1);
        ref::CoverageCheck check(surface, {}, 1);
        check.sort();
        check.test(0);
        CHECK(check.result().is_beyond);
        CHECK(check.result().uncovered.has_value());
    }
}

} // namespace geodisk::test
