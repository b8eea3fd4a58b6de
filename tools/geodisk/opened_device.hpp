// The device of a command.
#pragma once

#include <span>
#include <string>

#include <geodisk/context.hpp>

#include "geodisk/options/run_options.hpp"
#include "geodisk/outputs/progress.hpp"

namespace geodisk::tools {

/// Opens the device that --device and --validate ask for, with a queue that draws as well if
/// `graphics` is set. Any thread may call it. Throws UserError.
Context create_context(const DeviceOptions& options, bool graphics);

/// Warns of missing drivers if the device is a CPU that nobody asked for.
void warn_of_unasked_cpu(const DeviceOptions& options, const Context& context);

/// Opens a device by create_context(), and warns of missing drivers.
Context open_device(const DeviceOptions& options, bool graphics, ProgressLine& progress);

/// Prints a warning for each driver that is left out, if all devices are CPUs.
void warn_of_missing_drivers(std::span<const DeviceReport> devices);

/// Returns the device that --device, `given`, or else GEODISK_DEVICE chooses; "" where neither
/// does. Throws UserError naming the variable for what matches no device that works.
std::string chosen_device(const std::string& given);

/// Throws UserError(internal) if the validation layer had something to say.
void check_validation(const Context& context);

} // namespace geodisk::tools
