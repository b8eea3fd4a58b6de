// Boxes of R^n: the kernels against their float twin bit for bit, and whole runs against sequential
// dart throwing in both precisions and by brute force.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "baselines/box_darts.hpp"
#include "constants.h"
#include "device_run.hpp"
#include "kernels/grid.hpp"
#include "kernels/resolve.hpp"
#include "kernels/select.hpp"

namespace geodisk::test {
namespace {

BoxParams box_of(std::vector<double> extents, double count, bool is_periodic,
                 std::uint64_t seed = 1) {
    BoxParams box;
    box.extents = std::move(extents);
    box.is_periodic = is_periodic;
    box.seed = seed;
    box.min_distance = distance_for_count(box, count);
    return box;
}

BoxParams unit_box(std::size_t dimension, double count, bool is_periodic, std::uint64_t seed = 1) {
    return box_of(std::vector<double>(dimension, 1.0), count, is_periodic, seed);
}

BoxSampleSet sample(const BoxParams& box, const RunnerOptions& options = {},
                    const Context& context = shared_context()) {
    BoxRunner runner =
        expect(BoxRunner::create(context.device(), context.queue(),
                                 static_cast<std::uint32_t>(box.extents.size()), options));
    return expect(runner.sample_and_wait(box));
}

template <class Real>
std::vector<std::uint32_t> sequential_set(const BoxParams& box) {
    return ref::throw_darts(ref::BoxPool<Real>(box, expect(pool_size(box))));
}

/// By distances of double coordinates, without the grid of the kernels.
std::vector<double> plain_set(const BoxParams& box) {
    const std::size_t n = box.extents.size();
    std::vector<double> pool(n * expect(pool_size(box)));
    for (std::size_t i = 0; i < pool.size() / n; ++i) {
        candidate_point(box, static_cast<std::uint32_t>(i), std::span(pool).subspan(i * n, n));
    }
    return ref::throw_in_order({box.extents, box.is_periodic}, box.min_distance * (1 + kBoxGuard),
                               pool);
}

double smallest_distance2(const BoxParams& box, const BoxSampleSet& set) {
    const ref::Box plain{box.extents, box.is_periodic};
    const std::size_t n = set.dimension;
    const auto point = [&](std::size_t i) { return std::span(set.points).subspan(i * n, n); };
    double smallest = 1e300;
    for (std::size_t i = 0; i < set.candidates.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            smallest = std::min(smallest, plain.distance2(point(i), point(k)));
        }
    }
    return smallest;
}

/// The twin's side of a run.
struct Twin {
    ref::BoxPool<float> pool;
    ref::BoxDetector<float> detector;
    std::vector<std::uint8_t> states;

    explicit Twin(const BoxParams& box)
        : pool(box, expect(pool_size(box))), detector(pool),
          states(pool.points.size(), gpu::kIdle) {}

    ref::BoxDiskCount disk(std::uint32_t rank, std::vector<std::uint32_t>& conflicts) {
        const auto count = detector.run(
            rank, [&](std::uint32_t q) { return states[q] <= gpu::kActive; },
            [&](std::uint32_t q) {
                if (q > rank) {
                    conflicts.push_back(q);
                }
            });
        std::sort(conflicts.begin(), conflicts.end());
        return count;
    }
};

void compare_pool(const DeviceRun& run, const Twin& twin, const BoxParams& box,
                  const std::vector<std::uint32_t>& places) {
    const std::size_t count = twin.pool.points.size();
    REQUIRE(run.candidates() == count);
    CHECK(run.read<std::uint32_t>(BufferRole::cells, twin.pool.starts.size()) == twin.pool.starts);
    const auto points = run.read<std::uint32_t>(BufferRole::weights, count * box.extents.size());
    const auto states = run.read<std::uint32_t>(BufferRole::states, count);
    std::uint32_t wrong = 0;
    for (std::uint32_t rank = 0; rank < count; ++rank) {
        const ref::BoxPoint& want = twin.pool.points[rank];
        const std::uint32_t head = twin.pool.table.head_of(want);
        for (std::size_t i = 0; i < box.extents.size(); ++i) {
            wrong += points[i * count + places[rank]] != want[i];
        }
        wrong += states[places[rank]] != gpu::kIdle;
        wrong +=
            places[rank] < twin.pool.starts[head] || places[rank] >= twin.pool.starts[head + 1];
    }
    CHECK(wrong == 0);
}

void compare_batch(const DeviceRun& run, Twin& twin, const std::vector<std::uint32_t>& by_place) {
    const gpu::ControlRec control = run.control();
    const auto slots = run.read<gpu::SlotRec>(BufferRole::slots, control.slots_used);
    const auto batch = ref::select_idle(twin.states, control.batch_rank, control.slots_used);
    for (const std::uint32_t rank : batch) {
        twin.states[rank] = gpu::kActive;
    }
    std::vector<std::vector<std::uint32_t>> conflicts(batch.size());
    std::uint32_t wrong = 0;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        REQUIRE(slots[i].rank == batch[i]);
        const ref::BoxDiskCount want = twin.disk(batch[i], conflicts[i]);
        wrong += slots[i].tested != want.tested || slots[i].pushed != want.rows ||
                 listed(run, slots[i], i, by_place) != conflicts[i];
    }
    CHECK(wrong == 0);
    ref::resolve_batch(batch, conflicts, twin.states);
}

void step_through(const BoxParams& box, const SamplerOptions& options, std::uint32_t slots) {
    RunPlan plan;
    plan.slots = slots;
    plan.list_capacity = 1024;
    DeviceRun run(box, plan, options);
    Twin twin(box);
    run.begin();
    const auto places = run.read<std::uint32_t>(BufferRole::places, run.candidates());
    const auto by_place = ranks_by_place(run);
    compare_pool(run, twin, box, places);
    while (decide_batch(run)) {
        compare_batch(run, twin, by_place);
        CHECK(wrong_states(run, twin.states, by_place) == 0);
    }
    run.finish();
    std::vector<std::uint32_t> want;
    for (std::uint32_t rank = 0; rank < twin.states.size(); ++rank) {
        if (twin.states[rank] == gpu::kAccepted) {
            want.push_back(rank);
        }
    }
    const auto samples = run.read<gpu::SampleRec>(BufferRole::samples, run.control().accepted);
    REQUIRE(samples.size() == want.size());
    for (std::size_t i = 0; i < want.size(); ++i) {
        CHECK(samples[i].rank == want[i]);
    }
}

const SamplerOptions kOnCpu{{0, 0, 1, 0, Reads::texels}, Rounding::native};
const SamplerOptions kOnGpu{{0, 64, 32, 0, Reads::storage}, Rounding::emulated};

} // namespace

TEST_SUITE("boxes") {
    TEST_CASE("step by step in one to six dimensions") {
        for (std::size_t n = 1; n <= 6; ++n) {
            CAPTURE(n);
            step_through(unit_box(n, n < 5 ? 300 : 120, n % 2 == 0), kOnCpu, 64);
            step_through(unit_box(n, n < 5 ? 300 : 120, n % 2 == 1), kOnGpu, 32);
        }
    }

    TEST_CASE("step by step where cells are fewer than a disk reaches, or share heads") {
        for (const bool is_periodic : {false, true}) {
            CAPTURE(is_periodic);
            step_through(box_of({1, 0.2, 3}, 200, is_periodic), kOnCpu, 32);
            BoxParams shared = unit_box(6, 1000, is_periodic);
            shared.pool_ratio = 2; // A table that cannot hold all cells.
            step_through(shared, kOnCpu, 64);
        }
        // One, two, three and four cells around.
        for (const double distance : {1.0, 0.9, 0.6, 0.45}) {
            BoxParams box = unit_box(2, 10, true);
            box.min_distance = distance;
            step_through(box, kOnGpu, 8);
        }
    }

    TEST_CASE("sets equal sequential dart throwing") {
        for (std::size_t n = 1; n <= 6; ++n) {
            for (const bool is_periodic : {false, true}) {
                for (const double count : {20.0, 2000.0}) {
                    CAPTURE(n);
                    CAPTURE(is_periodic);
                    CAPTURE(count);
                    const BoxParams box = unit_box(n, count, is_periodic, n);
                    const BoxSampleSet set = sample(box);
                    CHECK(set.candidates == sequential_set<float>(box));
                    CHECK(set.candidates == sequential_set<double>(box));
                    CHECK(set.points == plain_set(box));
                    CHECK(smallest_distance2(box, set) >= box.min_distance * box.min_distance);
                    CHECK(std::abs(static_cast<double>(set.candidates.size()) - count) <
                          0.1 * count + 6);
                }
            }
        }
    }

    TEST_CASE("sides may differ a thousandfold and be of any unit") {
        for (const std::vector<double>& sides :
             {std::vector<double>{1, 1e-3}, {1e6, 1, 1e3}, {3e-9, 1e-9, 2e-9}, {5e20, 5e20}}) {
            CAPTURE(sides[0]);
            const BoxParams box = box_of(sides, 500, sides.back() > sides[0] / 2);
            const BoxSampleSet set = sample(box);
            CHECK(set.candidates == sequential_set<float>(box));
            CHECK(set.points == plain_set(box));
            CHECK(smallest_distance2(box, set) >= box.min_distance * box.min_distance);
        }
    }

    TEST_CASE("a distance beyond the box leaves one sample") {
        for (const double distance : {1.8, 1e3, 1e300}) {
            BoxParams box = unit_box(3, 10, false);
            box.min_distance = distance;
            CHECK(sample(box).candidates == std::vector<std::uint32_t>{0});
        }
    }

    TEST_CASE("no tuning changes the set") {
        for (const std::size_t n : {2u, 5u}) {
            const BoxParams box = unit_box(n, 700, true);
            const auto want = sequential_set<float>(box);
            const auto same = [&](const RunnerOptions& options) {
                return sample(box, options).candidates == want;
            };
            for (const std::uint32_t slots : {1u, 7u, 1000u}) {
                RunnerOptions options;
                options.plan.slots = slots;
                CHECK(same(options));
            }
            for (const std::uint32_t steps : {3u, 1000000u}) {
                RunnerOptions options;
                options.plan.step_budget = steps;
                CHECK(same(options));
            }
            for (const std::uint32_t local_size : {1u, 128u}) {
                RunnerOptions options;
                options.sampler.tuning.local_size = local_size;
                options.sampler.tuning.slot_local_size = local_size;
                options.time_stages = true;
                CHECK(same(options));
            }
            for (const Reads reads : {Reads::storage, Reads::texels}) {
                RunnerOptions options;
                options.sampler.tuning.reads = reads;
                options.sampler.tuning.pool_block = 4;
                CHECK(same(options));
            }
        }
    }

    TEST_CASE("nor do the chunks that candidates come in") {
        for (const bool is_periodic : {false, true}) {
            for (const std::size_t n : {1u, 2u, 5u}) {
                CAPTURE(n);
                const BoxParams box = unit_box(n, 300, is_periodic);
                const std::uint32_t candidates = expect(pool_size(box));
                const auto want = sequential_set<double>(box);
                for (const std::uint32_t chunk : {97u, 1'000u, candidates - 1, candidates}) {
                    CAPTURE(chunk);
                    RunnerOptions options;
                    options.plan.chunk = chunk;
                    const BoxSampleSet set = sample(box, options);
                    CHECK(set.report.chunks == (candidates + chunk - 1) / chunk);
                    CHECK(set.candidates == want);
                }
            }
        }
    }

    // The samples of the chunks before start each chunk, with slots and lists that are too few.
    TEST_CASE("lists and samples that overflow in later chunks are enlarged") {
        const BoxParams box = unit_box(3, 500, true);
        RunnerOptions tight;
        tight.plan.chunk = 3'000;
        tight.plan.slots = 30;
        tight.plan.list_capacity = 4;
        tight.plan.sample_capacity = 10;
        const BoxSampleSet set = sample(box, tight);
        CHECK(set.report.regrown > 0);
        CHECK(set.candidates == sequential_set<float>(box));
    }

    TEST_CASE("lists and samples that overflow are enlarged") {
        const BoxParams box = unit_box(3, 500, false);
        RunnerOptions tight;
        tight.plan.list_capacity = 4;
        tight.plan.sample_capacity = 10;
        tight.pool_bytes = 1u << 16;
        const BoxSampleSet set = sample(box, tight);
        CHECK(set.report.regrown > 0);
        CHECK(set.candidates == sequential_set<float>(box));
    }

    // Some 20,000 candidates in a disk: more iterations than the 65,535 after which lavapipe ends
    // all loops of a SIMD group.
    TEST_CASE("crowds of candidates in every cell") {
        BoxParams box = unit_box(2, 12, true);
        box.pool_ratio = 10000;
        const BoxSampleSet set = sample(box);
        CHECK(set.report.tested / set.report.disks > 2000);
        CHECK(set.report.most_conflicts > 65535 / 6);
        CHECK(set.candidates == sequential_set<float>(box));
    }

    TEST_CASE("what a box cannot be is refused") {
        Context& context = shared_context();
        CHECK(!BoxRunner::create(context.device(), context.queue(), 0));
        CHECK(!BoxRunner::create(context.device(), context.queue(), 7));
        BoxRunner runner = expect(BoxRunner::create(context.device(), context.queue(), 2));
        CHECK(runner.dimension() == 2);
        const auto other = runner.sample_and_wait(unit_box(3, 10, false));
        REQUIRE(!other);
        CHECK(other.error().message == "the box has 3 sides, and the runner was made for 2");
        RunnerOptions odd;
        odd.plan.list_capacity = 6;
        BoxRunner uneven = expect(BoxRunner::create(context.device(), context.queue(), 2, odd));
        const auto refused = uneven.sample_and_wait(unit_box(2, 10, false));
        REQUIRE(!refused);
        CHECK(refused.error().status == Status::invalid_argument);
        const auto cancelled =
            runner.sample_and_wait(unit_box(2, 10, false), [](const Progress&) { return false; });
        REQUIRE(!cancelled);
        CHECK(cancelled.error().status == Status::cancelled);
    }

    TEST_CASE("the validation layer has nothing to say about a run") {
        ContextOptions options;
        options.validation = true;
        Context context = expect(Context::create(options));
        for (const Reads reads : {Reads::storage, Reads::texels}) {
            RunnerOptions tight;
            tight.sampler.tuning.reads = reads;
            tight.plan.list_capacity = 4;
            tight.plan.chunk = 1'000;
            const BoxParams box = unit_box(3, 200, true);
            const BoxSampleSet set = sample(box, tight, context);
            CHECK(set.report.regrown > 0);
            CHECK(set.candidates == sequential_set<float>(box));
        }
        for (const std::string& message : expect(context.validation_messages())) {
            MESSAGE(message);
        }
        CHECK(context.validation_message_count() == 0);
    }
}

} // namespace geodisk::test
