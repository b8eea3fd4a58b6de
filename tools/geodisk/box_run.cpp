#include "geodisk/box_run.hpp"

#include "program/failure.hpp"

namespace geodisk::tools {

RequestRun box_request(const BoxJob& job) {
    return take(RequestRun::create(
        BoxRequest{job.box, job.wanted_count.samples, job.wanted_count.is_exact}));
}

DeviceResult sample_box(BoxJob& job, RunDevice& device, ProgressLine& progress) {
    DeviceResult result = device.run(box_request(job), progress);
    job.box.min_distance = result.done.min_distance;
    return result;
}

} // namespace geodisk::tools
