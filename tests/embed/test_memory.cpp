// Host computations, without a device and with one, while memory runs out: an error or the same
// answer, and no exception ever leaves a function.
#include <doctest/doctest.h>

#include <cstdint>

#include <geodisk/context.hpp>
#include <geodisk/domain.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/sampler.hpp>

#include "gpu/device_run.hpp"
#include "gpu/sets.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"
#include "support/runtime_memory.hpp"
#include "watched_bench.hpp"

namespace geodisk::test {
namespace {

/// Fails the allocations of `work`, which returns a Result, one after the other.
template <class Work>
void sweep(const Work& work) {
    std::uint32_t after = 0;
    for (bool fails = true; fails; ++after) {
        CAPTURE(after);
        bool succeeds = false;
        Status status = Status::ok;
        {
            const FailingNew failing(after);
            const auto result = work();
            fails = failing.has_failed();
            succeeds = static_cast<bool>(result);
            status = succeeds ? Status::ok : result.error().status;
        }
        REQUIRE(succeeds != fails);
        CHECK(status == (fails ? Status::out_of_host_memory : Status::ok));
    }
    CHECK(after > 1); // Something was allocated.
}

} // namespace

TEST_CASE("memory: functions without a device survive its lack") {
    const TestMesh shape = builtin("torus-knot", 3);
    const PreparedMesh mesh = prepared(shape);
    const std::vector<double> factors = wavy_factors(shape, 0.5);
    const RadiusField radii = radius_field(mesh, factors);
    const SampleParams params = params_for(mesh, 50);
    // Beyond all distances of the mesh.
    SampleParams far = params;
    far.min_distance = 1e6;
    BoxParams box{{1, 1, 1}, true};
    box.min_distance = 0.1;
    sweep([&] { return PreparedMesh::prepare(shape.view()); });
    sweep([&] { return RadiusField::prepare(mesh, factors); });
    for (const SampleParams& of : {params, far, params_for(mesh, 50, 1, &radii)}) {
        sweep([&] { return Domain::surface(mesh, of); });
    }
    for (const Metric metric : {Metric::euclidean, Metric::approximate}) {
        sweep([&] { return Domain::surface_in_space(shape.view(), mesh, params, metric); });
    }
    sweep([&] { return Domain::box(box); });
    sweep([&] { return pool_size(mesh, far); });
}

TEST_CASE("memory: a run without it is an error, and the runner goes on") {
    const PreparedMesh mesh = prepared(builtin("icosphere", 2));
    const SampleParams params = params_for(mesh, 30);
    BoxParams box{{1, 1}, true};
    box.min_distance = 0.2;
    const Domain domains[] = {expect(Domain::surface(mesh, params)), expect(Domain::box(box))};
    const Context& context = shared_context();
    for (const RunnerOptions& options : {RunnerOptions{}, growing()}) {
        for (const Domain& domain : domains) {
            Runner runner = expect(Runner::create(context.device(), context.queue(), options));
            const SampleSet want = expect(runner.sample_and_wait(domain));
            sweep([&] {
                runner.release_memory();
                return runner.sample_and_wait(domain);
            });
            const SampleSet set = expect(runner.sample_and_wait(domain));
            CHECK(points_of(set) == points_of(want));
            CHECK(set.points == want.points);
        }
    }
}

TEST_CASE("memory: nor do errors need it") {
    const SampleParams params;
    const BoxParams none; // Without a distance.
    const PreparedMesh mesh = prepared(builtin("cube", 1));
    const DeviceReport report = shared_context().report();
    Tuning wrong;
    wrong.local_size = 3;
    for (std::uint32_t after = 0; after < 30; ++after) {
        std::uint32_t errors = 0;
        {
            const FailingNew failing(after);
            errors += !pool_size(mesh, params);
            errors += !Domain::surface(mesh, params);
            errors += !pool_size(none);
            errors += !Domain::box(none);
            errors += !chosen_tuning(wrong, report);
        }
        CHECK(errors == 5);
    }
    CHECK(distance_for_count(BoxParams{{}}, 10) == 0);
}

} // namespace geodisk::test
