// Sets against known mathematics: what random sequential adsorption is proved or known to give.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

#include "kernels/grid.hpp"
#include "ref/dart_check.hpp"

namespace geodisk::test {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

SampleParams dart_params(double min_distance, std::uint32_t darts, std::uint64_t seed) {
    SampleParams params;
    params.min_distance = min_distance;
    params.darts = darts;
    params.seed = seed;
    return params;
}

/// Area of the unit sphere, as a part of it, that is at least `distance` from all `points` along
/// great circles: by the centroids of a fine icosphere.
double free_part(const std::vector<Vec3>& centroids, const std::vector<Vec3>& points,
                 double distance) {
    const double limit = std::cos(distance);
    std::size_t free = 0;
    for (const Vec3& centroid : centroids) {
        const bool is_free = std::ranges::all_of(
            points, [&](const Vec3& point) { return glm::dot(centroid, point) <= limit; });
        free += is_free ? 1u : 0u;
    }
    return static_cast<double>(free) / static_cast<double>(centroids.size());
}

std::vector<Vec3> directions_of_faces(const TestMesh& sphere) {
    std::vector<Vec3> centroids;
    for (std::uint32_t face = 0; face < sphere.face_count(); ++face) {
        centroids.push_back(glm::normalize(sphere.corner(face, 0) + sphere.corner(face, 1) +
                                           sphere.corner(face, 2)));
    }
    return centroids;
}

/// Part of an n-dimensional box of volume 1 that `count` balls of this diameter fill.
double filled(std::size_t dimension, double diameter, std::size_t count) {
    const double n = static_cast<double>(dimension);
    return static_cast<double>(count) * std::pow(std::sqrt(kHalfTurn) * diameter / 2, n) /
           std::tgamma(n / 2 + 1);
}

} // namespace

TEST_SUITE("known results") {
    // Chen and Holmes-Cerfon, "Random sequential adsorption of spheres on a sphere" (2017): caps of
    // 45 degrees always end as four.
    TEST_CASE("a sphere takes exactly four samples a quarter of the way around apart") {
        const PreparedMesh sphere = prepared(builtin("icosphere", 4));
        // Ways along the facets are up to 0.2 % shorter than great circles.
        const double quarter = 0.998 * kHalfTurn / 2;
        for (std::uint64_t seed = 0; seed < 40; ++seed) {
            CAPTURE(seed);
            std::size_t samples = 0;
            // The last gap may be as small as it likes.
            for (std::uint32_t darts = 20000; samples < 4 && darts <= 20000000; darts *= 10) {
                samples = thrown<float>(sphere, dart_params(quarter, darts, seed)).ranks.size();
            }
            CHECK(samples == 4);
        }
    }

    // Each dart is accepted with the probability of its unblocked area, whatever came before.
    TEST_CASE("the first darts on a sphere are accepted as often as area is free") {
        const TestMesh mesh = builtin("icosphere", 4);
        const PreparedMesh sphere = prepared(mesh);
        const std::vector<Vec3> centroids = directions_of_faces(mesh);
        constexpr double kDistance = 1;
        constexpr std::uint32_t kDarts = 6, kRuns = 500;
        double surplus = 0, variance = 0;
        for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
            const Darts darts = thrown<float>(sphere, dart_params(kDistance, kDarts, seed));
            REQUIRE(darts.pool.size() == kDarts);
            REQUIRE(darts.ranks.front() == 0);
            std::vector<Vec3> accepted{glm::normalize(mesh.position(darts.pool[0]))};
            for (std::uint32_t rank = 1; rank < kDarts; ++rank) {
                const double chance = free_part(centroids, accepted, kDistance);
                const bool is_accepted = std::ranges::binary_search(darts.ranks, rank);
                surplus += (is_accepted ? 1 : 0) - chance;
                variance += chance * (1 - chance);
                if (is_accepted) {
                    accepted.push_back(glm::normalize(mesh.position(darts.pool[rank])));
                }
            }
        }
        CHECK(variance > 100); // The test can tell something.
        CHECK(std::abs(surplus) < 3 * std::sqrt(variance));
    }

    // Renyi's constant in one dimension; simulations of the literature in others. The approach is
    // by t^(-1/n) with t darts per volume (Feder 1980), from below.
    TEST_CASE("coverage of boxes tends to that of random sequential adsorption") {
        struct Known {
            double min_distance, coverage;
            double tolerance; ///< For chance, and for terms of higher order in higher dimensions.
        };
        constexpr Known kKnown[] = {{1.0 / 8000, 0.7476, 0.01},
                                    {0.015, 0.5471, 0.01},
                                    {0.06, 0.384, 0.03},
                                    {0.13, 0.260, 0.05}};
        for (std::size_t dimension = 1; dimension <= 4; ++dimension) {
            CAPTURE(dimension);
            const auto [min_distance, coverage, tolerance] = kKnown[dimension - 1];
            constexpr std::uint32_t kDarts = 800000, kRuns = 4;
            BoxParams box;
            box.extents.assign(dimension, 1);
            box.is_periodic = true;
            box.min_distance = min_distance;
            box.darts = kDarts;
            double early = 0, late = 0; // After a quarter of the darts, and after all.
            for (box.seed = 0; box.seed < kRuns; ++box.seed) {
                const std::vector<std::uint32_t> ranks =
                    ref::throw_darts(ref::BoxPool<double>(box));
                const auto quarter = std::ranges::lower_bound(ranks, kDarts / 4);
                early += filled(dimension, min_distance,
                                static_cast<std::size_t>(quarter - ranks.begin())) /
                         kRuns;
                late += filled(dimension, min_distance, ranks.size()) / kRuns;
            }
            const double step = std::pow(4, 1 / static_cast<double>(dimension));
            const double limit = (step * late - early) / (step - 1);
            MESSAGE("coverage in " << dimension << "-D: " << late << ", tends to " << limit
                                   << "; known " << coverage);
            CHECK(late < coverage * 1.005);
            CHECK(std::abs(limit - coverage) < tolerance * coverage);
        }
    }
}

} // namespace geodisk::test
