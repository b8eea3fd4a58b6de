// The tuning that `geodisk_bench --tune` found for a device, kept among the user's cached files.
#pragma once

#include <filesystem>
#include <optional>

#include <geodisk/sampler.hpp>

namespace geodisk::tools {

/// Where the tuning of this device and driver is kept; empty if the user has no folder for cached
/// files. ($XDG_CACHE_HOME or ~/.cache; %LOCALAPPDATA% on Windows.)
std::filesystem::path tuning_path(const DeviceReport& device);

/// Nothing if none is kept. Throws UserError(bad_input) naming the file if it is not as written.
std::optional<Tuning> load_tuning(const DeviceReport& device);

/// Returns the path. Throws UserError(bad_output) if the file cannot be written.
std::filesystem::path store_tuning(const DeviceReport& device, const Tuning& tuning);

} // namespace geodisk::tools
