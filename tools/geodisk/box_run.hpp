// A job of sampling a box, for the commands that do one.
#pragma once

#include "geodisk/device_run.hpp"
#include "geodisk/options/box_options.hpp"
#include "geodisk/outputs/progress.hpp"

namespace geodisk::tools {

/// The runs that the job takes; it must outlive them.
RequestRun box_request(const BoxJob& job);

/// Samples the box as the job asks for, and sets the job's distance to the one used. Throws
/// UserError, DeviceLost among them.
DeviceResult sample_box(BoxJob& job, RunDevice& device, ProgressLine& progress);

} // namespace geodisk::tools
