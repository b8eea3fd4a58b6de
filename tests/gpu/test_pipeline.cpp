// Whole runs against sequential dart throwing, set against set, and what must not change a set.
#include <doctest/doctest.h>

#include <cstdio>
#include <set>
#include <tuple>

#include "device_run.hpp"
#include "lib/frame.hpp"
#include "sets.hpp"
#include "support/device_abilities.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"
#include "support/replay.hpp"

namespace geodisk::test {
namespace {

/// The run returns what the float twin returns, and the truth differs by replayed ties at most.
SampleSet check_against_reference(const PreparedMesh& mesh, const SampleParams& params,
                                  const RunnerOptions& options = {}) {
    SampleSet set = sample(mesh, params, options);
    const double bound = set.report.plan.error_bound;
    CHECK(points_of(set) == float_set(mesh, params, bound));
    if (points_of(set) != double_set(mesh, params, bound)) {
        const ReplayReport report = replay(mesh, params, bound);
        CHECK(report.wrong == 0);
        CHECK(report.ties > 0);
        CHECK(report.accepted == set.samples.size());
    }
    return set;
}

void check_against_reference(const PreparedMesh& mesh, double count, std::uint64_t seed = 1,
                             const RadiusField* radii = nullptr) {
    check_against_reference(mesh, params_for(mesh, count, seed, radii));
}

} // namespace

TEST_SUITE("pipeline") {
    TEST_CASE("generated surfaces equal sequential dart throwing") {
        const std::pair<const char*, int> shapes[] = {
            {"cube", 1},          {"icosphere", 4},     {"torus-knot", 12},
            {"plate", 8},         {"folded-sheet", 16}, {"unfolded-sheet", 16},
            {"terrain", 48},      {"lattice", 1},       {"swiss-roll", 24},
            {"crossed-sheet", 8}, {"moebius", 8},       {"clifford-torus", 24},
            {"klein-bottle", 20}, {"veronese", 4},      {"tube", 6},
            {"cone", 8},          {"spike", 6},         {"drilled-plate", 3}};
        for (const auto& [name, resolution] : shapes) {
            const auto& shown = name; // Before Clang 16 lambdas capture no bindings.
            CAPTURE(shown);
            const PreparedMesh mesh = prepared(builtin(name, resolution));
            for (const double count : {30.0, 1000.0}) {
                CAPTURE(count);
                check_against_reference(mesh, count);
            }
        }
    }

    TEST_CASE("with radii that vary they equal sequential dart throwing") {
        const std::pair<const char*, int> shapes[] = {
            {"cube", 1},     {"icosphere", 4}, {"torus-knot", 12},  {"folded-sheet", 16},
            {"terrain", 48}, {"moebius", 8},   {"klein-bottle", 20}};
        for (const auto& [name, resolution] : shapes) {
            const auto& shown = name; // Before Clang 16 lambdas capture no bindings.
            CAPTURE(shown);
            const TestMesh shape = builtin(name, resolution);
            const PreparedMesh mesh = prepared(shape);
            const RadiusField wavy = radius_field(mesh, wavy_factors(shape, 0.1));
            const RadiusField rough = radius_field(mesh, rough_factors(shape, 0.01));
            const RadiusField density = density_field(mesh, rough_density(shape));
            for (const double count : {30.0, 1000.0}) {
                CAPTURE(count);
                check_against_reference(mesh, count, 1, &wavy);
                check_against_reference(mesh, count, 2, &rough);
                check_against_reference(mesh, count, 3, &density);
            }
        }
    }

    TEST_CASE("disks of very many windows or crossings are trimmed, whatever the tuning") {
        struct Case {
            TestMesh mesh;
            double min_distance;
        };
        for (const Case& c : {Case{builtin("tube", 6), 1}, Case{builtin("spike", 24), 0.05},
                              Case{tetrahedra(3, 0.15), 1.7}}) {
            CAPTURE(c.mesh.face_count());
            const PreparedMesh mesh = prepared(c.mesh);
            const RadiusField rough = radius_field(mesh, rough_factors(c.mesh, 0.7));
            for (const RadiusField* radii : {static_cast<const RadiusField*>(nullptr), &rough}) {
                SampleParams params;
                params.min_distance = c.min_distance;
                params.radii = radii;
                RunnerOptions by_lanes; // As on a CPU: no disk is left to a work group.
                by_lanes.plan.disks_by = DisksBy::lanes;
                by_lanes.plan.large_after = ~std::uint32_t{0};
                const SampleSet base = check_against_reference(mesh, params, by_lanes);
                CHECK(base.report.plan.trims);
                RunnerOptions few = by_lanes;
                few.plan.slots = 8;
                few.plan.lanes = 2;
                few.plan.step_budget = 7;
                RunnerOptions from_the_start = by_lanes;
                from_the_start.plan.trims = true;
                from_the_start.plan.slots = 500;
                from_the_start.plan.window_capacity = 2;
                from_the_start.sampler.tuning.pool_block = 4;
                from_the_start.sampler.tuning.reads = Reads::storage;
                from_the_start.sampler.rounding = Rounding::emulated;
                RunnerOptions by_groups; // Until a disk has too many windows for that.
                by_groups.plan.disks_by = DisksBy::groups;
                const SampleSet at_last_by_lanes = sample(mesh, params, by_groups);
                CHECK(points_of(at_last_by_lanes) == points_of(base));
                RunnerOptions large_by_groups; // As well, and never of their own accord on a CPU.
                large_by_groups.plan.large_groups = 1;
                CHECK(points_of(sample(mesh, params, large_by_groups)) == points_of(base));
                for (const RunnerOptions& options : {few, from_the_start}) {
                    const SampleSet set = sample(mesh, params, options);
                    CHECK(points_of(set) == points_of(base));
                    CHECK(set.report.longest_chain == base.report.longest_chain);
                    CHECK(set.report.plan.error_bound == base.report.plan.error_bound);
                }
            }
        }
    }

    TEST_CASE("radii may differ a thousandfold") {
        const TestMesh shape = builtin("terrain", 48);
        const PreparedMesh mesh = prepared(shape);
        std::vector<double> factors(shape.vertex_count(), 1.0);
        factors[shape.vertex_count() / 2] = RadiusField::kMinFactor;
        const RadiusField pit = radius_field(mesh, factors);
        check_against_reference(mesh, 500, 1, &pit);
    }

    // But for pairs that lie between the two guards; these sets have none.
    TEST_CASE("the largest radius everywhere gives the set of one radius") {
        const TestMesh shape = builtin("torus-knot", 12);
        const PreparedMesh mesh = prepared(shape);
        const RadiusField ones = radius_field(mesh, std::vector<double>(shape.vertex_count(), 1.0));
        SampleParams params = params_for(mesh, 300);
        const auto want = points_of(sample(mesh, params));
        params.radii = &ones;
        CHECK(points_of(sample(mesh, params)) == want);
    }

    TEST_CASE("a runner serves one radius and varying ones") {
        const TestMesh shape = builtin("icosphere", 2);
        const PreparedMesh mesh = prepared(shape);
        const RadiusField radii = radius_field(mesh, wavy_factors(shape, 0.5));
        const SampleParams one = params_for(mesh, 50);
        const SampleParams varying = params_for(mesh, 50, 1, &radii);
        Context& context = shared_context();
        Runner runner = expect(Runner::create(context.device(), context.queue()));
        for (int i = 0; i < 2; ++i) { // Compiled, and as compiled before.
            CHECK(points_of(expect(runner.sample_and_wait(mesh, one))) ==
                  float_set(mesh, one, ref::frame_of(mesh, one).first_error()));
            CHECK(points_of(expect(runner.sample_and_wait(mesh, varying))) ==
                  float_set(mesh, varying, ref::frame_of(mesh, varying).first_error()));
        }
        const PreparedMesh other = prepared(builtin("icosphere", 3));
        const auto refused = pool_size(other, varying);
        REQUIRE_FALSE(refused);
        CHECK(refused.error().message ==
              "the radii are of a mesh with 320 faces, this one has 1280");
    }

    TEST_CASE("edge lengths alone give the set of the coordinates they come from") {
        const TestMesh mesh = builtin("klein-bottle", 20);
        const PreparedMesh model = prepared(mesh);
        std::vector<double> lengths;
        for (const HalfEdge& edge : model.half_edges()) {
            lengths.push_back(edge.length);
        }
        const PreparedMesh surface =
            expect(PreparedMesh::prepare({mesh.triangles, lengths, mesh.vertex_count()}));
        check_against_reference(surface, 1000);
        CHECK(points_of(sample(surface, params_for(model, 1000))) ==
              points_of(sample(model, params_for(model, 1000))));
    }

    TEST_CASE("a cube of 12 triangles with 20,000 samples") {
        check_against_reference(prepared(builtin("cube", 1)), 20000);
    }

    TEST_CASE("fewer samples than slots, down to one") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 3));
        check_against_reference(mesh, 3);
        // However large the distance: a connected surface has room for one.
        for (const double factor : {2.0, 100.0, 1e12, 1e300}) {
            CAPTURE(factor);
            SampleParams params;
            params.min_distance = factor * mesh.statistics().diagonal;
            CHECK(sample(mesh, params).samples.size() == 1);
        }
    }

    TEST_CASE("sheets folded, rolled up, crossing themselves and laid flat give the same set") {
        const std::tuple<const char*, const char*, int> sheets[] = {
            {"folded-sheet", "unfolded-sheet", 16},
            {"swiss-roll", "unrolled-sheet", 24},
            {"crossed-sheet", "uncrossed-sheet", 8}};
        for (const auto& [bent, flat, resolution] : sheets) {
            const auto& shown = bent; // Before Clang 16 lambdas capture no bindings.
            CAPTURE(shown);
            const PreparedMesh mesh = prepared(builtin(flat, resolution));
            const SampleParams params = params_for(mesh, 2000);
            const auto a = sample(prepared(builtin(bent, resolution)), params);
            const auto b = sample(mesh, params);
            CHECK(points_of(a) == points_of(b));
        }
    }

    TEST_CASE("weights sum to one") {
        const PreparedMesh mesh = prepared(builtin("terrain", 32));
        const SampleSet set = sample(mesh, params_for(mesh, 2000));
        std::uint32_t wrong = 0;
        for (const Sample& s : set.samples) {
            wrong += s.weights[0] + s.weights[1] + s.weights[2] != 1.0f || s.weights[0] < 0 ||
                     s.face >= mesh.face_count();
        }
        CHECK(wrong == 0);
    }

    TEST_CASE("seeds differ and repeat") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 3));
        const auto first = points_of(sample(mesh, params_for(mesh, 500, 1)));
        CHECK(first == points_of(sample(mesh, params_for(mesh, 500, 1))));
        CHECK(first != points_of(sample(mesh, params_for(mesh, 500, std::uint64_t{1} << 32 | 1))));
    }
}

TEST_SUITE("invariance") {
    TEST_CASE("no tuning changes the set") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 16));
        const SampleParams params = params_for(mesh, 500);
        const RunnerOptions plain;
        const SampleSet base = sample(mesh, params, plain);
        const auto want = points_of(base);
        CHECK(want == float_set(mesh, params, base.report.plan.error_bound));

        const auto same = [&](const RunnerOptions& options) {
            return points_of(sample(mesh, params, options)) == want;
        };
        std::set<std::uint64_t> windows; // By groups of any size.
        for (const std::uint32_t slots : {8u, 9u, 64u, 1000u}) {
            RunnerOptions options;
            options.plan.slots = slots;
            CAPTURE(slots);
            CHECK(same(options));
        }
        for (const std::uint32_t local_size : {1u, 8u, 32u, 128u}) {
            RunnerOptions options;
            options.sampler.tuning.local_size = local_size;
            options.sampler.tuning.slot_local_size = local_size;
            CAPTURE(local_size);
            CHECK(same(options));
        }
        for (const std::uint32_t lanes : {1u, 3u, 8u, 500u}) {
            RunnerOptions options;
            options.plan.lanes = lanes;
            CAPTURE(lanes);
            CHECK(same(options));
        }
        for (const std::uint32_t steps : {1u, 7u, 1000000u}) {
            RunnerOptions options;
            options.plan.step_budget = steps;
            CAPTURE(steps);
            CHECK(same(options));
            options.plan.disks_by = DisksBy::groups;
            CHECK(same(options));
        }
        for (const std::uint32_t group_lanes : {1u, 4u, 8u, 64u}) {
            RunnerOptions options;
            options.plan.disks_by = DisksBy::groups;
            options.plan.lanes = group_lanes;
            options.sampler.tuning.group_lanes = group_lanes;
            CAPTURE(group_lanes);
            const SampleSet set = sample(mesh, params, options);
            CHECK(points_of(set) == want);
            windows.insert(set.report.windows);
        }
        CHECK(windows.size() == 1);
        for (const std::uint32_t stages : {1u, 2u, 3u}) {
            RunnerOptions options;
            options.plan.stages = stages;
            CAPTURE(stages);
            CHECK(same(options));
        }
        for (const std::uint32_t idle : {1u, 10u, 300u}) {
            RunnerOptions options;
            options.plan.idle_capacity = idle;
            CAPTURE(idle);
            CHECK(same(options));
        }
        for (const std::uint32_t items : {1u, 2000u, 20000u}) {
            RunnerOptions options;
            options.plan.dispatch_items = items;
            CAPTURE(items);
            CHECK(same(options));
        }
        RunnerOptions timed;
        timed.time_stages = true;
        CHECK(same(timed));
        for (const std::uint32_t block : {1u, 4u, 128u}) {
            RunnerOptions options;
            options.sampler.tuning.pool_block = block;
            CAPTURE(block);
            CHECK(same(options));
        }
        for (const std::uint32_t batches : {1u, 1000u}) {
            RunnerOptions options;
            options.sampler.tuning.batches = batches;
            CAPTURE(batches);
            CHECK(same(options));
        }
        for (const Reads reads : reads_of(shared_context().report())) {
            RunnerOptions options;
            options.sampler.tuning.reads = reads;
            CHECK(same(options));
        }
        for (const Events events : {Events::nearest, Events::oldest}) {
            RunnerOptions options;
            options.sampler.events = events;
            CHECK(same(options));
            options.plan.window_capacity = 2;
            CHECK(same(options));
        }
        RunnerOptions emulated;
        emulated.sampler.rounding = Rounding::emulated;
        CHECK(same(emulated));
        RunnerOptions tight;
        tight.plan.window_capacity = 2;
        tight.plan.table_capacity = 4;
        tight.plan.list_capacity = 4;
        CHECK(same(tight));
        tight.plan.disks_by = DisksBy::groups;
        tight.pool_bytes = 1u << 20;
        const SampleSet regrown = sample(mesh, params, tight);
        CHECK(points_of(regrown) == want);
        CHECK(regrown.report.regrown > 0);
    }

    TEST_CASE("counting trips tells how long lanes wait, and changes no set") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 16));
        const SampleParams params = params_for(mesh, 500);
        const SampleSet uncounted = sample(mesh, params);
        CHECK(uncounted.report.trips == 0);
        CHECK(uncounted.report.lane_trips == 0);
        RunnerOptions options;
        options.sampler.count_trips = true;
        options.sampler.tuning.slot_local_size = 2; // Less than any subgroup with more than one.
        const SampleSet counted = sample(mesh, params, options);
        CHECK(points_of(counted) == points_of(uncounted));
        CHECK(counted.report.trips >= counted.report.windows);
        CHECK(counted.report.lane_trips > counted.report.trips);
        CHECK(counted.report.lane_trips < 2 * counted.report.trips);
        options.plan.lanes = 1; // The other lane of its group waits all the time.
        const SampleSet alone = sample(mesh, params, options);
        CHECK(alone.report.lane_trips == 2 * alone.report.trips);
    }

    TEST_CASE("no tuning changes the set of varying radii") {
        const TestMesh shape = builtin("torus-knot", 12);
        const PreparedMesh mesh = prepared(shape);
        const RadiusField rough = radius_field(mesh, rough_factors(shape, 0.05));
        const SampleParams params = params_for(mesh, 500, 1, &rough);
        const SampleSet base = sample(mesh, params);
        CHECK(points_of(base) == float_set(mesh, params, base.report.plan.error_bound));
        RunnerOptions tight;
        tight.plan.slots = 9;
        tight.plan.lanes = 3;
        tight.plan.step_budget = 7;
        tight.plan.window_capacity = 2;
        tight.plan.table_capacity = 4;
        tight.plan.list_capacity = 4;
        RunnerOptions wide;
        wide.plan.slots = 1000;
        wide.sampler.tuning.local_size = 128;
        wide.sampler.tuning.slot_local_size = 32;
        wide.sampler.tuning.pool_block = 4;
        wide.sampler.tuning.reads = Reads::storage;
        wide.sampler.rounding = Rounding::emulated;
        wide.sampler.events = Events::nearest;
        for (const RunnerOptions& options : {tight, wide}) {
            CHECK(points_of(sample(mesh, params, options)) == points_of(base));
        }
    }

    // The slots decide which losers get a disk. The guard, which follows from the chains met, must
    // not depend on them.
    TEST_CASE("no tuning changes the guard of long chains") {
        const PreparedMesh mesh = prepared(needle_disk(1'200));
        const SampleParams params = params_for(mesh, 60);
        const SampleSet base = sample(mesh, params);
        CHECK(base.report.guard > 0x1p-13);
        CHECK(points_of(base) == float_set(mesh, params, base.report.plan.error_bound));
        for (const std::uint32_t slots : {8u, 16u, 1000u}) {
            RunnerOptions options;
            options.plan.slots = slots;
            const SampleSet set = sample(mesh, params, options);
            CHECK(set.report.guard == base.report.guard);
            CHECK(points_of(set) == points_of(base));
        }
    }
}

TEST_SUITE("meshes") {
    TEST_CASE("real meshes equal sequential dart throwing with radii that vary") {
        for (const NamedMesh& one : meshes_like({"meshes/bunny_69k.ply", "meshes/gargoyle_52k.obj",
                                                 "meshes/fandisk_13k.obj", "meshes/tray_4k5.ply",
                                                 "meshes/cycloidal_43k.ply"})) {
            CAPTURE(one.name);
            const PreparedMesh mesh = prepared(one.mesh);
            const RadiusField wavy = radius_field(mesh, wavy_factors(one.mesh, 0.1, 4));
            const RadiusField rough = radius_field(mesh, rough_factors(one.mesh, 0.1));
            for (const double count : {300.0, 5000.0}) {
                CAPTURE(count);
                check_against_reference(mesh, count, 1, &wavy);
                check_against_reference(mesh, count, 2, &rough);
            }
        }
    }

    TEST_CASE("real meshes equal sequential dart throwing") {
        for (const NamedMesh& one : meshes_like(
                 {"meshes/bunny_69k.ply", "meshes/gargoyle_52k.obj", "meshes/fandisk_13k.obj",
                  "meshes/rocker_arm_20k.obj", "meshes/tray_4k5.ply", "meshes/cycloidal_43k.ply",
                  "meshes/teapot_6k.obj", "meshes/human_man_14k.obj"})) {
            CAPTURE(one.name);
            const PreparedMesh mesh = prepared(one.mesh);
            for (const double count : {300.0, 1000.0, 10000.0}) {
                CAPTURE(count);
                std::printf("%s at %.0f\n", one.name.c_str(), count);
                std::fflush(stdout);
                check_against_reference(mesh, count);
            }
        }
    }
}

} // namespace geodisk::test
