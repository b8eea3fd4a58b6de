// The box that the samples of a file lie in.
#pragma once

#include <string>

#include <geodisk/box.hpp>

#include "files/samples/sample_file.hpp"

namespace geodisk::tools {

/// Returns the box that the header of a file describes, with `min_distance` of the command
/// line instead of the header's, unless it is "". Throws UserError.
BoxParams box_of(const std::string& min_distance, const SampleFile& samples);

} // namespace geodisk::tools
