// Finding out before long work that its result could not be written.
#pragma once

#include <string>

namespace geodisk::tools {

/// Whether both paths lead to the same file, also where neither exists yet.
bool is_same_file(const std::string& a, const std::string& b);

/// Throws UserError(bad_output) if no file can be made at `path`. Changes nothing there.
void check_writable(const std::string& path);

} // namespace geodisk::tools
