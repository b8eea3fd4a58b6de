// Reading a whole input file, with the errors a user can make.
#pragma once

#include <cstddef>
#include <string>

#include "program/path.hpp"

namespace geodisk::tools {

/// The bytes of the file or pipe `path`; "-" is standard input. Throws UserError(bad_input) when it
/// is missing, a folder or unreadable, and for devices but terminals, which may never end.
std::string read_file(const Path& path);

/// Returns the bytes of a file that another file names. Throws UserError(bad_input) for pipes too:
/// nobody may write to them.
std::string read_regular_file(const Path& path);

/// Returns the first `max_bytes` bytes of a regular file, fewer if it is shorter or unreadable.
/// Empty for all else: a pipe can be read just once.
std::string head_of(const Path& path, std::size_t max_bytes);

/// Throws UserError(bad_input) if `path` is a folder.
void check_no_folder(const Path& path);

/// `text` with the letters A to Z in lower case.
std::string lower_case(std::string text);

/// The extension of `path` in lower case with its dot (".obj"), or "".
std::string lower_extension(const Path& path);

} // namespace geodisk::tools
