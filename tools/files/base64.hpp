// Bytes as base64 writes them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace geodisk::tools {

/// Returns the first `count` bytes that `text` holds, or all if there are fewer; nothing if a digit
/// is wrong or missing. Skips blanks. Further digits may follow those that '=' fills up.
std::optional<std::string> from_base64(std::string_view text,
                                       std::size_t count = std::string::npos);

/// Appends the digits of `bytes`.
void append_base64(std::string& text, std::string_view bytes);

} // namespace geodisk::tools
