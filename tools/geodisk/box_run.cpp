#include "geodisk/box_run.hpp"

#include <utility>

#include <geodisk/domain.hpp>

#include "program/failure.hpp"

namespace geodisk::tools {

RequestRun box_request(const BoxJob& job) {
    const auto step_at = [&job](double min_distance) -> Result<RequestStep> {
        BoxParams box = job.box;
        box.min_distance = min_distance;
        auto domain = Domain::box(box);
        if (!domain) {
            return domain.error();
        }
        RequestStep step{std::move(*domain)};
        step.params.min_distance = min_distance;
        step.expected = job.method.expected(expected_count(box));
        return step;
    };
    return take(RequestRun::create(step_at, job.box.min_distance, job.wanted_count.samples,
                                   job.wanted_count.is_exact));
}

DeviceResult sample_box(BoxJob& job, RunDevice& device, ProgressLine& progress) {
    DeviceResult result = device.run(box_request(job), progress);
    job.box.min_distance = result.done.min_distance;
    return result;
}

} // namespace geodisk::tools
