// Samples that are given: they come first, reject, and nothing else changes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "gpu/device_run.hpp"
#include "gpu/sets.hpp"
#include "support/geodesic_query.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {
namespace {

using Records = std::vector<gpu::SampleRec>;

Records samples_of(const DeviceRun& run) {
    return run.read<gpu::SampleRec>(BufferRole::samples, run.control().ready);
}

Records run_with(DeviceRun& run, const Records& given) {
    expect(run.job().set_existing(given));
    run.write<gpu::SampleRec>(BufferRole::samples, given);
    REQUIRE(run.follow_all().next == Next::complete);
    return samples_of(run);
}

bool same(const gpu::SampleRec& a, const gpu::SampleRec& b) {
    return a.face == b.face && a.weight1 == b.weight1 && a.weight2 == b.weight2;
}

/// A run goes on from its own first samples as it did.
void check_prefixes(DeviceRun& run) {
    const Records whole = run_with(run, {});
    REQUIRE(whole.size() > 20);
    for (const std::size_t given : {std::size_t{1}, std::size_t{17}, whole.size()}) {
        CAPTURE(given);
        const auto end = whole.begin() + static_cast<std::ptrdiff_t>(given);
        const Records first(whole.begin(), end);
        const Records all = run_with(run, first);
        REQUIRE(all.size() == whole.size());
        CHECK(std::equal(all.begin(), all.end(), whole.begin(), same));
        CHECK(std::memcmp(all.data(), first.data(), given * sizeof first[0]) == 0);
        // They stay for another seed, of which they are no candidates, and then for this one.
        run.job().set_seed(2);
        REQUIRE(run.follow_all().next == Next::complete);
        const Records other = samples_of(run);
        CHECK(std::equal(first.begin(), first.end(), other.begin(), same));
        run.job().set_seed(1);
        REQUIRE(run.follow_all().next == Next::complete);
        CHECK(samples_of(run).size() == whole.size());
    }
    const Records none = run_with(run, {});
    REQUIRE(none.size() == whole.size());
    CHECK(std::memcmp(none.data(), whole.data(), none.size() * sizeof none[0]) == 0);
}

/// The same samples, but for their orders.
Points points_in(const Records& samples) {
    Points points;
    for (const gpu::SampleRec& sample : samples) {
        points.push_back({sample.face, sample.weight1, sample.weight2});
    }
    return points;
}

const TestMesh& settled_knot() {
    static const TestMesh kMesh = builtin("torus-knot", 8);
    return kMesh;
}

/// Samples of another seed, farther apart.
Records sparse_samples(const PreparedMesh& mesh, double count) {
    DeviceRun run(mesh, params_for(mesh, count, 5));
    REQUIRE(run.follow_all().next == Next::complete);
    return samples_of(run);
}

} // namespace

TEST_SUITE("existing_records") {
    TEST_CASE("the first samples of a run, settled, give the rest of it") {
        const PreparedMesh mesh = prepared(settled_knot());
        const RadiusField radii = radius_field(mesh, wavy_factors(settled_knot(), 0.3));
        for (const RadiusField* const field : {static_cast<const RadiusField*>(nullptr), &radii}) {
            SampleParams params = params_for(mesh, 100, 1, field);
            RunPlan plan;
            DeviceRun whole(mesh, params, plan);
            check_prefixes(whole);
            plan.slots = kMinSlots;
            plan.stages = 1;
            DeviceRun parts(mesh, params, plan);
            parts.set_plan(tightened(parts.plan()));
            check_prefixes(parts);
        }
    }

    TEST_CASE("in boxes and by distances through space as well") {
        BoxParams box{{1, 1}, true};
        box.min_distance = distance_for_count(box, 100);
        box.seed = 1;
        RunPlan plan;
        plan.stages = 2;
        DeviceRun in_box(box, plan);
        const Records whole = run_with(in_box, {});
        const Records first(whole.begin(), whole.begin() + 17);
        const Records all = run_with(in_box, first);
        REQUIRE(all.size() == whole.size());
        CHECK(std::equal(all.begin(), all.end(), whole.begin(), same));

        const PreparedMesh mesh = prepared(settled_knot());
        DeviceRun in_space(
            expect(Domain::surface_in_space(settled_knot().view(), mesh, params_for(mesh, 100),
                                            Metric::euclidean)),
            plan);
        check_prefixes(in_space);
    }

    TEST_CASE("samples of another run come first, and none is too close to them") {
        const PreparedMesh mesh = prepared(settled_knot());
        const SampleParams params = params_for(mesh, 150);
        const Records given = sparse_samples(mesh, 40);
        REQUIRE(given.size() > 20);
        RunPlan plan;
        plan.slots = 16; // They come in several batches,
        plan.stages = 2; // and again for the second stages.
        DeviceRun run(mesh, params, plan);
        const Records all = run_with(run, given);
        CHECK(points_in(all) == set_after(mesh, params, run.plan().error_bound, points_in(given)));
        CHECK(all.size() > given.size() + 50);
        std::vector<Point> added;
        for (std::size_t i = given.size(); i < all.size(); ++i) {
            added.push_back({all[i].face, all[i].weight1, all[i].weight2});
        }
        GeodesicQuery<double> query(prepared(settled_knot()), params.min_distance, added,
                                    tight_tolerances());
        std::size_t close = 0;
        for (const gpu::SampleRec& sample : given) {
            const auto distances = query.from({sample.face, sample.weight1, sample.weight2});
            close += static_cast<std::size_t>(
                std::count_if(distances.begin(), distances.end(),
                              [&](double d) { return d < params.min_distance; }));
        }
        CHECK(close == 0);
    }

    TEST_CASE("existing samples count, and ask for room and for a guard that is wide enough") {
        const PreparedMesh mesh = prepared(settled_knot());
        SampleParams params = params_for(mesh, 150);
        const Records given = sparse_samples(mesh, 40);
        const auto count = static_cast<std::uint32_t>(given.size());
        params.stop_count = count + 10;
        RunPlan plan;
        plan.slots = 10;
        plan.sample_capacity = count + 5;
        DeviceRun run(mesh, params, plan);
        const Records all = run_with(run, given);
        CHECK(run.plan().sample_capacity > count + 10);
        CHECK(points_in(all) == set_after(mesh, params, run.plan().error_bound, points_in(given)));
        CHECK(all.size() == count + 10);
        params.stop_count = count;
        expect(run.job().renew(expect(Domain::surface(mesh, params)), run.plan()));
        expect(run.job().set_existing(given));
        const Advice last = run.follow_all();
        CHECK(last.next == Next::complete);
        CHECK(last.ready == count);
        CHECK(last.candidates == 0);
        CHECK(run.count());

        // No candidate is left, so all window chains are of existing samples.
        params.stop_count = 0;
        plan = {};
        plan.error_bound = 0x1p-30;
        DeviceRun narrow(mesh, params, plan);
        Records full = sparse_samples(mesh, 1'500);
        expect(narrow.job().set_existing(std::span(full).first(100)));
        narrow.write<gpu::SampleRec>(BufferRole::samples, std::span(full).first(100));
        narrow.job().set_end_order(1);
        CHECK(narrow.follow_all().next == Next::paused);
        CHECK(narrow.control().disks >= 100);
        CHECK(narrow.control().longest_chain > 0);
    }

    TEST_CASE("samples settled in place of many existing ones have disks of their own") {
        const PreparedMesh mesh = prepared(settled_knot());
        SampleParams params = params_for(mesh, 60);
        const Records few = sparse_samples(mesh, 20);
        DeviceRun plain(mesh, params);
        const Records expected = run_with(plain, few);
        const std::vector<Sample> many = sample(mesh, params_for(mesh, 1'000, 7)).samples;
        params.existing = many;
        RunPlan plan;
        plan.sample_capacity = 4'000;
        DeviceRun run(mesh, params, plan);
        const Records all = run_with(run, few);
        REQUIRE(all.size() == expected.size());
        CHECK(std::equal(all.begin(), all.end(), expected.begin(), same));
    }

    TEST_CASE("existing samples that cannot be are refused, by their number") {
        const PreparedMesh mesh = prepared(settled_knot());
        DeviceRun run(mesh, params_for(mesh, 100));
        const auto refused = [&](const gpu::SampleRec& wrong, const char* text) {
            const Records given = {{0, 3, 0.25f, 0.5f}, wrong};
            const auto set = run.job().set_existing(given);
            REQUIRE_FALSE(set);
            CHECK(set.error().status == Status::invalid_argument);
            CHECK(set.error().message.find("existing sample 1") != std::string::npos);
            CHECK(set.error().message.find(text) != std::string::npos);
        };
        refused({0, mesh.face_count(), 0, 0}, "is in face");
        refused({0, 0, 0.75f, 0.5f}, "weights");
        refused({0, 0, -0.25f, 0.5f}, "weights");
        refused({0, 0, 0x1p-25f, 0.5f}, "weights");
        refused({0, 0, std::numeric_limits<float>::quiet_NaN(), 0}, "weights");
        SampleParams classed = params_for(mesh, 100);
        const std::vector<float> factors(4, 1);
        classed.class_factors = factors;
        DeviceRun with_classes(mesh, classed);
        CHECK(with_classes.job().set_existing(Records{{1, 3, 0.25f, 0.5f}}));
        const auto third = with_classes.job().set_existing(Records{{2, 3, 0.25f, 0.5f}});
        REQUIRE_FALSE(third);
        CHECK(third.error().message == "existing sample 0 has class 2, but there are 2");
        const auto many = run.job().set_existing(Records(run.plan().sample_capacity + 1));
        REQUIRE_FALSE(many);
        CHECK(many.error().message.find("sample_capacity") != std::string::npos);
        REQUIRE(run.follow_all().next == Next::complete);
        CHECK(run.control().settled == 0);
    }
}

} // namespace geodisk::test
