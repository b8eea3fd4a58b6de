// Radii of disks that hold an area: in planes, on spheres, and where the mesh ends.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "geodisk/geodesics.hpp"
#include "geodisk/neighbours.hpp"
#include "support/meshes.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

double radius_of(const PreparedMesh& mesh, const Sample& source, double area) {
    const auto radii = disk_radii(mesh, std::span(&source, 1), area);
    REQUIRE_MESSAGE(radii, radii.error().message);
    return radii->front();
}

std::string refusal(const PreparedMesh& mesh, const Sample& source, double area) {
    const auto radii = disk_radii(mesh, std::span(&source, 1), area);
    REQUIRE(!radii);
    return radii.error().message;
}

/// A square with sides of 2, of two triangles or of many.
TestMesh square(std::uint32_t side) {
    TestMesh mesh;
    for (std::uint32_t y = 0; y <= side; ++y) {
        for (std::uint32_t x = 0; x <= side; ++x) {
            mesh.add_vertex({2.0 * x / side - 1, 2.0 * y / side - 1, 0});
        }
    }
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const std::uint32_t v = x + (side + 1) * y;
            mesh.add_triangle(v, v + 1, v + side + 2);
            mesh.add_triangle(v, v + side + 2, v + side + 1);
        }
    }
    return mesh;
}

} // namespace

TEST_CASE("disks in a plane are circles, however coarse the mesh is") {
    for (const std::uint32_t side : {1u, 2u, 7u, 64u}) {
        CAPTURE(side);
        const PreparedMesh mesh = prepared(square(side));
        const Point middle = point_at(square(side), 0.01, -0.02);
        const Sample source{middle.face,
                            {static_cast<float>(1 - middle.weight1 - middle.weight2),
                             static_cast<float>(middle.weight1),
                             static_cast<float>(middle.weight2)}};
        for (const double area : {0.05, 0.5, 2.0}) {
            CHECK(radius_of(mesh, source, area) ==
                  doctest::Approx(std::sqrt(area / std::numbers::pi)).epsilon(0.004));
        }
        // The whole: as far as the farthest corner. What is larger is the same.
        const double corner = std::hypot(1.01, 1.02);
        CHECK(radius_of(mesh, source, 4) == doctest::Approx(corner).epsilon(0.004));
        CHECK(radius_of(mesh, source, 1e6) == doctest::Approx(corner).epsilon(0.002));
    }
}

TEST_CASE("disks on a sphere are caps") {
    const TestMesh ball = builtin("icosphere", 5);
    const PreparedMesh mesh = prepared(ball);
    const double whole = mesh.statistics().area;
    for (const double share : {0.01, 0.25, 0.5, 0.9}) {
        const double expected =
            std::acos(1 - 2 * share) * std::sqrt(whole / (4 * std::numbers::pi));
        CHECK(radius_of(mesh, {0, {1, 0, 0}}, share * whole) ==
              doctest::Approx(expected).epsilon(0.005));
        CHECK(radius_of(mesh, {100, {0.25f, 0.25f, 0.5f}}, share * whole) ==
              doctest::Approx(expected).epsilon(0.005));
    }
}

TEST_CASE("disks of several sources do not depend on threads, and what cannot be is refused") {
    const PreparedMesh mesh = prepared(builtin("torus-knot", 24));
    const auto points = vertex_points(mesh);
    REQUIRE(points);
    const auto sources = std::span(points->points).first(20);
    const double area = mesh.statistics().area / 50;
    const auto one = disk_radii(mesh, sources, area, {.max_threads = 1});
    const auto many = disk_radii(mesh, sources, area, {.max_threads = 5});
    REQUIRE((one && many));
    CHECK(*one == *many);
    const Sample source{0, {1, 0, 0}};
    CHECK(refusal(mesh, source, 0) == "the area of disks is 0, not positive and finite");
    CHECK(refusal(mesh, source, std::nan("")).starts_with("the area of disks is nan"));
    CHECK(refusal(mesh, {mesh.face_count(), {1, 0, 0}}, 1).starts_with("source 0 "));
    const auto stopped = disk_radii(mesh, sources, area, {}, [](const Progress&) { return false; });
    REQUIRE(!stopped);
    CHECK(stopped.error().status == Status::cancelled);
}
