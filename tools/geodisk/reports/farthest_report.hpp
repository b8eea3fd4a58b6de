// Reports on samples in farthest-point order.
#pragma once

#include <string>

#include "files/samples/sample_file.hpp"
#include "geodisk/farthest_run.hpp"
#include "geodisk/reports/json_type.hpp"

namespace geodisk::tools {

/// Entries of the header of a sample file.
HeaderEntries farthest_entries(const FarthestRun& run);
Json farthest_json(const FarthestRun& run);
/// A line of the summary.
std::string farthest_line(const FarthestRun& run);

} // namespace geodisk::tools
