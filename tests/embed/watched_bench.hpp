// A runner's device that is watched.
#pragma once

#include <functional>
#include <vector>

#include <doctest/doctest.h>

#include <geodisk/context.hpp>
#include <geodisk/runner.hpp>

#include "device_spy.hpp"
#include "gpu/device_run.hpp"
#include "gpu/sets.hpp"
#include "support/device_abilities.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {

/// A run in chunks, whose buffers of samples grow again and again.
inline RunnerOptions growing() {
    RunnerOptions options;
    options.plan.stages = 1;
    options.plan.slots = kMinSlots;
    options.plan.sample_capacity = kMinSlots + 1;
    return options;
}

/// A context whose device is watched, and a small job with its answer.
struct Bench {
    Context context = expect(Context::create());
    DeviceSpy spy{context.device().get_instance_proc_addr};
    PreparedMesh mesh = prepared(builtin("icosphere", 2));
    SampleParams params = params_for(mesh, 30);
    /// Domain of another job, instead of that one.
    std::function<Result<Domain>()> other;

    /// Returns true if runners read through buffer views; they do wherever they can.
    bool reads_texels() const { return reads_of(context.report()).back() == Reads::texels; }

    Result<Runner> create(RunnerOptions options = {}) const {
        options.sampler.tuning.reads = reads_of(context.report()).back();
        DeviceRefs refs = context.device();
        refs.get_instance_proc_addr = &DeviceSpy::get_instance_proc_addr;
        return Runner::create(refs, context.queue(), options);
    }

    Result<Domain> domain() const { return other ? other() : Domain::surface(mesh, params); }

    Result<SampleSet> sample(Runner& runner) const {
        const Result<Domain> of = domain();
        return of ? runner.sample_and_wait(*of) : Result<SampleSet>(of.error());
    }

    /// The reference's set; of another job that of a runner that is not watched.
    void check_set(const Result<SampleSet>& set) {
        REQUIRE_MESSAGE(set, (set ? "" : set.error().message));
        if (wanted_.empty() && !other) {
            wanted_ = float_set(mesh, params, set->report.plan.error_bound);
        }
        if (wanted_.empty() && wanted_points_.empty()) {
            Runner runner = expect(Runner::create(context.device(), context.queue()));
            const SampleSet first = expect(sample(runner));
            wanted_ = points_of(first);
            wanted_points_ = first.points;
        }
        CHECK(points_of(*set) == wanted_);
        CHECK(set->points == wanted_points_);
    }

    void check_run(Runner& runner) { check_set(sample(runner)); }

    Result<Done> prepare(const Runner& runner) const {
        return runner.sampler().prepare(expect(domain()));
    }

    /// A runner that has compiled all that the job needs.
    Runner prepared_runner(const RunnerOptions& options = {}) const {
        Runner runner = expect(create(options));
        expect(prepare(runner));
        return runner;
    }

  private:
    Points wanted_;
    std::vector<double> wanted_points_; ///< Points of boxes.
};

} // namespace geodisk::test
