// Report of `geodisk box` about a run: to people, to programs, and in the sample file.
#pragma once

#include <cstdint>
#include <string>

#include <geodisk/box.hpp>

#include "files/samples/sample_file.hpp"
#include "geodisk/device_run.hpp"
#include "geodisk/dry_run.hpp"
#include "geodisk/options/box_options.hpp"
#include "geodisk/reports/run_report.hpp"

namespace geodisk::tools {

/// The sides of a box, and whether they are open or periodic: "1 x 0.5, open".
std::string box_text(const BoxParams& box);

/// Returns the report of --dry-run about a job.
std::string dry_box_json(const BoxJob& job, const DryRun& dry);
std::string dry_box_text(const BoxJob& job, const DryRun& dry);

/// Tells of a job and what came of it, both of which must outlive the report.
class BoxReport {
  public:
    BoxReport(const BoxJob& job, std::size_t samples, const DeviceRun& done);

    /// Nothing in it depends on when or how fast the run was, so equal runs give equal files.
    SampleHeader header() const;

    /// One JSON object and a line break. Writing the samples took `write_seconds`.
    std::string json(double write_seconds) const;

    std::string summary(double write_seconds) const;

  private:
    Drawn drawn() const;

    const BoxJob& job_;
    const DeviceRun& done_;
    std::uint64_t samples_;
    double density_; ///< Volume of the disks, of half the minimum distance, over that of the box.
};

} // namespace geodisk::tools
