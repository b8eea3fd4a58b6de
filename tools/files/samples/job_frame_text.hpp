// Job frames in the headers of sample files.
#pragma once

#include <string>

#include <geodisk/job_frame.hpp>

namespace geodisk::tools {

/// Returns the bytes of a frame as hexadecimal digits.
std::string job_frame_text(const JobFrame& frame);

/// Returns the frame that job_frame_text() was called on. Throws UserError(bad_input) with the path
/// of the file for other texts.
JobFrame job_frame_of_text(const std::string& text, const std::string& path);

} // namespace geodisk::tools
