// Files of neuroimaging with a number for each vertex of a surface, such as curvature or thickness.
#pragma once

#include <string_view>
#include <vector>

#include "program/path.hpp"

namespace geodisk::tools {

/// Returns the values of a GIFTI file (`.shape.gii`, `.func.gii`, `.label.gii`) that has one array
/// of them. Throws UserError(bad_input), also where geodisk was built without pugixml.
std::vector<double> read_gifti_values(const Path& path);

/// Returns true for the bytes of a file such as `lh.curv` and `lh.thickness` of FreeSurfer.
bool is_freesurfer_values(std::string_view bytes);

/// Returns the values of such a file. Throws UserError(bad_input).
std::vector<double> read_freesurfer_values(const Path& path, std::string_view bytes);

} // namespace geodisk::tools
