// The tuning that `geodisk_bench --tune` found for a device, kept among the user's cached files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <geodisk/sampler.hpp>

#include "program/path.hpp"

namespace geodisk::tools {

/// Returns the path of the tuning of this device and driver; empty if the user has no folder for
/// cached files. It is beside those of ContextOptions::keep_pipelines.
std::filesystem::path tuning_path(const DeviceReport& device);

/// Nothing unless `name` is what to_string() calls one of them.
std::optional<Reads> reads_named(const std::string& name);

/// Nothing if none is kept. Throws UserError(bad_input) naming the file if it is not as written, or
/// holds what the device cannot do.
std::optional<Tuning> load_tuning(const DeviceReport& device);

/// tuning_path(), in a folder that exists. Throws UserError(bad_output) if no file can be made
/// there.
std::filesystem::path writable_tuning_path(const DeviceReport& device);

/// Throws UserError(bad_output) if the file cannot be written.
void store_tuning(const Path& path, const DeviceReport& device, const Tuning& tuning);

} // namespace geodisk::tools
