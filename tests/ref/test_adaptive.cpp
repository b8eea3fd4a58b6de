// Radii that vary over the surface: the field, the density of candidates, how far disks reach, and
// the sets that come out.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "lib/frame.hpp"
#include "ref/chi_square.hpp"
#include "support/geodesic_query.hpp"
#include "support/oracle_geodesic.hpp"
#include "support/radius_fields.hpp"
#include "support/replay.hpp"
#include "throw_darts.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

struct Case : FieldCase {
    Case(TestMesh shape, const std::vector<double>& factors)
        : FieldCase(std::move(shape), radius_field, factors) {}
};

std::string refused(const PreparedMesh& surface, const std::vector<double>& factors,
                    std::uint64_t element = kNoElement) {
    return refusal(RadiusField::prepare(surface, factors), element);
}

/// The mean of 1 / g^2 over a triangle: -2 times the second divided difference of the logarithm.
double exact_mean(double a, double b, double c) {
    const auto slope = [](double x, double y) { return (std::log(y) - std::log(x)) / (y - x); };
    return -2 * (slope(b, c) - slope(a, b)) / (c - a);
}

TestMesh one_triangle() {
    TestMesh mesh;
    mesh.add_vertex({0, 0, 0});
    mesh.add_vertex({2, 0, 0});
    mesh.add_vertex({0.5, 1.5, 0});
    mesh.add_triangle(0, 1, 2);
    return mesh;
}

/// Candidates are as dense as 1 / g^2: counts in the parts of every face, cut in `parts` strips
/// along each side, against the integral there.
void check_density(const Case& c, std::uint32_t count, int parts) {
    SampleParams params = c.params(100, 5);
    params.darts = count;
    const ref::Surface<double> surface(c.surface, params);
    const auto points = ref::draw_pool(surface, params).by_rank();
    const auto cells = static_cast<std::size_t>(parts) * static_cast<std::size_t>(parts);
    std::vector<double> drawn(c.surface.face_count() * cells, 0.0);
    std::vector<double> expected(drawn.size(), 0.0);
    for (const auto& p : points) {
        const auto part = [&](double w) { return static_cast<std::size_t>(w * parts); };
        drawn[p.face * cells + part(p.weight1) * static_cast<std::size_t>(parts) +
              part(p.weight2)] += 1;
    }
    constexpr int kFine = 160; // Midpoints per side of a part.
    double total = 0;
    for (std::uint32_t f = 0; f < c.surface.face_count(); ++f) {
        const HalfEdge& edge = c.surface.half_edges()[std::size_t{3} * f];
        const double area = 0.5 * edge.length * edge.apex_y;
        const int steps = kFine * parts;
        for (int i = 0; i < steps; ++i) {
            for (int k = 0; i + k < steps; ++k) {
                // The square of this step, or where the triangle cuts it the half of it.
                const bool half = i + k + 1 == steps;
                const double inset = half ? 1.0 / 3 : 0.5;
                const double w1 = (i + inset) / steps, w2 = (k + inset) / steps;
                const double g = 2 * surface.radius_at({f, w1, w2});
                const double mass = area * (half ? 0.5 : 1.0) / (g * g);
                expected[f * cells + static_cast<std::size_t>(i / kFine * parts + k / kFine)] +=
                    mass;
                total += mass;
            }
        }
    }
    CHECK(2 * total / (kFine * parts) / (kFine * parts) ==
          doctest::Approx(c.field.effective_area()).epsilon(1e-3));
    double chi_square = 0, freedom = -1;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const double want = expected[i] / total * count;
        if (want == 0) {
            CHECK(drawn[i] == 0);
            continue;
        }
        REQUIRE(want > 20);
        chi_square += (drawn[i] - want) * (drawn[i] - want) / want;
        freedom += 1;
    }
    CAPTURE(chi_square);
    CAPTURE(freedom);
    CHECK(is_plausible(chi_square, freedom));
}

/// No path through a face leads on to a point whose radius is larger than the rest and the bound.
void check_bounds(const std::string& name, const Case& c, double count) {
    INFO(name << " at " << count);
    const SampleParams params = c.params(count);
    const auto bounds = c.field.reach_bounds(c.surface, params.min_distance);
    REQUIRE(bounds);
    const ref::Surface<double> surface(c.surface, params);
    // Points everywhere, and those where radii are largest.
    std::vector<Point> points = random_points(c.surface, 3, 300);
    for (std::uint32_t v = 0; v < c.mesh.vertex_count(); ++v) {
        points.push_back(points_at_vertex(c.mesh, v).front());
    }
    GeodesicQuery<double> query(c.surface, 0.51 * params.min_distance, points, tight_tolerances());
    double min_slack = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 300; ++i) {
        const std::vector<double> distances = query.from(points[i]);
        for (std::size_t q = 0; q < points.size(); ++q) {
            const double beyond = surface.radius_at(points[q]) - distances[q] / params.min_distance;
            const double bound = static_cast<double>((*bounds)[points[i].face]);
            min_slack = std::min(min_slack, bound - beyond);
        }
    }
    CHECK(min_slack >= 0);
    for (std::uint32_t f = 0; f < c.surface.face_count(); ++f) {
        REQUIRE(static_cast<double>((*bounds)[f]) <= 0.5 + 0x1p-14);
    }
}

template <class Real>
ref::RunResult throw_on(const ref::Surface<Real>& surface, const Case& c,
                        const SampleParams& params) {
    const ref::Pool<Real> pool = ref::draw_pool(surface, params);
    return ref::throw_darts(surface, pool, ref::frame_of(c.surface, params).tolerances());
}

/// Cut at the bounds of the faces, a run returns what it returns cut at the largest radius alone.
template <class Real>
void check_cut(const std::string& name, const Case& c, double count) {
    INFO(name << " at " << count);
    const SampleParams params = c.params(count, 9);
    ref::Surface<Real> surface(c.surface, params);
    const ref::RunResult local = throw_on(surface, c, params);
    for (ref::FaceRadii<Real>& radii : surface.radii) {
        radii.bound = static_cast<Real>(0.5);
    }
    const ref::RunResult global = throw_on(surface, c, params);
    CHECK(local.ranks == global.ranks);
    CHECK(local.windows <= global.windows);
}

/// Every pair by CGAL: accepted ones keep their distance, and every rejected candidate conflicts
/// with an accepted one of lower rank.
void check_pairs(const std::string& name, const Case& c, double count) {
    INFO(name << " at " << count);
    SampleParams params = c.params(count, 4);
    params.pool_ratio = 10;
    const ref::Surface<float> surface(c.surface, params);
    const std::vector<std::uint32_t> ranks = throw_on(surface, c, params).ranks;
    const ref::Surface<double> exact(c.surface, params);
    const std::vector<Point> pool = ref::draw_pool(exact, params).by_rank();
    const auto size = static_cast<std::uint32_t>(pool.size());
    const double guard = ref::frame_of(c.surface, params).tolerances().guard;
    std::vector<bool> accepted(size, false), covered(size, false);
    for (const std::uint32_t rank : ranks) {
        accepted[rank] = true;
    }
    GeodesicOracle oracle(c.mesh);
    double closest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t rank : ranks) {
        const std::vector<double> distances = oracle.distances(pool[rank], pool);
        for (std::uint32_t q = rank + 1; q < size; ++q) {
            const double sum = exact.radius_at(pool[rank]) + exact.radius_at(pool[q]);
            const double distance = distances[q] / params.min_distance;
            if (accepted[q]) {
                closest = std::min(closest, distance - sum);
            }
            covered[q] = covered[q] || distance < sum + 2 * guard;
        }
    }
    CHECK(closest >= 0);
    std::uint32_t free = 0;
    for (std::uint32_t q = 0; q < size; ++q) {
        free += !accepted[q] && !covered[q] ? 1u : 0u;
    }
    CHECK(free == 0);
    CHECK(static_cast<double>(ranks.size()) > 0.5 * count);
}

void check_replay(const std::string& name, const Case& c, const SampleParams& params) {
    INFO(name << " at a distance of " << params.min_distance);
    const ReplayReport judged =
        replay(c.surface, params, ref::frame_of(c.surface, params).first_error());
    CHECK(judged.wrong == 0);
    CHECK(judged.ties <= 2);
    check_deviation(name, judged);
}

/// A long needle and thin caps beside plain faces.
TestMesh needles() {
    return flat_lines({0, 0.2, 0.2 + 1e-7, 0.5, 1}, {0, 1e-6, 0.3, 0.6, 0.6001, 1});
}

} // namespace

TEST_SUITE("radius field") {
    TEST_CASE("refuses what is no factor, naming the vertex") {
        TestMesh mesh = builtin("icosphere", 1);
        mesh.add_vertex({9, 9, 9}); // Unused: may have any factor.
        const PreparedMesh surface = prepared(mesh);
        const std::vector<double> ones(mesh.vertex_count(), 1.0);
        const auto with = [&](std::size_t vertex, double factor) {
            std::vector<double> factors = ones;
            factors[vertex] = factor;
            return factors;
        };
        CHECK(refused(surface, {}) == "there are 0 radius factors g for 43 vertices");
        CHECK(refused(surface, std::vector<double>(44, 1.0)) ==
              "there are 44 radius factors g for 43 vertices");
        CHECK(refused(surface, with(7, -0.5), 7) ==
              "the radius factor g of vertex 7 (from 0) is -0.5; it must be from 0.001 to 1");
        CHECK(refused(surface, with(0, 0), 0) ==
              "the radius factor g of vertex 0 (from 0) is 0; it must be from 0.001 to 1");
        CHECK(refused(surface, with(41, std::nextafter(1.0, 2.0)), 41) ==
              "the radius factor g of vertex 41 (from 0) is 1.0000000000000002; it must be from "
              "0.001 to 1");
        CHECK(refused(surface, with(3, NAN), 3) ==
              "the radius factor g of vertex 3 (from 0) is nan; it must be from 0.001 to 1");
        CHECK(refused(surface, std::vector<double>(43, 0.0)) == "all radius factors g are zero");
        CHECK(RadiusField::prepare(surface, with(42, NAN)));
        CHECK(RadiusField::prepare(surface, with(5, RadiusField::kMinFactor)));
    }

    TEST_CASE("is linear in faces") {
        const Case c(one_triangle(), {0.25, 0.5, 1});
        CHECK(c.field.factor_at(0, {1, 0, 0}) == 0.25);
        CHECK(c.field.factor_at(0, {0.5f, 0.25f, 0.25f}) == 0.5);
    }

    TEST_CASE("its effective area is the integral of 1 / g^2") {
        for (const std::array<double, 3>& g : {std::array{0.25, 0.5, 1.0},
                                               {0.125, 0.25, 0.1875},
                                               {0.0078125, 1.0, 0.5},
                                               {0.001953125, 0.25, 1.0},
                                               {1.0, 0.001953125, 0.015625}}) {
            const Case c(one_triangle(), {g[0], g[1], g[2]});
            CHECK(c.field.effective_area() ==
                  doctest::Approx(1.5 * exact_mean(g[0], g[1], g[2])).epsilon(1e-5));
        }
        const TestMesh mesh = builtin("torus-knot", 12);
        const Case same(mesh, std::vector<double>(mesh.vertex_count(), 0.5));
        CHECK(same.field.effective_area() ==
              doctest::Approx(4 * same.surface.statistics().area).epsilon(1e-12));
    }
}

TEST_SUITE("adaptive candidates") {
    TEST_CASE("are as dense as 1 / g^2") {
        check_density(Case(one_triangle(), {0.3, 0.9, 0.6}), 200000, 6);
        check_density(Case(one_triangle(), {1, 0.05, 1}), 1000000, 4);
        check_density(Case(one_triangle(), {0.05, 0.05, 1}), 1000000, 3);
        check_density(Case(flat_grid(3, 3, 2, 1), rough_factors(flat_grid(3, 3, 2, 1), 0.1)),
                      400000, 3);
    }

    TEST_CASE("are the same in float and in double, and inside their faces") {
        const TestMesh mesh = builtin("torus-knot", 8);
        const Case c(mesh, rough_factors(mesh, 0.001));
        const SampleParams params = c.params(1000, 3);
        const auto floats = ref::draw_pool(ref::Surface<float>(c.surface, params), params);
        const auto doubles = ref::draw_pool(ref::Surface<double>(c.surface, params), params);
        REQUIRE(floats.size() == doubles.size());
        std::uint32_t wrong = 0;
        for (std::uint32_t rank = 0; rank < floats.size(); ++rank) {
            const auto a = floats.candidate(rank);
            const auto b = doubles.candidate(rank);
            wrong += floats.word(rank) != doubles.word(rank);
            wrong += a.face != b.face || static_cast<double>(a.weight1) != b.weight1 ||
                     static_cast<double>(a.weight2) != b.weight2 || b.weight1 < 0 ||
                     b.weight2 < 0 || b.weight1 + b.weight2 >= 1;
        }
        CHECK(wrong == 0);
    }

    TEST_CASE("of the largest radius everywhere are those of no field") {
        const TestMesh mesh = builtin("torus-knot", 8);
        const Case c(mesh, std::vector<double>(mesh.vertex_count(), 1.0));
        SampleParams params = c.params(1000, 3);
        const auto varying = ref::draw_pool(ref::Surface<float>(c.surface, params), params);
        params.radii = nullptr;
        const auto same = ref::draw_pool(ref::Surface<float>(c.surface, params), params);
        REQUIRE(varying.size() == same.size());
        std::uint32_t wrong = 0;
        for (std::uint32_t rank = 0; rank < same.size(); ++rank) {
            const auto a = varying.candidate(rank);
            const auto b = same.candidate(rank);
            wrong += a.face != b.face || a.weight1 != b.weight1 || a.weight2 != b.weight2;
        }
        CHECK(wrong == 0);
    }
}

TEST_SUITE("adaptive reach") {
    TEST_CASE("is the radius itself where that changes slowly") {
        const TestMesh mesh = builtin("icosphere", 4);
        const Case c(mesh, wavy_factors(mesh, 0.5));
        const SampleParams params = c.params(3000);
        const auto bounds = c.field.reach_bounds(c.surface, params.min_distance);
        REQUIRE(bounds);
        std::uint32_t raised = 0;
        for (std::uint32_t f = 0; f < c.surface.face_count(); ++f) {
            const float* const g = &c.field.factors()[std::size_t{3} * f];
            raised += (*bounds)[f] > 0.5f * std::max({g[0], g[1], g[2]}) + 0x1p-14f;
        }
        CHECK(raised == 0);
    }

    TEST_CASE("covers every way on to a larger radius") {
        for (const auto& [name, resolution] : {std::pair{"icosphere", 2},
                                               {"torus-knot", 5},
                                               {"folded-sheet", 6},
                                               {"moebius", 5},
                                               {"klein-bottle", 7},
                                               {"cube", 1}}) {
            const TestMesh mesh = builtin(name, resolution);
            for (const double count : {5.0, 100.0, 1000.0}) {
                check_bounds(name, Case(mesh, rough_factors(mesh, 0.001)), count);
                check_bounds(name, Case(mesh, wavy_factors(mesh, 0.05, 3)), count);
            }
        }
        for (const double count : {5.0, 100.0, 1000.0}) {
            check_bounds("needles", Case(needles(), rough_factors(needles(), 0.01)), count);
            const TestMesh fan = flat_obtuse_fan(6);
            check_bounds("obtuse fan", Case(fan, rough_factors(fan, 0.01)), count);
        }
    }

    TEST_CASE("changes no set") {
        for (const auto& [name, resolution] : {std::pair{"icosphere", 3},
                                               {"torus-knot", 8},
                                               {"folded-sheet", 8},
                                               {"moebius", 6},
                                               {"cube", 1}}) {
            const TestMesh mesh = builtin(name, resolution);
            for (const double count : {20.0, 1000.0}) {
                for (const auto& factors : {rough_factors(mesh, 0.01), wavy_factors(mesh, 0.05)}) {
                    const Case c(mesh, factors);
                    check_cut<float>(name, c, count);
                    check_cut<double>(name, c, count);
                }
            }
        }
        check_cut<float>("needles", Case(needles(), rough_factors(needles(), 0.05)), 500);
    }

    TEST_CASE("keeps small disks small") {
        // Radii of a twentieth but for one vertex far away.
        const TestMesh mesh = flat_grid(40, 40, 1, 1);
        std::vector<double> factors(mesh.vertex_count(), 0.05);
        factors.back() = 1;
        const Case c(mesh, factors);
        const SampleParams params = c.params(3000);
        ref::Surface<float> surface(c.surface, params);
        const std::uint64_t local = throw_on(surface, c, params).windows;
        for (ref::FaceRadii<float>& radii : surface.radii) {
            radii.bound = 0.5f;
        }
        CHECK(10 * local < throw_on(surface, c, params).windows);
    }
}

TEST_SUITE("adaptive sets") {
    TEST_CASE("keep every pair apart and leave no candidate free, by CGAL") {
        for (const auto& [name, resolution] :
             {std::pair{"icosphere", 2}, {"torus-knot", 5}, {"folded-sheet", 6}, {"cube", 1}}) {
            const TestMesh mesh = builtin(name, resolution);
            check_pairs(name, Case(mesh, wavy_factors(mesh, 0.2)), 100);
            check_pairs(name, Case(mesh, rough_factors(mesh, 0.05)), 100);
        }
        for (const auto& [name, mesh] : meshes_like({"meshes/bunny_1k4.obj"})) {
            check_pairs(name, Case(mesh, wavy_factors(mesh, 0.1)), 150);
        }
    }

    TEST_CASE("are the same in float and in double but for ties") {
        for (const auto& [name, resolution] : {std::pair{"icosphere", 3},
                                               {"torus-knot", 8},
                                               {"klein-bottle", 12},
                                               {"terrain", 24},
                                               {"cube", 1}}) {
            const TestMesh mesh = builtin(name, resolution);
            for (const double count : {30.0, 1000.0}) {
                for (const auto& factors : {wavy_factors(mesh, 0.1), rough_factors(mesh, 0.01)}) {
                    const Case c(mesh, factors);
                    check_replay(name, c, c.params(count));
                }
            }
        }
    }

    TEST_CASE("come out about as many as asked for, denser where radii are smaller") {
        const TestMesh mesh = flat_grid(60, 60, 1, 1);
        std::vector<double> factors;
        for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            factors.push_back(std::clamp(2 * mesh.vertex(v).x, 0.5, 1.0));
        }
        const Case c(mesh, factors);
        const SampleParams params = c.params(4000);
        const ref::Surface<float> surface(c.surface, params);
        const auto points = ref::draw_pool(surface, params).by_rank();
        const auto ranks = throw_on(surface, c, params).ranks;
        CHECK(static_cast<double>(ranks.size()) == doctest::Approx(4000).epsilon(0.05));
        double coarse = 0, fine = 0;
        for (const std::uint32_t rank : ranks) {
            const auto& p = points[rank];
            const double x = mesh.position({p.face, static_cast<double>(p.weight1),
                                            static_cast<double>(p.weight2)})
                                 .x;
            fine += x < 0.2 ? 1 : 0;
            coarse += x > 0.8 ? 1 : 0;
        }
        CHECK(fine / coarse == doctest::Approx(4).epsilon(0.15));
    }

    TEST_CASE("have a guard that leaves the smallest disks their place") {
        const TestMesh shape = builtin("icosphere", 5);
        for (const double least : {1.0, 0.1, 0.001}) {
            CAPTURE(least);
            std::vector<double> factors(shape.vertex_count(), 1);
            factors[0] = least;
            const Case c(shape, factors);
            const SampleParams params = c.params(1000);
            const double error = ref::frame_of(c.surface, params).first_error();
            const double guard = ref::frame_of(c.surface, params).tolerances().guard;
            CHECK(guard >= error);
            CHECK(guard < 0.032 * least);
        }
    }

    TEST_CASE("have room for small disks however large the largest is") {
        // A distance beyond the diagonal, and still room for small disks in half of the square.
        const TestMesh mesh = flat_grid(20, 20, 1, 1);
        std::vector<double> factors;
        for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            factors.push_back(mesh.vertex(v).x < 0.5 ? 0.02 : 1);
        }
        const Case c(mesh, factors);
        SampleParams params = c.params(10);
        params.min_distance = 3;
        const ref::Surface<double> surface(c.surface, params);
        CHECK(surface.frame.unit == 3);
        CHECK(throw_on(surface, c, params).ranks.size() > 50);
        check_replay("half a square", c, params);
    }
}
