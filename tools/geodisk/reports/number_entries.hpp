// The numbers of a job in headers of sample files and in reports.
#pragma once

#include <geodisk/params.hpp>

#include "files/samples/sample_file.hpp"
#include "geodisk/reports/json.hpp"

namespace geodisk::tools {

/// Returns those that differ from their defaults, for a header. The distance, the seed, and what
/// ends a run have entries of their own.
HeaderEntries number_entries(const SampleParams& params);

/// Adds those that a report does not tell yet.
void add_numbers(Json& report, const SampleParams& params);

} // namespace geodisk::tools
