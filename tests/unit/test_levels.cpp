// Levels of samples in progressive order.
#include <doctest/doctest.h>

#include <cstdint>
#include <set>
#include <vector>

#include <geodisk/levels.hpp>

#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

TEST_CASE("levels end with the distance of the run") {
    const Levels levels{4, 2};
    CHECK(levels.scale(3) == 1);
    CHECK(levels.scale(2) == 2);
    CHECK(levels.scale(0) == 8);
}

TEST_CASE(
    "the first level has the seed and the existing samples of the run, later ones their own") {
    const std::vector<Sample> given{{0, {1, 0, 0}}};
    const std::vector<Sample> before{{0, {1, 0, 0}}, {1, {0, 1, 0}}};
    SampleParams last;
    last.min_distance = 0.5;
    last.seed = 7;
    last.existing = given;
    std::set<std::uint64_t> seeds;
    for (std::uint32_t level = 0; level < 5; ++level) {
        const auto params = params_of_level(last, {5, 2}, level, before);
        REQUIRE(params);
        CHECK(params->min_distance == 0.5 * (1 << (4 - level)));
        CHECK(params->existing.data() == (level == 0 ? given.data() : before.data()));
        CHECK((params->seed == 7) == (level == 0));
        seeds.insert(params->seed);
    }
    CHECK(seeds.size() == 5);
    // Seeds of levels are part of what a seed gives.
    CHECK(params_of_level(last, {5, 2}, 1, before)->seed == 9856420069824017644u);
}

TEST_CASE("levels out of range are refused") {
    SampleParams last;
    last.min_distance = 1;
    for (const Levels& levels : {Levels{0, 2}, Levels{33, 2}, Levels{2, 1}, Levels{2, 9}}) {
        CHECK(params_of_level(last, levels, 0, {}).error().status == Status::invalid_argument);
    }
    CHECK(!params_of_level(last, {2, 2}, 2, {}));
    last.darts = 10;
    CHECK(!params_of_level(last, {2, 2}, 0, {}));
}

TEST_CASE("the first level expects 16 samples or a few more") {
    const std::vector<double> positions{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const std::vector<std::uint32_t> triangles{0, 1, 2, 0, 2, 3};
    const PreparedMesh mesh = take(PreparedMesh::prepare({positions, triangles}));
    SampleParams last;
    for (const double count : {1.0, 20.0, 70.0, 1000.0, 100000.0}) {
        for (const double factor : {1.5, 2.0, 4.0}) {
            CAPTURE(count);
            CAPTURE(factor);
            last.min_distance = distance_for_count(mesh.statistics().area, count);
            const Levels levels = levels_for(mesh, last, factor);
            const double first = last.min_distance * levels.scale(0);
            const double samples = expected_count(mesh.statistics().area, first);
            CHECK(samples < kFirstLevelSamples * factor * factor * 1.0001);
            CHECK((levels.count == 1 || samples > kFirstLevelSamples * 0.9999));
        }
    }
}

} // namespace
} // namespace geodisk::tools
