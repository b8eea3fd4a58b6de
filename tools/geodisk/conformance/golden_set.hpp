// The sets that every device must give, and what a device gives instead of one.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geodisk/device_run.hpp"
#include "geodisk/options/run_options.hpp"
#include "geodisk/outputs/progress.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// A line of golden_sets.txt.
struct GoldenSet {
    std::string fingerprint; ///< As fingerprint_of() returns it.
    std::uint64_t samples;
    std::string job; ///< A command without its output, such as "sample builtin:cube -d 0.1".
};

/// All of them, in the order of the file.
std::vector<GoldenSet> golden_sets();

/// Those of another file of its form. Throws UserError(bad_input).
std::vector<GoldenSet> read_sets(const Path& path);

/// Result of a device for a job.
struct FoundSet {
    std::string fingerprint;
    std::uint64_t samples = 0;
    std::uint32_t chunks = 0; ///< Parts in which the candidates were drawn.
    double seconds = 0;       ///< Seconds of the run on the device, without compiling.
    std::string error;        ///< Why there is no set; "" if there is one.

    bool is(const GoldenSet& set) const {
        return error.empty() && fingerprint == set.fingerprint && samples == set.samples;
    }
};

/// Samples what a golden set is about. `device` is kept open from one to the next. Throws UserError
/// for a device that cannot be opened, and when interrupted; all else is an error of the set.
FoundSet find_set(const GoldenSet& set, const DeviceOptions& options, RunDevice& device,
                  ProgressLine& progress);

} // namespace geodisk::tools
