// What `geodisk box` tells about a run: to people, to programs, and in the sample file.
#pragma once

#include <cstdint>
#include <ostream>
#include <string>

#include <geodisk/box.hpp>
#include <geodisk/runner.hpp>

#include "common/sample_file.hpp"

namespace geodisk::tools {

struct BoxReport {
    std::string output_path;
    BoxParams box;
    double wanted_count = 0; ///< Of --count; 0 without.
    std::uint64_t samples = 0;
    RunReport run;
    DeviceReport device;
    Tuning tuning; ///< As used.
    struct {
        double device = 0, pipelines = 0, write = 0;
    } seconds; ///< Those of upload, sample and readback are in `run`.

    /// Volume of the samples' disks, of half the minimum distance, over that of the box.
    double density() const;
};

/// Nothing in it depends on when or how fast the run was, so equal runs give equal files.
SampleHeader sample_header(const BoxReport& report);

/// One JSON object and a line break.
std::string json_text(const BoxReport& report);

void print_summary(std::ostream& out, const BoxReport& report);

} // namespace geodisk::tools
