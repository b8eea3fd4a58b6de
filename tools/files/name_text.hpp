// Names in files, as text to show and to compare.
#pragma once

#include <string>
#include <string_view>

namespace geodisk::tools {

/// Returns a name as UTF-8. Bytes that are not UTF-8 are read as Latin-1.
std::string readable_name(std::string_view bytes);

/// Returns a readable name with composed letters (NFC), so that names of the same letters are
/// equal.
std::string composed_name(std::string_view bytes);

/// Returns the same with letters of one case.
std::string folded_name(std::string_view bytes);

} // namespace geodisk::tools
