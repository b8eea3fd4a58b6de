// Telling files apart, whatever names lead to them.
#pragma once

#include <string>

#include "program/path.hpp"

namespace geodisk::tools {

/// Returns a text that is the same for all names of one file: links of both kinds, relative and
/// absolute paths, and letters of another case where the file system ignores that. Files need not
/// exist. "-" is the descriptor `standard`; devices that are not open have no identity, "".
std::string file_identity(const Path& path, int standard = 1);

} // namespace geodisk::tools
