// `geodisk verify` for samples in a box, which its header describes.
#pragma once

#include <string>

#include "geodisk/options/run_options.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {

struct VerifyBoxOptions {
    std::string samples, min_distance;
    OutputOptions out; ///< No samples.
};

/// Throws UserError(violation) if samples are too close or outside the box, and as
/// read_box_samples().
void verify_box(const VerifyBoxOptions& options);

} // namespace geodisk::tools
