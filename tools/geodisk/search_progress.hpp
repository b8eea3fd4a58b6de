// The progress of searches on a mesh.
#pragma once

#include <string>

#include <geodisk/runner.hpp>

#include "geodisk/outputs/progress.hpp"

namespace geodisk::tools {

/// Shows how far a search is, and what is accepted so far, called `found` ("pairs"). Warns once if
/// it takes long, and stops it on a signal. `progress` must outlive it.
ProgressCallback search_progress(ProgressLine& progress, const std::string& found);

} // namespace geodisk::tools
