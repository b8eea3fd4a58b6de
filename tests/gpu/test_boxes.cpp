// Boxes of R^n: the kernels against their float twin bit for bit, and whole runs against sequential
// dart throwing in both precisions and by brute force.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <span>

#include <geodisk/runner.hpp>

#include "baselines/box.hpp"
#include "constants.h"
#include "device_run.hpp"
#include "engine/domain/box_grid.hpp"
#include "kernels/grid.hpp"
#include "kernels/resolve.hpp"
#include "support/device_abilities.hpp"

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

SampleSet sample_box(const BoxParams& box, const RunnerOptions& options = {},
                     const Context& context = shared_context()) {
    Runner runner = expect(Runner::create(context.device(), context.queue(), options));
    return expect(runner.sample_and_wait(expect(Domain::box(box))));
}

std::vector<double> coordinates(const BoxParams& box, std::span<const ref::BoxPoint> points) {
    const ref::BoxLattice lattice(box);
    std::vector<double> all;
    for (const ref::BoxPoint& point : points) {
        for (std::size_t axis = 0; axis < box.extents.size(); ++axis) {
            all.push_back(lattice.coordinate(axis, point));
        }
    }
    return all;
}

/// Returns what sequential dart throwing accepts, by the twin's grid.
template <class Real>
std::vector<double> sequential_set(const BoxParams& box) {
    const ref::BoxPool<Real> pool(box);
    std::vector<ref::BoxPoint> points;
    const std::uint32_t most = box.stop_count != 0 ? box.stop_count : kMaxCandidates;
    for (const std::uint32_t rank : ref::throw_darts(pool, most)) {
        points.push_back(pool.points[pool.places[rank]]);
    }
    return coordinates(box, points);
}

/// By distances of double coordinates, without the grid of the kernels.
std::vector<double> plain_set(const BoxParams& box) {
    return ref::throw_in_order({box.extents, box.is_periodic}, box.min_distance * (1 + kBoxGuard),
                               coordinates(box, ref::draw_in_box(box).points));
}

double smallest_distance2(const BoxParams& box, const SampleSet& set) {
    const ref::Box plain{box.extents, box.is_periodic};
    const std::size_t n = box.extents.size();
    const auto point = [&](std::size_t i) { return std::span(set.points).subspan(i * n, n); };
    double smallest = 1e300;
    for (std::size_t i = 0; i < set.points.size() / n; ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            smallest = std::min(smallest, plain.distance2(point(i), point(k)));
        }
    }
    return smallest;
}

/// Costs of the disks of a batch.
struct DiskTotals {
    std::uint64_t disks = 0, rows = 0, tested = 0;
    std::uint32_t max_conflicts = 0;
};

DiskTotals totals_of(const gpu::ControlRec& control) {
    const auto wide = [](std::uint32_t low, std::uint32_t high) {
        return std::uint64_t{high} << 32 | low;
    };
    return {control.disks, wide(control.windows_low, control.windows_high),
            wide(control.tested_low, control.tested_high), control.max_conflicts};
}

/// The twin's side of a run.
struct BoxTwin {
    BoxParams box;
    ref::BoxCandidates candidates;
    ref::BoxPool<float> pool;
    ref::BoxDetector<float> detector;
    std::vector<std::uint8_t> states; ///< By rank, as the words of the candidates.
    DiskTotals totals;

    /// `capacity` candidates have room on the device.
    BoxTwin(const BoxParams& of, std::uint32_t capacity)
        : box(of), candidates(ref::draw_in_box(of)),
          pool(ref::BoxLattice(of), candidates.points, kBoxGuard, capacity), detector(pool),
          states(candidates.words.size(), ref::kIdle) {}

    /// The conflicts of higher rank.
    std::vector<std::uint32_t> disk(std::uint32_t rank) {
        std::vector<std::uint32_t> conflicts;
        std::uint32_t all = 0;
        const ref::BoxDiskCount count = detector.run(
            pool.places[rank],
            [&](std::uint32_t place) { return states[pool.order[place]] <= ref::kActive; },
            [&](std::uint32_t place) {
                ++all;
                if (pool.order[place] > rank) {
                    conflicts.push_back(pool.order[place]);
                }
            });
        std::sort(conflicts.begin(), conflicts.end());
        ++totals.disks;
        totals.rows += count.rows;
        totals.tested += count.tested;
        totals.max_conflicts = std::max(totals.max_conflicts, all);
        return conflicts;
    }

    /// Idle candidates with words from `first` on and before `end`.
    std::vector<std::uint32_t> idle_between(std::uint32_t first, std::uint32_t end) const {
        std::vector<std::uint32_t> ranks;
        for (std::uint32_t rank = 0; rank < states.size(); ++rank) {
            const std::uint32_t word = candidates.words[rank];
            if (states[rank] == ref::kIdle && word >= first && word < end) {
                ranks.push_back(rank);
            }
        }
        return ranks;
    }

    /// Returns true if these are the words of the sample that a candidate becomes.
    bool is_sample(std::uint32_t rank, const gpu::SampleRec& record) const {
        std::vector<double> point(box.extents.size());
        sample_point(box.seed, draw_axes(box), record, point);
        const auto stage = std::bit_cast<std::uint32_t>(record.weight2);
        return record.order == candidates.words[rank] &&
               stage == record.order >> gpu::kPriorityBits &&
               point == coordinates(box, std::span(&candidates.points[rank], 1));
    }
};

/// The ranks of all places, by words and coordinates.
std::vector<std::uint32_t> compare_pool(const DeviceRun& run, const BoxTwin& twin) {
    const std::uint32_t count = run.control().drawn;
    REQUIRE(count == twin.states.size());
    std::map<std::pair<std::uint32_t, ref::BoxPoint>, std::uint32_t> ranks;
    for (std::uint32_t rank = 0; rank < count; ++rank) {
        ranks[{twin.candidates.words[rank], twin.candidates.points[rank]}] = rank;
    }
    REQUIRE(ranks.size() == count);
    const std::vector<std::uint32_t>& starts = twin.pool.starts;
    CHECK(run.read<std::uint32_t>(BufferRole::cells, starts.size()) == starts);
    const std::size_t dimension = twin.box.extents.size();
    const std::size_t capacity = run.constants().capacity;
    const auto points = run.read<std::uint32_t>(BufferRole::weights, capacity * dimension);
    const auto orders = run.read<std::uint32_t>(BufferRole::orders, count);
    const auto states = states_of(run, count);
    std::vector<std::uint32_t> by_place(count, kNoRank);
    std::uint32_t wrong = 0;
    for (std::uint32_t place = 0; place < count; ++place) {
        ref::BoxPoint point{};
        for (std::size_t i = 0; i < dimension; ++i) {
            point[i] = points[i * capacity + place];
        }
        const std::uint32_t head = twin.pool.table.head_of(point);
        wrong +=
            states[place] != PlaceState::idle || place < starts[head] || place >= starts[head + 1];
        const auto found = ranks.find({orders[place], point});
        REQUIRE(found != ranks.end());
        by_place[place] = found->second;
        ranks.erase(found);
    }
    CHECK(wrong == 0);
    return by_place;
}

/// Compares the batch that was decided last, which began at the order `first`.
void compare_batch(const DeviceRun& run, BoxTwin& twin, const std::vector<std::uint32_t>& by_place,
                   std::uint32_t first) {
    const gpu::ControlRec control = run.control();
    const auto batch = twin.idle_between(first, control.first_order);
    for (const std::uint32_t rank : batch) {
        twin.states[rank] = ref::kActive;
    }
    std::vector<std::vector<std::uint32_t>> conflicts;
    std::map<std::uint32_t, std::size_t> index_of;
    for (const std::uint32_t rank : batch) {
        index_of[rank] = conflicts.size();
        conflicts.push_back(twin.disk(rank));
    }
    const auto slots = slots_of(run);
    std::uint32_t wrong = 0;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        const gpu::SlotRec& slot = slots[i];
        const auto found =
            slot.place < by_place.size() ? index_of.find(by_place[slot.place]) : index_of.end();
        if (found == index_of.end()) {
            continue; // Of an earlier batch, or cut off.
        }
        const std::uint32_t rank = found->first;
        wrong += listed(run, i, rank, by_place) != conflicts[found->second];
        wrong += !twin.is_sample(rank, {slot.order, slot.face, std::bit_cast<float>(slot.weight1),
                                        std::bit_cast<float>(slot.weight2)});
        // A later slot may have held it when it was cut off an earlier batch.
        index_of.erase(found);
    }
    CHECK(wrong == 0);
    CHECK(index_of.empty());
    const DiskTotals totals = totals_of(control);
    CHECK(totals.disks == twin.totals.disks);
    CHECK(totals.rows == twin.totals.rows);
    CHECK(totals.tested == twin.totals.tested);
    CHECK(totals.max_conflicts == twin.totals.max_conflicts);
    ref::resolve_batch(batch, conflicts, twin.states);
}

void step_through(const BoxParams& box, const SamplerOptions& options, std::uint32_t slots) {
    RunPlan plan;
    plan.slots = slots;
    plan.list_capacity = 1024;
    plan.sample_capacity = 4096;
    plan.stages = ref::stages_in(box).pool_stages();
    DeviceRun run(box, plan, options);
    BoxTwin twin(box, run.constants().capacity);
    run.begin();
    const auto by_place = compare_pool(run, twin);
    for (std::uint32_t first = 0; decide_batch(run); first = run.control().first_order) {
        compare_batch(run, twin, by_place, first);
        CHECK(wrong_states(run, twin.states, by_place) == 0);
    }
    run.finish();
    std::vector<std::uint32_t> want;
    for (std::uint32_t rank = 0; rank < twin.states.size(); ++rank) {
        REQUIRE(twin.states[rank] > ref::kActive);
        if (twin.states[rank] == ref::kAccepted) {
            want.push_back(rank);
        }
    }
    REQUIRE(run.control().accepted == want.size());
    REQUIRE(run.control().ready == want.size());
    const auto samples = run.read<gpu::SampleRec>(BufferRole::samples, want.size());
    for (std::size_t i = 0; i < want.size(); ++i) {
        CHECK(twin.is_sample(want[i], samples[i]));
    }
}

/// As a CPU runs the kernels, as far as this device can.
SamplerOptions box_on_cpu() {
    const DeviceReport& report = shared_context().report();
    return {{0, 0, 1, 0, reads_of(report).back()}, roundings_of(report).back()};
}
const SamplerOptions kBoxOnGpu{{0, 64, 32, 0, Reads::storage}, Rounding::emulated};

} // namespace

TEST_SUITE("boxes") {
    TEST_CASE("step by step in one to six dimensions") {
        for (std::size_t n = 1; n <= 6; ++n) {
            CAPTURE(n);
            step_through(unit_box(n, n < 5 ? 300 : 120, n % 2 == 0), box_on_cpu(), 64);
            step_through(unit_box(n, n < 5 ? 300 : 120, n % 2 == 1), kBoxOnGpu, 32);
        }
    }

    TEST_CASE("step by step where cells are fewer than a disk reaches, or share heads") {
        for (const bool is_periodic : {false, true}) {
            CAPTURE(is_periodic);
            step_through(box_of({1, 0.2, 3}, 200, is_periodic), box_on_cpu(), 32);
            BoxParams shared = unit_box(6, 1000, is_periodic);
            shared.pool_ratio = 2; // A table that cannot hold all cells.
            step_through(shared, box_on_cpu(), 64);
        }
        // A side shorter than a step.
        step_through(box_of({1, 1e-11, 7}, 200, false), box_on_cpu(), 32);
        // One, two, three and four cells around.
        for (const double distance : {1.0, 0.9, 0.6, 0.45}) {
            BoxParams box = unit_box(2, 10, true);
            box.min_distance = distance;
            step_through(box, kBoxOnGpu, 8);
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
                    const SampleSet set = sample_box(box);
                    CHECK(set.points == sequential_set<float>(box));
                    CHECK(set.points == sequential_set<double>(box));
                    CHECK(set.points == plain_set(box));
                    CHECK(set.report.candidates == ref::draw_in_box(box).points.size());
                    CHECK(smallest_distance2(box, set) >= box.min_distance * box.min_distance);
                    CHECK(std::abs(static_cast<double>(set.points.size()) / static_cast<double>(n) -
                                   count) < 0.1 * count + 6);
                }
            }
        }
    }

    TEST_CASE("sides may differ a thousandfold and be of any unit") {
        for (const std::vector<double>& sides :
             {std::vector<double>{1, 1e-3}, {1e6, 1, 1e3}, {3e-9, 1e-9, 2e-9}, {5e20, 5e20}}) {
            CAPTURE(sides[0]);
            const BoxParams box = box_of(sides, 500, sides.back() > sides[0] / 2);
            const SampleSet set = sample_box(box);
            CHECK(set.points == sequential_set<float>(box));
            CHECK(set.points == plain_set(box));
            CHECK(smallest_distance2(box, set) >= box.min_distance * box.min_distance);
        }
    }

    TEST_CASE("a distance beyond the box leaves one sample") {
        for (const double distance : {1.8, 1e3, 1e300}) {
            BoxParams box = unit_box(3, 10, false);
            box.min_distance = distance;
            const std::vector<double> set = sample_box(box).points;
            CHECK(set.size() == 3);
            const auto candidates = ref::draw_in_box(box).points;
            CHECK(set == coordinates(box, std::span(candidates).first(1)));
        }
    }

    TEST_CASE("no tuning changes the set") {
        for (const std::size_t n : {2u, 5u}) {
            const BoxParams box = unit_box(n, 700, true);
            const auto want = sequential_set<float>(box);
            const auto same = [&](const RunnerOptions& options) {
                return sample_box(box, options).points == want;
            };
            for (const std::uint32_t slots : {kMinSlots, kMinSlots + 1, 1000u}) {
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
            for (const Reads reads : reads_of(shared_context().report())) {
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
                const std::uint32_t stages = ref::stages_in(box).pool_stages();
                CHECK(stages == 4);
                const auto want = sequential_set<double>(box);
                for (std::uint32_t at_once = 1; at_once <= stages; ++at_once) {
                    CAPTURE(at_once);
                    RunnerOptions options;
                    options.plan.stages = at_once;
                    const SampleSet set = sample_box(box, options);
                    CHECK(set.report.chunks == (stages + at_once - 1) / at_once);
                    CHECK(set.points == want);
                }
            }
        }
    }

    TEST_CASE("samples of chunks before overwrite no candidates") {
        const BoxParams box = unit_box(2, 1000, true);
        RunnerOptions options;
        options.plan.stages = 1;
        options.plan.slots = 4096; // More than the candidates leave of their buffers.
        CHECK(sample_box(box, options).points == sequential_set<float>(box));
    }

    // The samples of the chunks before start each chunk, with slots and lists that are too few.
    TEST_CASE("lists and samples that overflow in later chunks are enlarged") {
        const BoxParams box = unit_box(3, 500, true);
        RunnerOptions tight;
        tight.plan.stages = 1;
        tight.plan.slots = 30;
        tight.plan.list_capacity = 4;
        tight.plan.sample_capacity = 31;
        const SampleSet set = sample_box(box, tight);
        CHECK(set.report.regrown > 0);
        CHECK(set.report.plan.sample_capacity > 31);
        CHECK(set.points == sequential_set<float>(box));
    }

    TEST_CASE("lists and samples that overflow are enlarged") {
        const BoxParams box = unit_box(3, 500, false);
        RunnerOptions tight;
        tight.plan.list_capacity = 4;
        tight.plan.slots = 30;
        tight.plan.sample_capacity = 31;
        tight.pool_bytes = 1u << 16;
        const SampleSet set = sample_box(box, tight);
        CHECK(set.report.regrown > 0);
        CHECK(set.report.plan.sample_capacity > 31);
        CHECK(set.points == sequential_set<float>(box));
    }

    // Some 20,000 candidates in a disk: more iterations than the 65,535 after which lavapipe ends
    // all loops of a SIMD group.
    TEST_CASE("crowds of candidates in every cell") {
        BoxParams box = unit_box(2, 12, true);
        box.pool_ratio = 10000;
        const SampleSet set = sample_box(box);
        CHECK(set.report.tested / set.report.disks > 2000);
        CHECK(set.report.max_conflicts > 65535 / 6);
        CHECK(set.points == sequential_set<float>(box));
    }

    TEST_CASE("darts in a box, up to a number of them or of samples") {
        for (const std::size_t dimension : {1u, 2u, 3u, 5u}) {
            CAPTURE(dimension);
            BoxParams box = unit_box(dimension, 150, dimension == 3, 4);
            box.darts = 1'000;
            const SampleSet few = sample_box(box);
            CHECK(few.points == sequential_set<float>(box));
            CHECK(few.report.candidates == 1'000);
            box.darts = 20'000;
            const SampleSet many = sample_box(box);
            CHECK(many.points == sequential_set<float>(box));
            CHECK(many.report.candidates == 20'000);
            CHECK(many.report.chunks > 1);
            CHECK(many.points.size() > few.points.size());
            box.stop_count = static_cast<std::uint32_t>(many.points.size() / dimension / 2);
            const SampleSet half = sample_box(box);
            CHECK(half.points == sequential_set<float>(box));
            CHECK(half.points.size() == box.stop_count * dimension);
            CHECK(half.report.candidates < 20'000);
            // And of a pool.
            box.darts = 0;
            CHECK(sample_box(box).points == sequential_set<float>(box));
        }
    }

    TEST_CASE("few darts come of few candidates, however many samples there is room for") {
        BoxParams box = unit_box(2, 2.5e6, false, 9);
        box.darts = 200;
        const SampleSet few = sample_box(box);
        CHECK(few.points == sequential_set<float>(box));
        CHECK(few.report.candidates == 200);
        CHECK(few.points.size() == 400);
    }

    TEST_CASE("what a box cannot be is refused") {
        Context& context = shared_context();
        for (const std::size_t dimension : {0u, 7u}) {
            const auto refused = Domain::box(unit_box(dimension, 10, false));
            REQUIRE(!refused);
            CHECK(refused.error().status == Status::invalid_argument);
        }
        const Domain square = expect(Domain::box(unit_box(2, 10, false)));
        CHECK(square.dimension() == 2);
        RunnerOptions odd;
        odd.plan.list_capacity = 6;
        Runner uneven = expect(Runner::create(context.device(), context.queue(), odd));
        const auto refused = uneven.sample_and_wait(square);
        REQUIRE(!refused);
        CHECK(refused.error().status == Status::invalid_argument);
        Runner runner = expect(Runner::create(context.device(), context.queue()));
        const auto cancelled =
            runner.sample_and_wait(square, [](const Progress&) { return false; });
        REQUIRE(!cancelled);
        CHECK(cancelled.error().status == Status::cancelled);
    }

    TEST_CASE("distances for counts of boxes that cannot be are 0") {
        // All bits set as well: what is not initialized may look like that.
        for (const double side : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                                  std::bit_cast<double>(~std::uint64_t{0})}) {
            BoxParams box;
            box.extents = {side, 1};
            CHECK(distance_for_count(box, 100) == 0);
        }
        BoxParams none;
        none.extents.clear();
        CHECK(distance_for_count(none, 100) == 0);
    }

    TEST_CASE("a grid has at most 2^31 heads, however many candidates") {
        BoxParams box;
        box.extents = {1, 1};
        box.min_distance = 1e-5;
        const BoxGrid grid(box, draw_axes(box), 3'000'000'000, 1e-4);
        CHECK(grid.heads == 1u << 31);
    }

    TEST_CASE("the validation layer has nothing to say about a run") {
        ContextOptions options;
        options.validation = true;
        Context context = expect(Context::create(options));
        for (const Reads reads : reads_of(context.report())) {
            RunnerOptions tight;
            tight.sampler.tuning.reads = reads;
            tight.plan.list_capacity = 4;
            tight.plan.stages = 1;
            const BoxParams box = unit_box(3, 200, true);
            const SampleSet set = sample_box(box, tight, context);
            CHECK(set.report.regrown > 0);
            CHECK(set.points == sequential_set<float>(box));
        }
        for (const std::string& message : expect(context.validation_messages())) {
            MESSAGE(message);
        }
        CHECK(context.validation_message_count() == 0);
    }
}

} // namespace geodisk::test
