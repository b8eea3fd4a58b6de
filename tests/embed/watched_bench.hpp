// A runner's device that is watched.
#pragma once

#include <doctest/doctest.h>

#include <geodisk/context.hpp>
#include <geodisk/runner.hpp>

#include "device_spy.hpp"
#include "gpu/device_run.hpp"
#include "gpu/sets.hpp"
#include "support/device_abilities.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {

/// A context whose device is watched, and a small job with its answer.
struct Bench {
    Context context = expect(Context::create());
    DeviceSpy spy{context.device().get_instance_proc_addr};
    PreparedMesh mesh = prepared(builtin("icosphere", 2));
    SampleParams params = params_for(mesh, 30);

    /// Whether runners read through buffer views; they do wherever they can.
    bool reads_texels() const { return reads_of(context.report()).back() == Reads::texels; }

    Result<Runner> create(RunnerOptions options = {}) const {
        options.sampler.tuning.reads = reads_of(context.report()).back();
        DeviceRefs refs = context.device();
        refs.get_instance_proc_addr = &DeviceSpy::get_instance_proc_addr;
        return Runner::create(refs, context.queue(), options);
    }

    void check_set(const Result<SampleSet>& set) {
        REQUIRE_MESSAGE(set, (set ? "" : set.error().message));
        if (wanted_.empty()) {
            wanted_ = float_set(mesh, params, set->report.plan.error_bound);
        }
        CHECK(points_of(*set) == wanted_);
    }

    void check_run(Runner& runner) { check_set(runner.sample_and_wait(mesh, params)); }

    Result<Done> prepare(const Runner& runner) const {
        return runner.sampler().prepare(expect(Domain::surface(mesh, params)));
    }

    /// A runner that has compiled all that the job needs.
    Runner prepared_runner(const RunnerOptions& options = {}) const {
        Runner runner = expect(create(options));
        expect(prepare(runner));
        return runner;
    }

  private:
    Points wanted_;
};

} // namespace geodisk::test
