// The number of calls of CheckStatus: graphs whose recursion can be followed by hand, and batches
// on meshes, which must end with the set of sequential dart throwing.
#include <doctest/doctest.h>

#include "baselines/batches.hpp"
#include "baselines/check_calls.hpp"
#include "baselines/geodesic_disks.hpp"
#include "ref/dart_check.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

using Lists = std::vector<std::vector<std::uint32_t>>;
using Calls = std::vector<std::uint32_t>;

} // namespace

TEST_CASE("check calls: without conflicts each candidate checks itself") {
    CHECK(ref::count_check_calls(Lists{}) == Calls{});
    CHECK(ref::count_check_calls(Lists{{}, {}, {}}) == Calls{1, 1, 1});
}

TEST_CASE("check calls: a chain is followed to its end") {
    CHECK(ref::count_check_calls(Lists{{}, {0}, {1}, {2}, {3}}) == Calls{1, 2, 3, 4, 5});
    CHECK(ref::count_check_calls(Lists{{1}, {2}, {}}) == Calls{3, 2, 1});
}

TEST_CASE("check calls: the first accepted one ends the recursion") {
    CHECK(ref::count_check_calls(Lists{{}, {}, {}, {0, 1, 2}}) == Calls{1, 1, 1, 2});
    // Candidate 1 is rejected, so the third asks for candidate 2 as well, or not.
    CHECK(ref::count_check_calls(Lists{{}, {0}, {}, {1, 2}}) == Calls{1, 2, 1, 4});
    CHECK(ref::count_check_calls(Lists{{}, {0}, {}, {2, 1}}) == Calls{1, 2, 1, 2});
}

TEST_CASE("check calls: a call for a candidate decided before returns at once") {
    CHECK(ref::count_check_calls(Lists{{}, {0}, {0}, {1, 2}}) == Calls{1, 2, 2, 5});
}

TEST_CASE("check calls: Fig. 1 of the paper") {
    // p2, p3, p4 and p5; p3 yields to p2 and p5, p4 to p3.
    CHECK(ref::count_check_calls(Lists{{}, {0, 3}, {1}, {}}) == Calls{1, 2, 3, 1});
}

TEST_CASE("check calls: histogram") {
    ref::CallHistogram histogram;
    CHECK(histogram.mean() == 0);
    CHECK(histogram.share(0) == 0);
    histogram.add(Calls{1, 1, 2, 9, 10, 11, 1});
    histogram.add(Calls{3});
    CHECK(histogram.candidates == std::array<std::uint64_t, 10>{3, 1, 1, 0, 0, 0, 0, 0, 1, 2});
    CHECK(histogram.total == 8);
    CHECK(histogram.share(0) == 0.375);
    CHECK(histogram.mean() == 38.0 / 8);
}

TEST_CASE("batches: the set of sequential dart throwing for any number of slots") {
    for (const TestMesh& shape : {builtin("icosphere", 3), builtin("torus-knot", 6)}) {
        const PreparedMesh mesh = prepared(shape);
        const SampleParams params = params_for(mesh, 200);
        const Darts darts = thrown<double>(mesh, params);
        ref::GeodesicDisks disks(mesh, params.min_distance, darts.pool, darts.tolerances);
        double mean = 1;
        for (const std::uint32_t slots : {1u, 10u, 80u, 500u}) {
            ref::CallHistogram calls;
            const ref::BatchRun run = ref::run_batches(disks, slots, &calls);
            CHECK(run.ranks == darts.ranks);
            CHECK(calls.total == run.disks);
            CHECK(run.disks >= darts.ranks.size());
            CHECK(run.batches >= (run.disks + slots - 1) / slots);
            // With more slots more candidates meet others.
            CHECK(calls.mean() >= mean);
            mean = calls.mean();
        }
        ref::CallHistogram alone;
        CHECK(ref::run_batches(disks, 1, &alone).disks == darts.ranks.size());
        CHECK(alone.candidates[0] == darts.ranks.size());
        CHECK(alone.mean() == 1);
    }
}
