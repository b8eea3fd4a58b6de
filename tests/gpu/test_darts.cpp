// Darts thrown chunk by chunk: the set of one chunk, of the pool they make, and of sequential dart
// throwing, whatever the chunks; and runs that stop at a count.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "constants.h"
#include "device_run.hpp"
#include "sets.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {
namespace {

using Ranks = std::vector<std::uint32_t>;

RunnerOptions in_chunks(std::uint32_t chunk) {
    RunnerOptions options;
    options.plan.chunk = chunk;
    return options;
}

SampleParams darts_for(const PreparedMesh& mesh, double count, std::uint32_t throws,
                       std::uint32_t stop_count = 0) {
    SampleParams params = params_for(mesh, count);
    params.throws = throws;
    params.stop_count = stop_count;
    return params;
}

Ranks first_of(const Ranks& ranks, std::size_t count) {
    return {ranks.begin(), ranks.begin() + static_cast<std::ptrdiff_t>(count)};
}

} // namespace

TEST_SUITE("darts") {
    TEST_CASE("the set is that of sequential dart throwing, whatever the chunks") {
        const PreparedMesh meshes[] = {
            prepared(builtin("torus-knot", 12)), prepared(builtin("cube", 1)),
            prepared(builtin("folded-sheet", 16)), prepared(builtin("moebius", 8))};
        for (const PreparedMesh& mesh : meshes) {
            const SampleParams params = darts_for(mesh, 300, 10'000);
            const SampleSet whole = sample(mesh, params);
            CHECK(whole.report.chunks == 1);
            CHECK(whole.report.candidates == 10'000);
            const Ranks want = ranks_of(whole);
            CHECK(want == double_set(mesh, params, whole.report.plan.chain));
            for (const std::uint32_t chunk : {97u, 2'000u, 9'999u, 10'000u}) {
                CAPTURE(chunk);
                const SampleSet set = sample(mesh, params, in_chunks(chunk));
                CHECK(set.report.chunks == (10'000 + chunk - 1) / chunk);
                CHECK(set.report.candidates == 10'000);
                CHECK(ranks_of(set) == want);
            }
        }
    }

    TEST_CASE("one dart is one sample") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 2));
        const SampleSet set = sample(mesh, darts_for(mesh, 300, 1));
        CHECK(ranks_of(set) == Ranks{0});
        CHECK(set.report.candidates == 1);
    }

    TEST_CASE("as many darts as a pool has candidates give the pool's samples") {
        const PreparedMesh mesh = prepared(builtin("lattice", 1));
        const SampleParams pool = params_for(mesh, 800);
        const Ranks want = ranks_of(sample(mesh, pool));
        SampleParams darts = pool;
        darts.throws = expect(pool_size(mesh, pool));
        CHECK(ranks_of(sample(mesh, darts)) == want);
        CHECK(ranks_of(sample(mesh, pool, in_chunks(5'000))) == want);
        CHECK(ranks_of(sample(mesh, darts, in_chunks(5'000))) == want);
    }

    TEST_CASE("samples and darts that differ between chunks are the same points") {
        const PreparedMesh mesh = prepared(builtin("terrain", 32));
        const SampleParams params = darts_for(mesh, 500, 8'000);
        const SampleSet whole = sample(mesh, params);
        const SampleSet parts = sample(mesh, params, in_chunks(700));
        REQUIRE(parts.samples.size() == whole.samples.size());
        std::size_t different = 0;
        for (std::size_t i = 0; i < whole.samples.size(); ++i) {
            const Sample& a = whole.samples[i];
            const Sample& b = parts.samples[i];
            different += a.candidate != b.candidate || a.face != b.face ||
                         !std::equal(a.weights, a.weights + 3, b.weights);
        }
        CHECK(different == 0);
    }

    TEST_CASE("a run stops at exactly the count asked for, with the first samples") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 12));
        const SampleParams all = darts_for(mesh, 400, 12'000);
        const Ranks ranks = ranks_of(sample(mesh, all));
        const auto size = static_cast<std::uint32_t>(ranks.size());
        for (const std::uint32_t count : {1u, 2u, 100u, size - 1, size}) {
            CAPTURE(count);
            const SampleParams params = darts_for(mesh, 400, 12'000, count);
            const Ranks want = first_of(ranks, count);
            std::vector<RunnerOptions> ways{
                {}, in_chunks(150), in_chunks(3'000), in_chunks(12'000)};
            for (const std::uint32_t slots : {1u, 37u, 1'000u}) {
                ways.emplace_back().plan.slots = slots;
            }
            for (const RunnerOptions& options : ways) {
                const SampleSet set = sample(mesh, params, options);
                CHECK(ranks_of(set) == want);
                CHECK(set.report.candidates == want.back() + 1);
            }
            CHECK(want == double_set(mesh, params, provided_chain(mesh, params.min_distance)));
        }
    }

    TEST_CASE("a pool stops at a count as well") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 3));
        SampleParams params = params_for(mesh, 300);
        const Ranks ranks = ranks_of(sample(mesh, params));
        params.stop_count = 200;
        CHECK(ranks_of(sample(mesh, params)) == first_of(ranks, 200));
    }

    TEST_CASE("a count out of reach uses up the darts and returns what there is") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 3));
        const SampleParams params = darts_for(mesh, 100, 5'000, 4'000);
        const SampleSet set = sample(mesh, params, in_chunks(900));
        CHECK(set.report.candidates == 5'000);
        CHECK(ranks_of(set) == ranks_of(sample(mesh, darts_for(mesh, 100, 5'000))));
        CHECK(set.samples.size() < 200);
    }

    TEST_CASE("overflows while earlier samples reject change nothing") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 4));
        const SampleParams params = darts_for(mesh, 300, 9'000);
        const Ranks want = ranks_of(sample(mesh, params));
        RunnerOptions tight = in_chunks(4'000);
        tight.plan.window_capacity = 2;
        tight.plan.table_capacity = 4;
        tight.plan.list_capacity = 4;
        tight.pool_bytes = 1 << 20;
        const SampleSet set = sample(mesh, params, tight);
        CHECK(ranks_of(set) == want);
        CHECK(set.report.regrown > 0);

        // A first chunk of few candidates has short lists; those of the second overflow in the
        // disks of its samples.
        RunPlan plan;
        plan.list_capacity = 64;
        DeviceRun run(mesh, params, plan);
        const auto decide = [&](std::uint32_t first, std::uint32_t count) {
            std::uint32_t overflows = 0;
            run.set_chunk(first, count);
            run.begin();
            while (run.control().done == 0) {
                run.rounds(1);
                if (run.control().overflow != 0) {
                    CHECK(run.control().overflow == gpu::kOverflowConflicts);
                    CHECK(run.control().next_rank == 0);
                    const std::uint32_t before = run.control().batch_sample;
                    run.grow(run.control().overflow);
                    CHECK(run.control().next_sample == before);
                    ++overflows;
                }
            }
            run.finish();
            return overflows;
        };
        CHECK(decide(0, 500) == 0);
        CHECK(decide(500, 8'500) > 0);
        Ranks ranks;
        for (const auto& record :
             run.read<gpu::SampleRec>(BufferRole::samples, run.control().accepted)) {
            ranks.push_back(record.rank);
        }
        CHECK(ranks == want);
    }

    TEST_CASE("darts too many for the lists of a small pool come in more chunks") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 2));
        SampleParams params;
        params.min_distance = 10 * mesh.statistics().diagonal;
        params.throws = 20'000;
        RunnerOptions small;
        small.pool_bytes = 256 << 10;
        const SampleSet set = sample(mesh, params, small);
        CHECK(set.report.chunks > 1);
        CHECK(ranks_of(set) == Ranks{0});
    }

    TEST_CASE("the buffer of samples grows and keeps those of earlier chunks") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 12));
        const SampleParams params = darts_for(mesh, 500, 10'000);
        RunnerOptions options = in_chunks(300);
        options.plan.sample_capacity = 5;
        CHECK(ranks_of(sample(mesh, params, options)) == ranks_of(sample(mesh, params)));
    }

    TEST_CASE("no chunk and no slots change the guard of a repeated run") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 4));
        for (const std::uint32_t stop_count : {0u, 40u}) {
            const SampleParams params = darts_for(mesh, 60, 2'000, stop_count);
            std::vector<std::uint32_t> chains;
            std::vector<Ranks> sets;
            for (const std::uint32_t slots : {1u, 16u, 1'000u}) {
                for (const std::uint32_t chunk : {100u, 2'000u}) {
                    RunnerOptions options = in_chunks(chunk);
                    options.plan.slots = slots;
                    options.plan.chain = 1;
                    const SampleSet set = sample(mesh, params, options);
                    chains.push_back(set.report.plan.chain);
                    sets.push_back(ranks_of(set));
                }
            }
            CHECK(chains == std::vector<std::uint32_t>(6, chains[0]));
            CHECK(chains[0] > 1);
            CHECK(sets == std::vector<Ranks>(6, sets[0]));
        }
    }

    TEST_CASE("progress goes on through the chunks, and any of them can be cancelled") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 4));
        const SampleParams params = darts_for(mesh, 1'000, 20'000);
        Context& context = shared_context();
        Runner runner = expect(Runner::create(context.device(), context.queue(), in_chunks(4'000)));
        std::uint32_t passed = 0;
        const auto cancelled = runner.sample_and_wait(mesh, params, [&](const Progress& state) {
            CHECK(state.candidates == 20'000);
            CHECK(state.ranks_passed >= passed);
            passed = state.ranks_passed;
            return passed <= 10'000;
        });
        REQUIRE_FALSE(cancelled);
        CHECK(cancelled.error().status == Status::cancelled);
        CHECK(passed > 10'000);
        CHECK(ranks_of(expect(runner.sample_and_wait(mesh, params))) ==
              ranks_of(sample(mesh, params)));
    }

    TEST_CASE("chunks that cannot be are refused") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 2));
        const SampleParams params = params_for(mesh, 30);
        RunPlan plan;
        plan.chunk = 100;
        const Sampler sampler = expect(Sampler::create(shared_context().device()));
        DeviceRun run(mesh, params, plan);
        CHECK(run.candidates() == 100);
        run.set_chunk(400, 60);
        CHECK(run.candidates() == 60);
        CHECK_THROWS_WITH(run.set_chunk(0, 0), doctest::Contains("1 to 100"));
        CHECK_THROWS_WITH(run.set_chunk(0, 101), doctest::Contains("1 to 100"));
        CHECK_THROWS_WITH(run.set_chunk(kMostCandidates - 99, 100), doctest::Contains("beyond"));
        CHECK(run.candidates() == 60);
    }

    TEST_CASE("pools larger than a binding are drawn in chunks") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 2));
        const Sampler sampler = expect(Sampler::create(shared_context().device()));
        const std::uint64_t binding = sampler.report().limits.max_storage_buffer_range;
        if (binding / 4 >= kMostCandidates / 2) {
            return; // A GPU that binds all.
        }
        const SampleParams params =
            params_for(mesh, 1.5 * static_cast<double>(binding / 4) / kDefaultPoolRatio);
        const RunPlan plan = expect(sampler.plan_run(mesh, params, std::uint64_t{64} << 20));
        CHECK(plan.chunk == binding / 4);
        CHECK(expect(pool_size(mesh, params)) > plan.chunk);
        CHECK(expect(sampler.workspace_needs(mesh, params, plan))
                  .bytes[static_cast<std::size_t>(BufferRole::states)] == binding);
    }
}

} // namespace geodisk::test
