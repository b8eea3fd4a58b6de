// Radii and candidates from a density: what is refused, how many samples come out where, and none
// where it is zero.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "lib/frame.hpp"
#include "mesh/candidate_share.hpp"
#include "ref/chi_square.hpp"
#include "support/radius_fields.hpp"
#include "throw_darts.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

struct DensityCase : FieldCase {
    DensityCase(TestMesh shape, const std::vector<double>& density)
        : FieldCase(std::move(shape), density_field, density) {}
    DensityCase(const TestMesh& shape, const std::function<double(double)>& of_x)
        : FieldCase(shape, density_field, density_along(shape, of_x)) {}

    double x_of(ref::FacePoint<double> point) const {
        const double weights[3] = {1 - point.weight1 - point.weight2, point.weight1, point.weight2};
        double x = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = surface.half_edges()[std::size_t{3} * point.face + k].origin;
            x += weights[k] * mesh.positions[std::size_t{v} * mesh.dimension];
        }
        return x;
    }
};

std::string density_refused(const PreparedMesh& surface, const std::vector<double>& density,
                            std::uint64_t element = kNoElement) {
    return refusal(RadiusField::from_density(surface, density), element);
}

/// Samples of several runs with their places from 0 to 1 along x, as a share of all.
struct Strips {
    std::vector<double> found;
    double samples = 0;

    Strips(const DensityCase& c, double count, std::size_t strips, std::uint64_t runs)
        : found(strips) {
        for (std::uint64_t seed = 1; seed <= runs; ++seed) {
            const SampleParams params = c.params(count, seed);
            const ref::Surface<float> surface(c.surface, params);
            const ref::Pool<float> pool = ref::draw_pool(surface, params);
            const auto tolerances = ref::frame_of(c.surface, params).tolerances();
            for (const std::uint32_t rank : ref::throw_darts(surface, pool, tolerances).ranks) {
                const auto p = pool.candidate(rank);
                const double x = c.x_of(
                    {p.face, static_cast<double>(p.weight1), static_cast<double>(p.weight2)});
                found[std::min(strips - 1, static_cast<std::size_t>(
                                               std::max(0.0, x) * static_cast<double>(strips)))] +=
                    1;
            }
        }
        for (double& n : found) {
            samples += n / static_cast<double>(runs);
            n /= static_cast<double>(runs);
        }
    }
};

TestMesh density_triangle() {
    TestMesh mesh;
    mesh.add_vertex({0, 0, 0});
    mesh.add_vertex({2, 0, 0});
    mesh.add_vertex({0.5, 1.5, 0});
    mesh.add_triangle(0, 1, 2);
    return mesh;
}

double quotient(double a, double b) {
    return std::min(1.0, a / b);
}

double share(double x) {
    return candidates_for_share(x, quotient);
}

} // namespace

TEST_SUITE("density") {
    TEST_CASE("refuses what is none, naming the vertex") {
        TestMesh mesh = builtin("icosphere", 1);
        mesh.add_vertex({9, 9, 9}); // Unused: may have any value.
        const PreparedMesh surface = prepared(mesh);
        const auto with = [&](std::size_t vertex, double value) {
            std::vector<double> density(mesh.vertex_count(), 1.0);
            density[vertex] = value;
            return density;
        };
        CHECK(density_refused(surface, {1, 2}) == "there are 2 densities for 43 vertices");
        CHECK(density_refused(surface, with(7, -0.5), 7) ==
              "the density of vertex 7 (from 0) is -0.5; it must be 0 or positive, and finite");
        CHECK(density_refused(surface, with(3, NAN), 3) ==
              "the density of vertex 3 (from 0) is nan; it must be 0 or positive, and finite");
        CHECK(density_refused(surface, with(0, HUGE_VAL), 0) ==
              "the density of vertex 0 (from 0) is inf; it must be 0 or positive, and finite");
        CHECK(density_refused(surface, std::vector<double>(43, 0.0)) ==
              "the density is 0 everywhere, so no samples fit");
        std::vector<double> unused(43, 0.0);
        unused[42] = 1;
        CHECK(density_refused(surface, unused) == "the density is 0 everywhere, so no samples fit");
        CHECK(RadiusField::from_density(surface, with(42, NAN)));
    }

    TEST_CASE("goes by ratios alone, and radii differ by 32 at most") {
        const TestMesh mesh = flat_grid(40, 2, 1, 0.1);
        const auto ramp = density_along(mesh, [](double x) { return std::pow(10, -9 * x); });
        const PreparedMesh surface = prepared(mesh);
        const RadiusField field = density_field(surface, ramp);
        for (const double unit : {0x1p-1000, 0x1p-20, 0x1p900}) {
            std::vector<double> scaled = ramp;
            for (double& value : scaled) {
                value *= unit;
            }
            const RadiusField same = density_field(surface, scaled);
            CHECK(std::ranges::equal(same.factors(), field.factors()));
            CHECK(std::ranges::equal(same.spreads(), field.spreads()));
            CHECK(same.effective_area() == field.effective_area());
        }
        CHECK(field.min_factor() == doctest::Approx(1.0 / 32));
        CHECK(*std::ranges::max_element(field.factors()) == 1);
        CHECK(field.factor_at(0, {1, 0, 0}) == doctest::Approx(field.factors()[0]));
        const RadiusField mask = density_field(
            surface, density_along(mesh, [](double x) { return x < 0.5 ? 0.0 : 255.0; }));
        CHECK(mask.min_factor() == 1);
    }

    TEST_CASE("the share of candidates is convex, and 0 and 1 at its ends") {
        CHECK(share(0) == 0);
        CHECK(share(1) == doctest::Approx(1));
        for (double x = 0.01; x < 0.99; x += 0.01) {
            CAPTURE(x);
            REQUIRE(share(x - 0.01) + share(x + 0.01) > 2 * share(x));
        }
    }

    TEST_CASE("candidates are as dense as the packing times the share") {
        for (const std::vector<double>& density : {std::vector{0.0, 0.0, 1.0},
                                                   {0.1, 0.5, 1.0},
                                                   {1.0, 20.0, 900.0},
                                                   {0.0, 3.0, 1000.0}}) {
            const DensityCase c(density_triangle(), density);
            SampleParams params = c.params(100, 5);
            params.darts = 200000;
            const ref::Surface<double> surface(c.surface, params);
            const auto points = ref::draw_pool(surface, params).by_rank();
            constexpr int kParts = 4, kFine = 100, kSteps = kParts * kFine;
            std::vector<double> drawn(kParts * kParts), wanted(kParts * kParts);
            for (const auto& p : points) {
                drawn[static_cast<std::size_t>(static_cast<int>(p.weight1 * kParts) * kParts +
                                               static_cast<int>(p.weight2 * kParts))] += 1;
            }
            double total = 0;
            for (int i = 0; i < kSteps; ++i) {
                for (int k = 0; i + k < kSteps; ++k) {
                    const bool half = i + k + 1 == kSteps;
                    const double inset = half ? 1.0 / 3 : 0.5;
                    const double w1 = (i + inset) / kSteps, w2 = (k + inset) / kSteps;
                    const auto at = [&](std::span<const float> corners) {
                        return (1 - w1 - w2) * double{corners[0]} + w1 * double{corners[1]} +
                               w2 * double{corners[2]};
                    };
                    const double packing = at(c.field.packing());
                    const double x = std::min(1.0, at(c.field.spreads()) / packing);
                    const double mass = (half ? 0.5 : 1.0) * packing * (x < 1 ? share(x) : 1.0);
                    wanted[static_cast<std::size_t>(i / kFine * kParts + k / kFine)] += mass;
                    total += mass;
                }
            }
            CHECK(2 * total / kSteps / kSteps ==
                  doctest::Approx(double{c.field.densities()[0]}).epsilon(0.004));
            double chi_square = 0, freedom = -1;
            for (std::size_t i = 0; i < drawn.size(); ++i) {
                const double want = wanted[i] / total * static_cast<double>(points.size());
                if (want > 20) {
                    chi_square += (drawn[i] - want) * (drawn[i] - want) / want;
                    freedom += 1;
                }
            }
            CAPTURE(chi_square);
            CHECK(is_plausible(chi_square, freedom));
        }
    }

    // A square far from the others has the largest density, so that on them the radius is the
    // largest, and the density a share of what fits.
    TEST_CASE("thinned candidates give the share of samples") {
        for (const double x : {0.03, 0.1, 0.3, 0.6, 0.8, 0.9, 0.97}) {
            CAPTURE(x);
            TestMesh mesh = builtin("icosphere", 4);
            const std::uint32_t corner = mesh.add_vertex({9, 0, 0});
            mesh.add_vertex({9.01, 0, 0});
            mesh.add_vertex({9, 0.01, 0});
            mesh.add_triangle(corner, corner + 1, corner + 2);
            std::vector<double> density(mesh.vertex_count(), x / 1024);
            std::fill(density.begin() + corner, density.end(), 1.0);
            const DensityCase c(mesh, density);
            const double area = 12.5514;
            SampleParams params = c.params(3000, 1);
            params.min_distance = distance_for_count(area, 1200 / std::sqrt(x));
            const ref::Surface<float> surface(c.surface, params);
            const ref::Pool<float> pool = ref::draw_pool(surface, params);
            double found = 0;
            for (const std::uint32_t rank :
                 ref::throw_darts(surface, pool, ref::frame_of(c.surface, params).tolerances())
                     .ranks) {
                found += pool.candidate(rank).face < c.surface.face_count() - 1 ? 1 : 0;
            }
            CHECK(found / (1200 * std::sqrt(x)) == doctest::Approx(1).epsilon(0.06));
        }
    }

    TEST_CASE("a mask has samples where it is 1 alone") {
        const DensityCase c(flat_grid(8, 8, 1, 1), [](double x) { return x < 0.5 ? 0.0 : 1.0; });
        const Strips strips(c, 400, 8, 4);
        CHECK(strips.samples == doctest::Approx(400).epsilon(0.06));
        CHECK(strips.found[0] + strips.found[1] + strips.found[2] == 0);
        for (std::size_t i = 4; i < 8; ++i) {
            CHECK(strips.found[i] == doctest::Approx(400 / 4.5).epsilon(0.1));
        }
        CHECK(strips.found[3] == doctest::Approx(400 / 9.0).epsilon(0.2));
    }

    TEST_CASE("a ramp has samples in proportion, on fine and on coarse meshes") {
        for (const std::uint32_t columns : {1u, 3u, 10u, 60u}) {
            CAPTURE(columns);
            const DensityCase c(flat_grid(columns, columns, 1, 1), [](double x) { return x; });
            const Strips strips(c, 2000, 5, 4);
            CHECK(strips.samples == doctest::Approx(2000).epsilon(0.07));
            for (std::size_t i = 0; i < 5; ++i) {
                CAPTURE(i);
                const double want = (2.0 * static_cast<double>(i) + 1) / 25;
                CHECK(strips.found[i] / strips.samples / want ==
                      doctest::Approx(1).epsilon(i == 0 ? 0.12 : 0.05));
            }
        }
    }

    TEST_CASE("strips of 1, 10 and 100 have samples in proportion") {
        const DensityCase c(flat_grid(60, 20, 1, 0.333), [](double x) {
            return x < 0.3334 ? 1.0 : x < 0.6668 ? 10.0 : 100.0;
        });
        const Strips strips(c, 3000, 3, 4);
        const double total = 111;
        CHECK(strips.found[2] / strips.samples * total / 100 == doctest::Approx(1).epsilon(0.05));
        CHECK(strips.found[1] / strips.samples * total / 10 == doctest::Approx(1).epsilon(0.12));
        CHECK(strips.found[0] / strips.samples * total == doctest::Approx(1).epsilon(0.25));
    }

    TEST_CASE("a range of 1e9 has samples in proportion") {
        const DensityCase c(flat_grid(90, 10, 1, 0.111),
                            [](double x) { return std::pow(10, -9 * (1 - x)); });
        const Strips strips(c, 4000, 45, 3); // A fifth of a decade each.
        double ratio = 1 / std::pow(10, 0.2);
        double want = strips.samples * (1 - ratio);
        for (std::size_t i = 44; want > 60; --i, want *= ratio) {
            CAPTURE(i);
            CHECK(strips.found[i] / want == doctest::Approx(1).epsilon(0.1));
        }
    }
}
