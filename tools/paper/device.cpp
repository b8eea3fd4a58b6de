#include "paper/device.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "bench/statistics.hpp"
#include "files/tuning_file.hpp"
#include "files/vulkan_environment.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"

namespace geodisk::paper {

Context open_context(const std::string& name, bool graphics) {
    ContextOptions options;
    options.device = name;
    options.graphics = graphics;
    return tools::take_device(Context::create(options));
}

RunnerOptions kept_options(const Context& context) {
    RunnerOptions options;
    options.sampler.tuning = tools::load_tuning(context.report()).value_or(Tuning());
    return options;
}

Device::Device(const std::string& name, bool graphics)
    : context_(open_context(name, graphics)), runner_(make_runner()) {}

Runner Device::make_runner(RunnerOptions options) const {
    options.sampler.tuning = kept_options(context_).sampler.tuning;
    return tools::take(Runner::create(context_.device(), context_.queue(), options));
}

SampleSet Device::run(Runner& runner, const PaperMesh& mesh, const SampleParams& params) {
    auto result = runner.sample_and_wait(mesh.prepared, params,
                                         [](const Progress&) { return !tools::is_interrupted(); });
    tools::check_interrupted();
    return tools::take(std::move(result), mesh.name);
}

SampleSet run_box(Runner& runner, const BoxParams& box) {
    auto result = runner.sample_and_wait(tools::take(Domain::box(box)),
                                         [](const Progress&) { return !tools::is_interrupted(); });
    tools::check_interrupted();
    return tools::take(std::move(result));
}

SampleSet Device::sample(const BoxParams& box) {
    return run_box(runner_, box);
}

SampleSet Device::sample(const PaperMesh& mesh, const SampleParams& params) {
    return run(runner_, mesh, params);
}

DeviceRun Device::measure(const PaperMesh& mesh, SampleParams params, int repeats) {
    DeviceRun mean;
    std::vector<double> seconds;
    std::vector<double> rhos;
    run(runner_, mesh, params);
    for (int i = 0; i < repeats; ++i, ++params.seed) {
        const SampleSet set = run(runner_, mesh, params);
        const auto samples = static_cast<double>(set.samples.size());
        mean.samples += samples / repeats;
        mean.candidates += static_cast<double>(set.report.candidates) / repeats;
        rhos.push_back(packing_density(mesh.area(), params.min_distance, samples));
        mean.rho += rhos.back() / repeats;
        seconds.push_back(set.report.seconds.sample);
    }
    mean.min_rho = *std::min_element(rhos.begin(), rhos.end());
    mean.max_rho = *std::max_element(rhos.begin(), rhos.end());
    mean.seconds = bench::median(seconds);
    return mean;
}

} // namespace geodisk::paper
