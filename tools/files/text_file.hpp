// Reading input files that are to hold text, and telling what else they hold.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "program/path.hpp"

namespace geodisk::tools {

/// Returns the bytes of `path` as read_file() does, after refuse_other_content().
std::string read_text(const Path& path);

/// Throws UserError(bad_input) if `bytes` are those of a file that people meet under any name: one
/// that is compressed, text in UTF-16, a web page, or a pointer that version control left in its
/// place. The message says what it is and what to do.
void refuse_other_content(const Path& path, std::string_view bytes);

/// Throws UserError(bad_input) if `bytes` begin as a mesh file of another kind does. `extension` is
/// that of the kind expected, such as ".obj".
void refuse_other_mesh(const Path& path, std::string_view bytes, std::string_view extension);

/// Removes the NUL bytes at the end of `text`, which some programs pad their files with. Returns
/// their number.
std::size_t drop_final_nuls(std::string& text);

} // namespace geodisk::tools
