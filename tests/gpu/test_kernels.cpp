// Kernels of surfaces against their float twins, bit for bit, step by step through whole runs.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <tuple>

#include "constants.h"
#include "device_run.hpp"
#include "engine/capacity.hpp"
#include "engine/domain/stages.hpp"
#include "engine/domain/tolerances.hpp"
#include "kernels/detect.hpp"
#include "kernels/group_detect.hpp"
#include "kernels/pool.hpp"
#include "kernels/resolve.hpp"
#include "sets.hpp"
#include "support/device_abilities.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {
namespace {

/// The twin's side of some stages: the same candidates, and states by rank.
struct Twin {
    ref::Surface<float> surface;
    ref::Pool<float> pool;
    std::vector<std::uint32_t> ranks; ///< By place of the twin.
    ref::Detector<float> detector;
    ref::GroupDetector<float> group;
    DisksBy disks_by;
    std::vector<std::uint8_t> states;

    Twin(const PreparedMesh& mesh, const SampleParams& params, const RunPlan& plan,
         std::uint32_t first, std::uint32_t count)
        : Twin(mesh, params, ref::frame_of(mesh, params).tolerances(plan.error_bound), first,
               count) {
        disks_by = plan.disks_by;
    }

    Twin(const PreparedMesh& mesh, const SampleParams& params, const ref::Tolerances& tolerances,
         std::uint32_t first, std::uint32_t count)
        : surface(mesh, params), pool(ref::draw_stages(surface, params, first, count)),
          ranks(pool.ranks()), detector(surface, pool.bins, tolerances, tolerances.limit),
          group(surface, pool.bins, tolerances, tolerances.limit), disks_by(DisksBy::lanes),
          states(pool.size(), ref::kIdle) {}

    template <class Wanted, class Hit>
    ref::DiskCount run(const ref::FacePoint<float>& source, Wanted&& wanted, Hit&& hit) {
        return disks_by == DisksBy::groups ? group.run(source, wanted, hit)
                                           : detector.run(source, wanted, hit);
    }

    /// `conflicts` are those of higher rank, `above` the active ones of lower rank.
    ref::DiskCount disk(std::uint32_t rank, std::vector<std::uint32_t>& conflicts,
                        std::vector<std::uint32_t>& above) {
        const auto count = run(
            pool.candidate(rank),
            [&](std::uint32_t q) { return ranks[q] != rank && states[ranks[q]] <= ref::kActive; },
            [&](std::uint32_t q, float) {
                // An active one of lower rank reports itself what it decides about this one.
                (ranks[q] > rank ? conflicts : above).push_back(ranks[q]);
            });
        std::sort(conflicts.begin(), conflicts.end());
        std::sort(above.begin(), above.end());
        above.erase(std::unique(above.begin(), above.end()), above.end());
        return count;
    }

    /// The idle candidates in the disk of a sample of earlier stages.
    ref::DiskCount disk(const gpu::SampleRec& sample, std::vector<std::uint32_t>& conflicts) {
        const auto count = run(
            {sample.face, sample.weight1, sample.weight2},
            [&](std::uint32_t q) { return states[ranks[q]] == ref::kIdle; },
            [&](std::uint32_t q, float) { conflicts.push_back(ranks[q]); });
        std::sort(conflicts.begin(), conflicts.end());
        return count;
    }

    gpu::SampleRec sample(std::uint32_t rank) const {
        const ref::FacePoint<float> point = pool.candidate(rank);
        return {pool.word(rank), point.face, point.weight1, point.weight2};
    }

    /// The idle ones from one order up to another, as ranks.
    std::vector<std::uint32_t> idle(std::uint32_t first_order, std::uint32_t end_order) const {
        std::vector<std::uint32_t> found;
        for (std::uint32_t rank = 0; rank < states.size(); ++rank) {
            const std::uint32_t order = pool.word(rank);
            if (order >= first_order && order < end_order && states[rank] == ref::kIdle) {
                found.push_back(rank);
            }
        }
        return found;
    }
};

bool same(const gpu::SampleRec& a, const gpu::SampleRec& b) {
    return a.order == b.order && a.face == b.face && a.weight1 == b.weight1 &&
           a.weight2 == b.weight2;
}

gpu::SampleRec record_of(const gpu::SlotRec& slot) {
    return {slot.order, slot.face, std::bit_cast<float>(slot.weight1),
            std::bit_cast<float>(slot.weight2)};
}

/// Costs and findings of all disks so far.
struct Totals {
    std::uint64_t disks = 0, windows = 0, tested = 0;
    std::uint32_t max_waiting = 0, max_vertices = 0;

    void add(const ref::DiskCount& disk) {
        ++disks;
        windows += disk.windows;
        tested += disk.tested;
        max_waiting = std::max(max_waiting, disk.max_waiting);
        max_vertices = std::max(max_vertices, disk.vertices);
    }
    void compare(const gpu::ControlRec& control) const {
        CHECK(control.disks == disks);
        CHECK((std::uint64_t{control.windows_high} << 32 | control.windows_low) == windows);
        CHECK((std::uint64_t{control.tested_high} << 32 | control.tested_low) == tested);
        CHECK(control.max_waiting == max_waiting);
        CHECK(control.max_vertices == max_vertices);
    }
};

float weight(std::uint32_t steps) {
    return static_cast<float>(steps) * 0x1p-24f;
}

/// Compares what was drawn, cell by cell: within one the order is that of atomics. Returns the rank
/// at each place.
std::vector<std::uint32_t> compare_candidates(const DeviceRun& run, const Twin& twin) {
    const std::uint32_t count = twin.pool.size();
    REQUIRE(run.control().drawn == count);
    const auto states = states_of(run, count);
    const auto weights = run.read<std::uint32_t>(BufferRole::weights, std::size_t{2} * count);
    const auto orders = run.read<std::uint32_t>(BufferRole::orders, count);
    const std::vector<std::uint32_t>& starts = twin.pool.bins.starts;
    if (run.constants().cells != 0) {
        CHECK(run.read<std::uint32_t>(BufferRole::cells, starts.size()) == starts);
    }
    std::vector<std::uint32_t> ranks(count);
    std::uint32_t wrong = 0;
    using Key = std::tuple<std::uint32_t, float, float, std::uint32_t>;
    for (std::size_t c = 0; c + 1 < starts.size(); ++c) {
        std::vector<Key> here, want;
        for (std::uint32_t place = starts[c]; place < starts[c + 1]; ++place) {
            wrong += states[place] != PlaceState::idle;
            here.emplace_back(orders[place], weight(weights[std::size_t{2} * place]),
                              weight(weights[std::size_t{2} * place + 1]), place);
            const ref::FacePoint<float>& point = twin.pool.bins.points[place];
            want.emplace_back(twin.pool.words[place], point.weight1, point.weight2, place);
        }
        std::sort(here.begin(), here.end());
        std::sort(want.begin(), want.end());
        for (std::size_t i = 0; i < here.size(); ++i) {
            wrong += std::get<0>(here[i]) != std::get<0>(want[i]) ||
                     std::get<1>(here[i]) != std::get<1>(want[i]) ||
                     std::get<2>(here[i]) != std::get<2>(want[i]);
            ranks[std::get<3>(here[i])] = twin.ranks[std::get<3>(want[i])];
        }
    }
    CHECK(wrong == 0);
    return ranks;
}

/// Compares what the disks of one batch found and took, from `first_order` on.
void compare_batch(const DeviceRun& run, Twin& twin, std::uint32_t first_order,
                   const std::vector<std::uint32_t>& by_place, Totals& totals) {
    const gpu::ControlRec control = run.control();
    // A batch may be shorter than there are slots, but never skips a rank.
    const auto batch = twin.idle(first_order, control.first_order);
    REQUIRE(batch.size() <= run.plan().slots);
    const std::vector<gpu::SlotRec> slots = slots_of(run);
    for (const std::uint32_t rank : batch) {
        twin.states[rank] = ref::kActive;
    }
    std::vector<std::vector<std::uint32_t>> conflicts(batch.size());
    std::vector<std::vector<std::uint32_t>> above(batch.size());
    std::uint32_t wrong = 0;
    for (std::size_t i = 0; i < batch.size(); ++i) {
        const gpu::SampleRec want = twin.sample(batch[i]);
        const auto found = std::find_if(slots.begin(), slots.end(), [&](const gpu::SlotRec& slot) {
            return same(record_of(slot), want) && by_place[slot.place] == batch[i];
        });
        REQUIRE(found != slots.end());
        const ref::DiskCount disk = twin.disk(batch[i], conflicts[i], above[i]);
        totals.add(disk);
        const auto index = static_cast<std::size_t>(found - slots.begin());
        wrong += found->longest_chain != disk.chain;
        wrong += listed(run, index, batch[i], by_place) != conflicts[i];
    }
    CHECK(wrong == 0);
    ref::resolve_batch(batch, conflicts, twin.states);
    totals.compare(control);
}

/// Adds the samples of the stages to those before.
void compare_samples(const DeviceRun& run, const Twin& twin, std::vector<gpu::SampleRec>& want) {
    const gpu::ControlRec control = run.control();
    const auto samples = run.read<gpu::SampleRec>(BufferRole::samples, control.accepted);
    for (std::uint32_t rank = 0; rank < twin.states.size(); ++rank) {
        if (twin.states[rank] == ref::kAccepted) {
            want.push_back(twin.sample(rank));
        }
    }
    CHECK(control.ready == control.accepted);
    REQUIRE(samples.size() == want.size());
    std::uint32_t wrong = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        wrong += !same(samples[i], want[i]);
    }
    CHECK(wrong == 0);
}

/// The first rounds of later stages: batches of the samples so far, whose disks reject and do
/// nothing else.
void step_through_samples(DeviceRun& run, Twin& twin, const std::vector<gpu::SampleRec>& settled,
                          const std::vector<std::uint32_t>& by_place, Totals& totals) {
    for (std::uint32_t next = 0; next < settled.size();) {
        REQUIRE(decide_batch(run));
        const gpu::ControlRec control = run.control();
        REQUIRE(control.settled == settled.size());
        REQUIRE(control.next_sample > next);
        CHECK(control.first_order == 0);
        CHECK(control.accepted == settled.size());
        const std::vector<gpu::SlotRec> slots = slots_of(run);
        const std::size_t used = control.next_sample - next;
        std::vector<std::vector<std::uint32_t>> conflicts(used);
        std::uint32_t wrong = 0;
        for (std::size_t i = 0; i < used; ++i) {
            const gpu::SampleRec& sample = settled[next + i];
            const ref::DiskCount disk = twin.disk(sample, conflicts[i]);
            totals.add(disk);
            wrong += slots[i].place != gpu::kNoPlace || !same(record_of(slots[i]), sample) ||
                     slots[i].longest_chain != disk.chain ||
                     listed(run, i, kNoRank, by_place) != conflicts[i];
        }
        CHECK(wrong == 0);
        totals.compare(control);
        for (const auto& rejected : conflicts) {
            ref::reject_all(rejected, twin.states);
        }
        CHECK(wrong_states(run, twin.states, by_place) == 0);
        next = control.next_sample;
    }
}

/// The rounds of some stages, once the samples before them have rejected.
void step_through_candidates(DeviceRun& run, Twin& twin, const std::vector<std::uint32_t>& by_place,
                             Totals& totals) {
    std::uint32_t first_order = 0;
    while (decide_batch(run)) {
        compare_batch(run, twin, first_order, by_place, totals);
        CHECK(wrong_states(run, twin.states, by_place) == 0);
        first_order = run.control().first_order;
    }
    CHECK(twin.idle(0, gpu::kNoOrder).empty());
    // An active one's order was its slot meanwhile.
    const auto orders = run.read<std::uint32_t>(BufferRole::orders, by_place.size());
    std::uint32_t wrong = 0;
    for (std::size_t place = 0; place < orders.size(); ++place) {
        wrong += orders[place] != twin.pool.word(by_place[place]);
    }
    CHECK(wrong == 0);
}

// The kernels as a CPU runs them, as a GPU does, and as a GPU would that rounds natively, as far as
// this device can.
SamplerOptions on_cpu() {
    const DeviceReport& report = shared_context().report();
    return {{0, 0, 1, 0, reads_of(report).back()}, roundings_of(report).back(), Events::oldest};
}
const SamplerOptions kOnGpu{{0, 64, 32, 0, Reads::storage}, Rounding::emulated, Events::nearest};
SamplerOptions on_native_gpu() {
    return {{0, 64, 32, 0, Reads::storage},
            roundings_of(shared_context().report()).back(),
            Events::nearest};
}

/// Capacities so large that no disk overflows, for so few lanes that every device binds the pool.
RunPlan roomy_plan(std::uint32_t slots) {
    RunPlan plan;
    plan.slots = slots;
    plan.lanes = std::min(slots, 16u);
    plan.window_capacity = 4096;
    plan.table_capacity = 8192;
    plan.list_capacity = 1024;
    return plan;
}

struct PoolPart {
    std::uint32_t first, count; ///< Stages.
};

/// Without parts, all stages at once.
void step_through_by(DisksBy disks_by, const PreparedMesh& mesh, const SampleParams& params,
                     const SamplerOptions& options, RunPlan plan, std::vector<PoolPart> parts) {
    CAPTURE(disks_by == DisksBy::groups);
    expect(pool_size(mesh, params));
    if (parts.empty()) {
        parts = {{0, stages_of(mesh, params).pool_stages()}};
    }
    plan.disks_by = disks_by;
    if (disks_by == DisksBy::groups) {
        plan.trims = false;
        plan.window_capacity = 16384;
        plan.list_capacity = std::max(plan.list_capacity, 4096u); // A path found is a conflict.
        plan.lanes = 2; // Every device binds so large a pool.
    }
    DeviceRun run(mesh, params, plan, options);
    std::vector<gpu::SampleRec> samples;
    Totals totals;
    for (const PoolPart& part : parts) {
        run.set_stages(part.first, part.count);
        Twin twin(mesh, params, run.plan(), part.first, part.count);
        if (options.events == Events::oldest) {
            twin.detector.take_oldest_first();
        }
        run.begin();
        const auto by_place = compare_candidates(run, twin);
        step_through_samples(run, twin, samples, by_place, totals);
        step_through_candidates(run, twin, by_place, totals);
        run.finish();
        compare_samples(run, twin, samples);
    }
}

/// Disks by lanes and, where the driver compiles them, by groups.
void step_through(const PreparedMesh& mesh, const SampleParams& params,
                  const SamplerOptions& options, const RunPlan& plan,
                  const std::vector<PoolPart>& parts = {}) {
    step_through_by(DisksBy::lanes, mesh, params, options, plan, parts);
    if (compiles_groups(shared_context().report())) {
        step_through_by(DisksBy::groups, mesh, params, options, plan, parts);
    }
}

void step_through(const PreparedMesh& mesh, double count, const SamplerOptions& options,
                  std::uint32_t slots, const std::vector<PoolPart>& parts = {},
                  const RadiusField* radii = nullptr) {
    RunPlan plan = roomy_plan(slots);
    plan.trims = options.events == Events::oldest; // The kernels for it here, the others there.
    if (radii != nullptr) {
        plan.list_capacity = 65536; // A large disk meets many small ones.
    }
    step_through(mesh, params_for(mesh, count, 1, radii), options, plan, parts);
}

} // namespace

TEST_SUITE("kernels") {
    TEST_CASE("step by step on a torus knot") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 16));
        for (const SamplerOptions& options : {on_cpu(), kOnGpu, on_native_gpu()}) {
            step_through(mesh, 400, options, 64);
        }
    }

    TEST_CASE("step by step on a cube of 12 triangles, many cells each") {
        const PreparedMesh mesh = prepared(builtin("cube", 1));
        for (const SamplerOptions& options : {on_cpu(), kOnGpu}) {
            step_through(mesh, 3000, options, 256);
        }
    }

    TEST_CASE("step by step with faces of one cell beside faces of many") {
        TestMesh shape = builtin("cube", 1);
        const TestMesh ball = builtin("icosphere", 3);
        const std::uint32_t first = shape.vertex_count();
        shape.positions.insert(shape.positions.end(), ball.positions.begin(), ball.positions.end());
        for (const std::uint32_t vertex : ball.triangles) {
            shape.triangles.push_back(first + vertex);
        }
        const PreparedMesh mesh = prepared(shape);
        const SampleParams params = params_for(mesh, 600);
        CHECK_FALSE(has_small_faces(mesh, params));
        for (const SamplerOptions& options : {on_cpu(), kOnGpu}) {
            step_through(mesh, params, options, roomy_plan(64));
        }
        CHECK(has_small_faces(prepared(ball), params_for(prepared(ball), 600)));
    }

    TEST_CASE("step by step where the surface is no manifold, one-sided or folded") {
        step_through(prepared(builtin("moebius", 8)), 300, on_cpu(), 32);
        step_through(prepared(builtin("folded-sheet", 8)), 300, kOnGpu, 32);
        for (const NamedMesh& gear : meshes_like({"meshes/cycloidal_43k.ply"})) {
            step_through(prepared(gear.mesh), 1000, on_cpu(), 128);
        }
        for (const NamedMesh& tray : meshes_like({"meshes/tray_4k5.ply"})) {
            step_through(prepared(tray.mesh), 1000, kOnGpu, 128);
        }
    }

    TEST_CASE("step by step with disks so large that every vertex is near") {
        step_through(prepared(builtin("icosphere", 3)), 1e-4, on_cpu(), 16);
        step_through(prepared(builtin("terrain", 16)), 1e-4, on_cpu(), 64);
    }

    TEST_CASE("step by step with disks that begin again and trim their windows") {
        RunPlan plan = roomy_plan(32);
        plan.trims = true;
        plan.window_capacity = 16384;
        plan.list_capacity = 16384; // A candidate is listed for every path found.
        struct Case {
            TestMesh mesh;
            double count;
        };
        for (const Case& c : {Case{builtin("tube", 6), 2}, Case{builtin("cone", 8), 5},
                              Case{builtin("spike", 6), 10}, Case{tetrahedra(6, 0.15), 300},
                              Case{tetrahedra(4, 0), 100}}) {
            const PreparedMesh mesh = prepared(c.mesh);
            for (const SamplerOptions& options : {on_cpu(), kOnGpu, on_native_gpu()}) {
                step_through_by(DisksBy::lanes, mesh, params_for(mesh, c.count), options, plan, {});
            }
        }
    }

    TEST_CASE("step by step through stages, each begun by the samples before it") {
        const PreparedMesh knot = prepared(builtin("torus-knot", 16));
        for (const SamplerOptions& options : {on_cpu(), kOnGpu}) {
            step_through(knot, 400, options, 64, {{0, 1}, {1, 2}, {3, 1}});
        }
        step_through(prepared(builtin("folded-sheet", 8)), 300, on_native_gpu(), 9,
                     {{0, 3}, {3, 1}});
        step_through(prepared(builtin("cube", 1)), 2000, on_cpu(), 64, {{0, 1}, {1, 3}});
    }

    TEST_CASE("step by step where the numbers of stages end") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 3));
        step_through(mesh, 200, on_cpu(), 64, {{0, 1}, {0xfffffff0, 2}});
    }

    TEST_CASE("step by step with candidates that faces have by keys of the caller") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 12));
        std::vector<std::uint32_t> keys;
        for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
            keys.push_back(0xffffffffu - 7 * face);
        }
        SampleParams params = params_for(mesh, 400);
        params.face_keys = keys;
        step_through(mesh, params, on_cpu(), roomy_plan(64));
        step_through(mesh, params, kOnGpu, roomy_plan(64));
    }

    TEST_CASE("step by step with lists of conflicts longer than a dispatch goes through") {
        const PreparedMesh mesh = prepared(builtin("terrain", 1));
        SampleParams params = params_for(mesh, 1); // A disk covers most of the square.
        params.pool_ratio = gpu::kListPerDispatch + 1500;
        RunPlan plan = roomy_plan(gpu::kListPerDispatch + 512);
        plan.window_capacity = 256;
        plan.table_capacity = 256;
        plan.lanes = 16;
        plan.list_capacity = gpu::kListPerDispatch + 2048;
        step_through(mesh, params, on_cpu(), plan);
    }

    TEST_CASE("step by step with radii that vary") {
        for (const char* const name : {"torus-knot", "moebius", "klein-bottle"}) {
            CAPTURE(name);
            const TestMesh shape = builtin(name, 12);
            const PreparedMesh mesh = prepared(shape);
            const RadiusField wavy = radius_field(mesh, wavy_factors(shape, 0.1));
            const RadiusField rough = radius_field(mesh, rough_factors(shape, 0.02));
            step_through(mesh, 600, on_cpu(), 64, {}, &wavy);
            step_through(mesh, 600, kOnGpu, 64, {}, &rough);
            step_through(mesh, 600, on_cpu(), 64, {{0, 1}, {1, 3}}, &rough);
        }
        const TestMesh cube = builtin("cube", 1);
        const PreparedMesh mesh = prepared(cube);
        const RadiusField rough = radius_field(mesh, rough_factors(cube, 0.05));
        step_through(mesh, 3000, on_cpu(), 256, {}, &rough);
        step_through(mesh, 40, on_native_gpu(), 16, {}, &rough);
        const RadiusField density = density_field(mesh, {0, 1, 1e-7, 2, 0, 900, 30, 1});
        step_through(mesh, 1000, on_cpu(), 256, {}, &density);
        step_through(mesh, 1000, kOnGpu, 256, {}, &density);
        step_through(mesh, 40, on_native_gpu(), 16, {}, &density);
    }

    TEST_CASE("step by step with as few candidates at a time as may be") {
        step_through(prepared(builtin("icosphere", 2)), 60, on_cpu(), kMinSlots);
    }
}

} // namespace geodisk::test
