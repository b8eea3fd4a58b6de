#include "geodisk/box_run.hpp"

#include <utility>

#include <geodisk/domain.hpp>

#include "program/failure.hpp"

namespace geodisk::tools {

Task box_task(const BoxJob& job) {
    return Task{take(Domain::box(job.box)), job.method.expected(expected_count(job.box))};
}

DeviceResult sample_box(BoxJob& job, RunDevice& device, ProgressLine& progress) {
    const auto task_at = [&](double min_distance) {
        job.box.min_distance = min_distance;
        return box_task(job);
    };
    DeviceResult result = device.run(task_at, job.box.min_distance, job.wanted_count, progress);
    job.box.min_distance = result.done.min_distance;
    return result;
}

} // namespace geodisk::tools
