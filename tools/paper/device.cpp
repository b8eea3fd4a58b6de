#include "paper/device.hpp"

#include <algorithm>
#include <vector>

#include "bench/statistics.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"
#include "program/tuning_file.hpp"

namespace geodisk::paper {
namespace {

Runner make_runner(const Context& context) {
    RunnerOptions options;
    if (const auto kept = tools::load_tuning(context.report())) {
        options.sampler.tuning = *kept;
    }
    return tools::take(Runner::create(context.device(), context.queue(), options));
}

} // namespace

Device::Device(const std::string& name)
    : context_(tools::take(Context::create({name, /* validation */ false, {}}))),
      runner_(make_runner(context_)) {}

SampleSet Device::run(const PaperMesh& mesh, const SampleParams& params) {
    auto result = runner_.sample_and_wait(mesh.prepared, params,
                                          [](const Progress&) { return !tools::is_interrupted(); });
    tools::check_interrupted();
    return tools::take(std::move(result), mesh.name);
}

DeviceRun Device::sample(const PaperMesh& mesh, SampleParams params, int repeats) {
    DeviceRun mean;
    std::vector<double> seconds;
    std::vector<double> rhos;
    run(mesh, params);
    for (int i = 0; i < repeats; ++i, ++params.seed) {
        const SampleSet set = run(mesh, params);
        const auto samples = static_cast<double>(set.samples.size());
        mean.samples += samples / repeats;
        mean.candidates += static_cast<double>(set.report.candidates) / repeats;
        rhos.push_back(packing_density(mesh.area(), params.min_distance, samples));
        mean.rho += rhos.back() / repeats;
        seconds.push_back(set.report.seconds.sample);
    }
    mean.least_rho = *std::min_element(rhos.begin(), rhos.end());
    mean.most_rho = *std::max_element(rhos.begin(), rhos.end());
    mean.seconds = bench::median(seconds);
    return mean;
}

} // namespace geodisk::paper
