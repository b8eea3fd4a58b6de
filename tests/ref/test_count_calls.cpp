// The number of calls of CheckStatus: graphs whose recursion can be followed by hand, and batches
// on meshes, which must end with the set of sequential dart throwing.
#include <doctest/doctest.h>

#include "baselines/batches.hpp"
#include "baselines/count_calls.hpp"
#include "baselines/geodesic_disks.hpp"
#include "ref/dart_check.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

using Lists = std::vector<std::vector<std::uint32_t>>;
using Calls = std::vector<std::uint32_t>;

Calls calls_of(const Lists& above, const std::vector<std::uint8_t>& accepted) {
    return ref::count_calls(above, accepted);
}

} // namespace

TEST_CASE("calls: without conflicts each candidate checks itself") {
    CHECK(calls_of({}, {}) == Calls{});
    CHECK(calls_of({{}, {}, {}}, {1, 1, 1}) == Calls{1, 1, 1});
}

TEST_CASE("calls: a chain is followed to its end") {
    CHECK(calls_of({{}, {0}, {1}, {2}, {3}}, {1, 0, 1, 0, 1}) == Calls{1, 2, 3, 4, 5});
}

TEST_CASE("calls: the first accepted one ends the recursion") {
    CHECK(calls_of({{}, {}, {}, {0, 1, 2}}, {1, 1, 1, 0}) == Calls{1, 1, 1, 2});
    // Candidate 1 is rejected, so the third asks for candidate 2 as well.
    CHECK(calls_of({{}, {0}, {}, {1, 2}}, {1, 0, 1, 0}) == Calls{1, 2, 1, 4});
    CHECK(calls_of({{}, {0}, {}, {2}}, {1, 0, 1, 0}) == Calls{1, 2, 1, 2});
}

TEST_CASE("calls: a candidate come to twice is followed twice") {
    CHECK(calls_of({{}, {0}, {0}, {1, 2}}, {1, 0, 0, 1}) == Calls{1, 2, 2, 5});
    CHECK(calls_of({{}, {0}, {0, 1}, {1}}, {1, 0, 0, 1}) == Calls{1, 2, 2, 3});
}

TEST_CASE("calls: Fig. 1 of the paper") {
    // p2, p5, p3 and p4: p3 yields to p2 or p5, whichever comes first, and p4 asks p3.
    CHECK(calls_of({{}, {}, {0, 1}, {2}}, {1, 1, 0, 1}) == Calls{1, 1, 2, 3});
}

TEST_CASE("calls: numbers beyond a word's bits stay at the most") {
    // Each candidate is rejected by a lower one and asks all before it: twice as many calls each.
    Lists above(40);
    std::vector<std::uint8_t> accepted(40, 0);
    for (std::uint32_t i = 0; i < 40; ++i) {
        for (std::uint32_t k = 0; k < i; ++k) {
            above[i].push_back(k);
        }
    }
    const Calls calls = calls_of(above, accepted);
    CHECK(calls[10] == 1024);
    CHECK(calls[29] == 1u << 29);
    CHECK(calls[39] == ref::kMaxCalls);
}

TEST_CASE("calls: histogram") {
    CallHistogram histogram;
    CHECK(histogram.mean() == 0);
    CHECK(histogram.share(0) == 0);
    ref::add_calls(histogram, Calls{1, 1, 2, 9, 10, 11, 1});
    ref::add_calls(histogram, Calls{3});
    CHECK(histogram.candidates == std::array<std::uint64_t, 10>{3, 1, 1, 0, 0, 0, 0, 0, 1, 2});
    CHECK(histogram.total() == 8);
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
            CallHistogram calls;
            const ref::BatchRun run = ref::run_batches(disks, slots, &calls);
            CHECK(run.ranks == darts.ranks);
            CHECK(calls.total() == run.disks);
            CHECK(run.disks >= darts.ranks.size());
            CHECK(run.batches >= (run.disks + slots - 1) / slots);
            // With more slots more candidates meet others.
            CHECK(calls.mean() >= mean);
            mean = calls.mean();
        }
        CallHistogram alone;
        CHECK(ref::run_batches(disks, 1, &alone).disks == darts.ranks.size());
        CHECK(alone.candidates[0] == darts.ranks.size());
        CHECK(alone.mean() == 1);
    }
}
