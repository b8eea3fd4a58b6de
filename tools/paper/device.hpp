// Runs of the sampler on a device.
#pragma once

#include <cstdint>
#include <string>

#include <geodisk/box.hpp>
#include <geodisk/context.hpp>
#include <geodisk/runner.hpp>

#include "paper/pool.hpp"

namespace geodisk::paper {

/// An empty name for the default device. With `graphics` the queue is to draw as well.
Context open_context(const std::string& name, bool graphics = false);

/// With the tuning that is kept for the device.
RunnerOptions kept_options(const Context& context);

/// A run that a signal ends. Throws UserError.
SampleSet run_box(Runner& runner, const BoxParams& box);

struct DeviceRun {
    double samples = 0; ///< Mean over the repetitions.
    double candidates = 0;
    double rho = 0; ///< Mean packing density.
    double min_rho = 0, max_rho = 0;
    double seconds = 0; ///< Median, from the candidates to the finished set.
};

/// A device with the tuning that is kept for it.
class Device {
  public:
    /// As open_context().
    explicit Device(const std::string& name, bool graphics = false);

    const Context& context() const { return context_; }
    const std::string& name() const { return context_.report().name; }

    SampleSet sample(const PaperMesh& mesh, const SampleParams& params);
    SampleSet sample(const BoxParams& box);

    /// One run to warm up and `repeats` with ascending seeds.
    DeviceRun measure(const PaperMesh& mesh, SampleParams params, int repeats);

  private:
    Runner make_runner(RunnerOptions options = {}) const;
    static SampleSet run(Runner& runner, const PaperMesh& mesh, const SampleParams& params);

    Context context_;
    Runner runner_;
};

} // namespace geodisk::paper
