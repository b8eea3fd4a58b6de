#include "bench/statistics.hpp"
#include "bench/subdivision.hpp"

#include "mesh_facts.hpp"
#include "shapes/builtin_shapes.hpp"
#include "test_files.hpp"

#include <cmath>
#include <vector>

using namespace geodisk::bench;
using namespace geodisk::tools;

TEST_CASE("the median is the middle value") {
    CHECK(median({3}) == 3);
    CHECK(median({5, 1, 2}) == 2);
    CHECK(median({4, 1, 2, 100}) == 3);
}

TEST_CASE("a power law is found again") {
    std::vector<Point> points;
    for (const double x : {100.0, 300.0, 1000.0, 3000.0}) {
        points.push_back({x, 0.25 * std::pow(x, 1.5)});
    }
    const auto law = fit_power_law(points);
    REQUIRE(law.has_value());
    CHECK(law->exponent == doctest::Approx(1.5).epsilon(1e-12));
    CHECK(law->factor == doctest::Approx(0.25).epsilon(1e-12));
    CHECK(law->r_squared == doctest::Approx(1).epsilon(1e-12));
    CHECK(law->points == 4);
    CHECK(law->from == 100);
}

TEST_CASE("a fit balances what does not follow it") {
    // In logarithms of 10: (0, 0), (1, 2), (2, 1), whose line has the slope 1/2.
    const std::vector<Point> points{{1, 1}, {10, 100}, {100, 10}};
    const auto law = fit_power_law(points);
    REQUIRE(law.has_value());
    CHECK(law->exponent == doctest::Approx(0.5).epsilon(1e-12));
    CHECK(law->r_squared == doctest::Approx(0.25).epsilon(1e-12));
}

TEST_CASE("a constant has the exponent 0") {
    const auto law = fit_power_law(std::vector<Point>{{1, 7}, {10, 7}, {100, 7}});
    REQUIRE(law.has_value());
    CHECK(law->exponent == doctest::Approx(0));
    CHECK(law->factor == doctest::Approx(7));
    CHECK(law->r_squared == 1);
}

TEST_CASE("too few points have no exponent") {
    CHECK_FALSE(fit_power_law({}).has_value());
    CHECK_FALSE(fit_power_law(std::vector<Point>{{2, 3}}).has_value());
    CHECK_FALSE(fit_power_law(std::vector<Point>{{7, 3}, {7, 4}, {7, 5}}).has_value());
    CHECK_FALSE(fit_power_law(std::vector<Point>{{2, 3}, {0, 4}, {5, -1}}).has_value());
}

TEST_CASE("what falls first is fitted where it rises") {
    const std::vector<Point> valley{{100, 4}, {300, 1}, {1000, 2}, {10000, 20}};
    const auto law = fit_rise(valley);
    REQUIRE(law.has_value());
    CHECK(law->from == 300);
    CHECK(law->points == 3);
    CHECK(law->exponent > 0.5);
    const auto falling = fit_rise(std::vector<Point>{{1, 4}, {2, 2}, {4, 1}});
    REQUIRE(falling.has_value());
    CHECK(falling->from == 2);
    CHECK(falling->exponent == doctest::Approx(-1));
    CHECK_FALSE(fit_rise({}).has_value());
    CHECK_FALSE(fit_rise(std::vector<Point>{{2, 3}}).has_value());
}

TEST_CASE("subdivision keeps the surface and how it hangs together") {
    for (const char* const name : {"cube", "moebius", "terrain"}) {
        CAPTURE(name);
        const MeshFile coarse = make_builtin(name, 3);
        const MeshFacts before = measure(coarse);
        for (const std::uint32_t parts : {1u, 2u, 5u}) {
            CAPTURE(parts);
            const MeshFile fine = subdivide(coarse, parts);
            const MeshFacts after = measure(fine);
            CHECK(fine.triangles.size() == coarse.triangles.size() * parts * parts);
            CHECK(total_area(fine) == doctest::Approx(total_area(coarse)).epsilon(1e-12));
            CHECK(after.flattest == doctest::Approx(before.flattest).epsilon(1e-9));
            CHECK(after.border_edges == before.border_edges * parts);
            CHECK(after.clashing_edges == before.clashing_edges * parts);
            CHECK(after.crowded_edges == 0);
            CHECK(after.pinched_vertices == 0);
            CHECK(after.components == before.components);
            CHECK(after.euler_characteristic == before.euler_characteristic);
        }
    }
}
