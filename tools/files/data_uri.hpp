// Bytes and names that are written in URIs.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace geodisk::tools {

/// Returns the bytes of a URI that begins with "data:", or nothing if they are not as they should
/// be.
std::optional<std::string> data_of_uri(std::string_view uri);

/// Returns `text` with characters for "%20" and the like.
std::string percent_decoded(std::string_view text);

} // namespace geodisk::tools
