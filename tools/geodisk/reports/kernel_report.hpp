// Report of a driver on the kernels it has compiled, as text and JSON.
#pragma once

#include <string>
#include <vector>

#include <geodisk/kernel_report.hpp>

#include "geodisk/reports/json_type.hpp"

namespace geodisk::tools {

/// A table with a column for each statistic that the driver gives.
std::string kernels_text(const std::vector<KernelReport>& reports);

/// An array with an object for each executable.
Json kernels_json(const std::vector<KernelReport>& reports);

} // namespace geodisk::tools
