// Text that came from a file, a name or a driver, made harmless for where it goes. Terminals, CSV,
// JSON, HTML and SVG each obey characters of their own; none of these goes out as it came in.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace geodisk::tools {

/// Number of bytes of the character that `text` begins with; 0 where that is no UTF-8 (a stray
/// byte, a longer form than need be, a surrogate) or where `text` is empty.
std::size_t character_size(std::string_view text);

/// Returns true for a character that controls more than its own place: control characters (C0, C1,
/// delete), line and paragraph separators, and marks that turn the direction of text around.
bool is_control(char32_t character);

/// Returns true if `text` is UTF-8 without control characters.
bool is_printable(std::string_view text);

/// Returns `text` for a terminal or a text file: '?' for control characters and for bytes that are
/// no UTF-8. Line breaks stay.
std::string plain_lines(std::string_view text);

/// Returns the same on one line: a blank for each line break and tab.
std::string one_line(std::string_view text);

/// Returns `text` as a cell of a CSV line, quoted where a reader would misunderstand it (RFC 4180).
/// A text that a spreadsheet would compute as a formula begins with an apostrophe.
std::string csv_cell(std::string_view text);

/// Returns `text` for a comment line of a CSV file: on one line, with an apostrophe before what a
/// spreadsheet would compute in a cell behind a separator.
std::string csv_comment(std::string_view text);

/// Returns the JSON document `json` with control characters escaped (\u009b), which JSON allows
/// within strings alone.
std::string escaped_json(std::string json);

} // namespace geodisk::tools
