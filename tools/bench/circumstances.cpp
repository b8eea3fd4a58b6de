#include "bench/circumstances.hpp"

#include <ctime>
#include <fstream>
#include <thread>

#include <geodisk/version.hpp>

#include "bench/commit.hpp"
#include "program/exact_text.hpp"
#include "program/human_text.hpp"

namespace geodisk::bench {
namespace {

std::string find_cpu() {
    std::ifstream info("/proc/cpuinfo"); // Linux only; elsewhere it does not open.
    for (std::string line; std::getline(info, line);) {
        const std::size_t colon = line.find(':');
        if (line.starts_with("model name") && colon != std::string::npos) {
            return std::string(tools::trimmed(std::string_view(line).substr(colon + 1)));
        }
    }
    return "unknown";
}

std::string now_utc() {
    const std::time_t now = std::time(nullptr);
    char text[32];
    const std::size_t size =
        std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
    return {text, size};
}

} // namespace

Circumstances find_circumstances(const Sampler& sampler, const Options& options) {
    const DeviceReport& device = sampler.report();
    Circumstances result;
    result.version = "geodisk " GEODISK_VERSION_STRING;
    result.commit = kCommit;
    result.is_dirty = kCommitIsDirty;
    result.build_type = GEODISK_BENCH_BUILD_TYPE;
    result.compiler = GEODISK_BENCH_COMPILER;
    result.device = device.name;
    result.driver = tools::driver_text(device);
    result.device_type = tools::type_name(device.type);
    result.cpu = find_cpu();
    result.cores = std::thread::hardware_concurrency();
    result.date = now_utc();
    result.repeats = options.repeats;
    result.warm_ups = options.warm_ups;
    result.seed = options.seed;
    result.slots = options.runner.plan.slots;
    result.lanes = options.runner.plan.lanes;
    result.passes = options.runner.plan.detect_passes;
    result.steps = options.runner.plan.step_budget;
    result.tuning = sampler.tuning();
    return result;
}

} // namespace geodisk::bench
