// Every kernel against its float twin, bit for bit, step by step through whole runs.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "constants.h"
#include "device_run.hpp"
#include "kernels/bins.hpp"
#include "kernels/candidates.hpp"
#include "kernels/count_calls.hpp"
#include "kernels/detect.hpp"
#include "kernels/resolve.hpp"
#include "kernels/select.hpp"
#include "sets.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {
namespace {

/// The twin's side of a chunk: the same candidates, and states by rank, counted from the first.
struct Twin {
    std::uint32_t first;
    ref::Surface<float> surface;
    std::vector<ref::FacePoint<float>> points;
    ref::Bins<float> bins;
    ref::Detector<float> detector;
    std::vector<std::uint8_t> states;

    Twin(const PreparedMesh& mesh, const SampleParams& params, std::uint32_t chain,
         std::uint32_t first_rank, std::uint32_t count)
        : first(first_rank), surface(mesh, params),
          points(ref::draw_candidates(surface, params.seed, count, first)), bins(surface, points),
          detector(surface, bins, tolerances_for(mesh, params, chain),
                   tolerances_for(mesh, params, chain).limit),
          states(points.size(), gpu::kIdle) {}

    /// `conflicts` are those of higher rank, `above` the active ones of lower rank.
    ref::DiskCount disk(std::uint32_t rank, std::vector<std::uint32_t>& conflicts,
                        std::vector<std::uint32_t>& above) {
        const auto count = detector.run(
            points[rank],
            [&](std::uint32_t q) {
                const std::uint32_t other = bins.order[q];
                return other != rank && states[other] <= gpu::kActive;
            },
            [&](std::uint32_t q, float) {
                // What an active one of lower rank decides about this one is for that one to say.
                (bins.order[q] > rank ? conflicts : above).push_back(bins.order[q]);
            });
        std::sort(conflicts.begin(), conflicts.end());
        std::sort(above.begin(), above.end());
        above.erase(std::unique(above.begin(), above.end()), above.end());
        return count;
    }

    /// The idle candidates in the disk of a sample of an earlier chunk.
    ref::DiskCount disk(const gpu::SampleRec& sample, std::vector<std::uint32_t>& conflicts) {
        const auto count = detector.run(
            {sample.face, sample.weight1, sample.weight2},
            [&](std::uint32_t q) { return states[bins.order[q]] == gpu::kIdle; },
            [&](std::uint32_t q, float) { conflicts.push_back(bins.order[q]); });
        std::sort(conflicts.begin(), conflicts.end());
        return count;
    }

    gpu::SampleRec sample(std::uint32_t rank) const {
        return {first + rank, points[rank].face, points[rank].weight1, points[rank].weight2};
    }
};

bool same(const gpu::SampleRec& a, const gpu::SampleRec& b) {
    return a.rank == b.rank && a.face == b.face && a.weight1 == b.weight1 && a.weight2 == b.weight2;
}

bool same(const gpu::SlotRec& slot, const ref::DiskCount& disk) {
    return slot.pushed == disk.windows && slot.most_waiting == disk.most_waiting &&
           slot.longest_chain == disk.chain && slot.vertices == disk.vertices &&
           slot.tested == disk.tested;
}

float weight(std::uint32_t steps) {
    return static_cast<float>(steps) * 0x1p-24f;
}

void compare_candidates(const DeviceRun& run, const Twin& twin) {
    const auto states = run.read<std::uint32_t>(BufferRole::states, run.candidates());
    const auto weights = run.read<std::uint32_t>(BufferRole::weights, run.candidates());
    const auto places = run.read<std::uint32_t>(BufferRole::places, run.candidates());
    REQUIRE(states.size() == twin.points.size());
    std::uint32_t wrong = 0;
    for (std::uint32_t rank = 0; rank < states.size(); ++rank) {
        const std::uint32_t state = states[places[rank]];
        const ref::FacePoint<float>& want = twin.points[rank];
        wrong += weight(state >> gpu::kWeightShift) != want.weight1 ||
                 weight(weights[places[rank]]) != want.weight2 ||
                 (state & gpu::kStateMask) != gpu::kIdle;
    }
    CHECK(wrong == 0);
}

void compare_bins(const DeviceRun& run, const Twin& twin) {
    const auto starts = run.read<std::uint32_t>(BufferRole::cells, twin.bins.starts.size());
    CHECK(starts == twin.bins.starts);
    // Within a cell the order is that of atomics, so cells are compared as sets.
    const auto by_place = ranks_by_place(run);
    std::uint32_t wrong = 0;
    for (std::size_t c = 0; c + 1 < starts.size(); ++c) {
        std::vector<std::uint32_t> ranks;
        for (std::uint32_t place = starts[c]; place < starts[c + 1]; ++place) {
            ranks.push_back(by_place[place]);
        }
        std::sort(ranks.begin(), ranks.end());
        wrong +=
            !std::equal(ranks.begin(), ranks.end(), twin.bins.order.begin() + twin.bins.starts[c]);
    }
    CHECK(wrong == 0);
}

/// The calls of CheckStatus of one batch, slot by slot, and with them `all` so far. `above` has
/// ranks.
void compare_calls(const DeviceRun& run, const Twin& twin, const std::vector<std::uint32_t>& batch,
                   std::vector<std::vector<std::uint32_t>> above, CallHistogram& all) {
    std::vector<std::uint8_t> accepted;
    for (std::size_t i = 0; i < batch.size(); ++i) {
        accepted.push_back(twin.states[batch[i]] == gpu::kAccepted ? 1 : 0);
        for (std::uint32_t& rank : above[i]) {
            rank = static_cast<std::uint32_t>(std::lower_bound(batch.begin(), batch.end(), rank) -
                                              batch.begin());
        }
    }
    const std::vector<std::uint32_t> want = ref::count_calls(above, accepted);
    ref::add_calls(all, want);
    const auto words =
        run.read<std::uint32_t>(BufferRole::control, batch.size(), sizeof(gpu::ControlRec));
    std::uint32_t wrong = 0;
    for (std::size_t i = 0; i < batch.size(); ++i) {
        wrong += words[i] != (want[i] | gpu::kCallsKnown);
    }
    CHECK(wrong == 0);
    const gpu::ControlRec control = run.control();
    CHECK(std::equal(all.candidates.begin(), all.candidates.end(), control.call_bins));
    CHECK((std::uint64_t{control.calls_high} << 32 | control.calls_low) == all.calls);
}

/// What the disks of one batch took and found, slot by slot; and its calls, unless they are null.
void compare_batch(const DeviceRun& run, Twin& twin, const std::vector<std::uint32_t>& by_place,
                   CallHistogram* calls) {
    const gpu::ControlRec control = run.control();
    const auto slots = run.read<gpu::SlotRec>(BufferRole::slots, control.slots_used);
    // A batch may be shorter than there are slots, but never skips a rank.
    REQUIRE(control.slots_used <= run.plan().slots);
    const auto batch = ref::select_idle(twin.states, control.batch_rank, control.slots_used);
    std::vector<std::uint32_t> selected;
    for (const gpu::SlotRec& slot : slots) {
        selected.push_back(slot.rank);
    }
    std::sort(selected.begin(), selected.end());
    REQUIRE(selected == batch);
    for (const std::uint32_t rank : batch) {
        twin.states[rank] = gpu::kActive;
    }
    std::vector<std::vector<std::uint32_t>> conflicts(batch.size());
    std::vector<std::vector<std::uint32_t>> above(batch.size());
    std::uint32_t wrong = 0;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        const auto at = static_cast<std::size_t>(
            std::lower_bound(batch.begin(), batch.end(), slots[i].rank) - batch.begin());
        const ref::DiskCount want = twin.disk(batch[at], conflicts[at], above[at]);
        wrong += !same(slots[i], want);
        wrong += listed(run, slots[i], i, by_place) != conflicts[at];
    }
    CHECK(wrong == 0);
    ref::resolve_batch(batch, conflicts, twin.states);
    if (calls != nullptr) {
        compare_calls(run, twin, batch, std::move(above), *calls);
    }
}

/// Adds the chunk's samples to those of the chunks before.
void compare_samples(const DeviceRun& run, const Twin& twin, std::vector<gpu::SampleRec>& want) {
    const gpu::ControlRec control = run.control();
    const auto samples = run.read<gpu::SampleRec>(BufferRole::samples, control.accepted);
    for (std::uint32_t rank = 0; rank < twin.states.size(); ++rank) {
        if (twin.states[rank] == gpu::kAccepted) {
            want.push_back(twin.sample(rank));
        }
    }
    REQUIRE(samples.size() == want.size());
    std::uint32_t wrong = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        wrong += !same(samples[i], want[i]);
    }
    CHECK(wrong == 0);
}

/// The first rounds of a chunk: batches of the samples so far, whose disks reject and do nothing
/// else.
void step_through_samples(DeviceRun& run, Twin& twin, const std::vector<gpu::SampleRec>& settled,
                          const std::vector<std::uint32_t>& by_place) {
    for (std::uint32_t next = 0; next < settled.size();) {
        gpu::ControlRec control{};
        do {
            run.rounds(1);
            control = run.control();
            REQUIRE(control.overflow == 0);
        } while (control.undecided > 0);
        REQUIRE(control.settled == settled.size());
        REQUIRE(control.batch_sample == next);
        REQUIRE(control.next_sample == next + control.slots_used);
        REQUIRE(control.slots_used > 0);
        CHECK(control.next_rank == 0);
        CHECK(control.accepted == settled.size());
        const auto slots = run.read<gpu::SlotRec>(BufferRole::slots, control.slots_used);
        std::vector<std::vector<std::uint32_t>> conflicts(slots.size());
        std::uint32_t wrong = 0;
        for (std::size_t i = 0; i < slots.size(); ++i) {
            const gpu::SampleRec& sample = settled[next + i];
            const ref::DiskCount want = twin.disk(sample, conflicts[i]);
            wrong +=
                slots[i].place != gpu::kNoPlace || !same({twin.first + slots[i].rank, slots[i].face,
                                                          slots[i].weight1, slots[i].weight2},
                                                         sample);
            wrong += !same(slots[i], want) || listed(run, slots[i], i, by_place) != conflicts[i];
        }
        CHECK(wrong == 0);
        for (const auto& rejected : conflicts) {
            ref::reject_all(rejected, twin.states);
        }
        CHECK(wrong_states(run, twin.states, by_place) == 0);
        next = control.next_sample;
    }
}

/// The rounds of a chunk, once the samples before it have rejected.
void step_through_candidates(DeviceRun& run, Twin& twin, const std::vector<std::uint32_t>& by_place,
                             CallHistogram* calls) {
    while (decide_batch(run)) {
        compare_batch(run, twin, by_place, calls);
        CHECK(wrong_states(run, twin.states, by_place) == 0);
    }
}

SamplerOptions counting_calls(SamplerOptions options) {
    options.count_calls = true;
    return options;
}

// The kernels as a CPU runs them, as a GPU does, and as a GPU would that rounds natively. Without
// calls of CheckStatus being counted, and with.
const SamplerOptions kOnCpu = counting_calls({{0, 0, 1, 0, Reads::texels}, Rounding::native});
const SamplerOptions kOnGpu{{0, 64, 32, 0, Reads::storage}, Rounding::emulated};
const SamplerOptions kPlain = counting_calls({{0, 64, 32, 0, Reads::storage}, Rounding::native});

/// Capacities so large that no disk overflows.
RunPlan roomy_plan(std::uint32_t slots) {
    RunPlan plan;
    plan.slots = slots;
    plan.window_capacity = 4096;
    plan.table_capacity = 8192;
    plan.list_capacity = 1024;
    return plan;
}

struct Chunk {
    std::uint32_t first, count;
};

/// The chunks must fit the plan's; without any, all candidates are one.
void step_through(const PreparedMesh& mesh, const SampleParams& params,
                  const SamplerOptions& options, const RunPlan& plan,
                  std::vector<Chunk> chunks = {}) {
    if (chunks.empty()) {
        chunks = {{0, expect(pool_size(mesh, params))}};
    }
    DeviceRun run(mesh, params, plan, options);
    std::vector<gpu::SampleRec> samples;
    CallHistogram calls;
    for (const Chunk& chunk : chunks) {
        run.set_chunk(chunk.first, chunk.count);
        Twin twin(mesh, params, run.plan().chain, chunk.first, chunk.count);
        run.begin();
        compare_candidates(run, twin);
        compare_bins(run, twin);
        const auto by_place = ranks_by_place(run);
        step_through_samples(run, twin, samples, by_place);
        step_through_candidates(run, twin, by_place, options.count_calls ? &calls : nullptr);
        run.finish();
        compare_samples(run, twin, samples);
    }
}

void step_through(const PreparedMesh& mesh, double count, const SamplerOptions& options,
                  std::uint32_t slots, const std::vector<Chunk>& chunks = {},
                  const RadiusField* radii = nullptr) {
    RunPlan plan = roomy_plan(slots);
    if (radii != nullptr) {
        plan.list_capacity = 65536; // A large disk meets many small ones.
    }
    step_through(mesh, params_for(mesh, count, 1, radii), options, plan, chunks);
}

} // namespace

TEST_SUITE("kernels") {
    TEST_CASE("step by step on a torus knot") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 16));
        for (const SamplerOptions& options : {kOnCpu, kOnGpu, kPlain}) {
            step_through(mesh, 400, options, 64);
        }
    }

    TEST_CASE("step by step on a cube of 12 triangles, many cells each") {
        const PreparedMesh mesh = prepared(builtin("cube", 1));
        for (const SamplerOptions& options : {kOnCpu, kOnGpu}) {
            step_through(mesh, 3000, options, 256);
        }
    }

    TEST_CASE("step by step where the surface is no manifold, one-sided or folded") {
        step_through(prepared(builtin("moebius", 8)), 300, kOnCpu, 32);
        step_through(prepared(builtin("folded-sheet", 8)), 300, kOnGpu, 32);
        if (const auto mesh = shared_mesh("meshes/cycloidal_43k.ply")) {
            step_through(prepared(*mesh), 1000, kOnCpu, 128);
        }
        if (const auto mesh = shared_mesh("meshes/tray_4k5.ply")) {
            step_through(prepared(*mesh), 1000, kOnGpu, 128);
        }
    }

    TEST_CASE("step by step with disks so large that every vertex is near") {
        step_through(prepared(builtin("icosphere", 3)), 1e-4, kOnCpu, 16);
        step_through(prepared(builtin("terrain", 16)), 1e-4, kOnCpu, 64);
    }

    TEST_CASE("step by step through chunks, each begun by the samples before it") {
        const PreparedMesh knot = prepared(builtin("torus-knot", 16));
        for (const SamplerOptions& options : {kOnCpu, kOnGpu}) {
            step_through(knot, 400, options, 64, {{0, 300}, {300, 1000}, {1300, 1}, {1301, 4000}});
        }
        step_through(prepared(builtin("folded-sheet", 8)), 300, kPlain, 7, {{0, 2000}, {2000, 99}});
    }

    TEST_CASE("step by step where candidates' indices end") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 3));
        step_through(mesh, 200, kOnCpu, 64, {{0, 150}, {kMostCandidates - 900, 900}});
    }

    TEST_CASE("step by step with lists of conflicts longer than a dispatch goes through") {
        const PreparedMesh mesh = prepared(builtin("terrain", 1));
        SampleParams params = params_for(mesh, 1); // A disk covers most of the square.
        params.pool_ratio = gpu::kListPerDispatch + 204;
        RunPlan plan = roomy_plan(gpu::kListPerDispatch + 204);
        plan.window_capacity = 256;
        plan.table_capacity = 256;
        plan.lanes = 16;
        plan.list_capacity = gpu::kListPerDispatch + 256;
        step_through(mesh, params, kOnCpu, plan);
    }

    TEST_CASE("step by step with radii that vary") {
        for (const char* const name : {"torus-knot", "moebius", "klein-bottle"}) {
            CAPTURE(name);
            const TestMesh shape = builtin(name, 12);
            const PreparedMesh mesh = prepared(shape);
            const RadiusField wavy = radius_field(mesh, wavy_factors(shape, 0.1));
            const RadiusField rough = radius_field(mesh, rough_factors(shape, 0.02));
            step_through(mesh, 600, kOnCpu, 64, {}, &wavy);
            step_through(mesh, 600, kOnGpu, 64, {}, &rough);
            step_through(mesh, 600, kOnCpu, 64, {{0, 500}, {500, 9000}}, &rough);
        }
        const TestMesh cube = builtin("cube", 1);
        const PreparedMesh mesh = prepared(cube);
        const RadiusField rough = radius_field(mesh, rough_factors(cube, 0.05));
        step_through(mesh, 3000, kOnCpu, 256, {}, &rough);
        step_through(mesh, 40, kPlain, 16, {}, &rough);
    }

    TEST_CASE("step by step with one candidate at a time") {
        step_through(prepared(builtin("icosphere", 2)), 60, kOnCpu, 1);
    }
}

} // namespace geodisk::test
