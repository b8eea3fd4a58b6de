// The nearest points of a surface.
#include "geometry/nearest_face.hpp"

#include <cmath>
#include <random>

#include "shapes/builtin_shapes.hpp"

#include <doctest/doctest.h>

using namespace geodisk::tools;

namespace {

/// By looking at many points of every face.
double distance_by_force(const MeshFile& mesh, const std::array<double, 3>& point) {
    constexpr int kSteps = 24;
    double least = HUGE_VAL;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        for (int i = 0; i <= kSteps; ++i) {
            for (int k = 0; i + k <= kSteps; ++k) {
                double distance = 0;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const auto at = [&](std::size_t corner) {
                        return mesh.positions[3 * mesh.triangles[3 * t + corner] + axis];
                    };
                    const double on_face =
                        (i * at(0) + k * at(1) + (kSteps - i - k) * at(2)) / kSteps;
                    distance = std::hypot(distance, point[axis] - on_face);
                }
                least = std::min(least, distance);
            }
        }
    }
    return least;
}

} // namespace

TEST_CASE("the nearest point of a surface is found") {
    const MeshFile mesh = make_builtin("torus-knot", 12);
    const NearestFace faces(mesh);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> coordinate(-2, 2);
    for (int i = 0; i < 40; ++i) {
        const std::array<double, 3> point{coordinate(random), coordinate(random),
                                          coordinate(random)};
        const SurfacePoint found = faces.find(point);
        const double least = distance_by_force(mesh, point);
        CHECK(found.distance <= least + 1e-12);
        CHECK(found.distance >= least - 0.05);
        // The weights are those of that point.
        double distance = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double on_face = 0;
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::size_t v = mesh.triangles[std::size_t{3} * found.face + corner];
                on_face += found.weights[corner] * mesh.positions[3 * v + axis];
            }
            distance = std::hypot(distance, point[axis] - on_face);
        }
        CHECK(distance == doctest::Approx(found.distance));
    }
}

TEST_CASE("a point of the surface has itself, at any scale and on faces without area") {
    for (const double scale : {1e-200, 1.0, 1e200}) {
        MeshFile mesh;
        mesh.positions = {0, 0, 0, scale, 0, 0, 0, scale, 0, 2 * scale, 0, 0};
        mesh.triangles = {0, 1, 3, 0, 1, 2};
        const NearestFace faces(mesh);
        const SurfacePoint inside = faces.find(std::array{scale / 4, scale / 4, 0.0});
        CHECK(inside.face == 1);
        CHECK(inside.distance <= 1e-15 * scale);
        CHECK(inside.weights[1] == doctest::Approx(0.25));
        const SurfacePoint beside = faces.find(std::array{scale / 4, -scale, 0.0});
        CHECK(beside.distance == doctest::Approx(scale));
        CHECK(faces.diagonal() == doctest::Approx(std::sqrt(5.0) * scale));
    }
}
