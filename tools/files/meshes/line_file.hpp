// Points and the lines between them, in formats that hold both.
#pragma once

#include <string>

#include "files/samples/sample_file.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// Reads points as read_samples() does, and the lines between them: `l` of OBJ, the element `edge`
/// of PLY, and in tables a polyline for each number in the column `line`. Also reads OFF whose
/// faces have two corners, and points and lines of glTF, with buffers in files as FileScope of
/// `allows_outside` has it. Throws UserError(bad_input) as read_samples(), also for lines between
/// points that do not exist.
SampleFile read_points_and_lines(const Path& path, const std::string& numbers = {},
                                 bool allows_outside = false);

} // namespace geodisk::tools
