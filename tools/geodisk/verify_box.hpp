// `geodisk verify` for samples in a box, which its header describes.
#pragma once

#include <string>

namespace geodisk::tools {

struct VerifyBoxOptions {
    std::string samples, min_distance, json;
    bool quiet = false;
};

/// Throws UserError(violation) if samples are too close or outside the box, and as
/// read_box_samples().
void verify_box(const VerifyBoxOptions& options);

} // namespace geodisk::tools
