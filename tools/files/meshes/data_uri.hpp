// Bytes and names that are written in URIs.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace geodisk::tools {

/// Returns `text` with characters for "%20" and the like.
std::string percent_decoded(std::string_view text);

/// Returns the bytes of a URI that begins with "data:", or nothing if they are not as they should
/// be.
std::optional<std::string> data_of_uri(std::string_view uri);

/// Returns a URI that holds these bytes, in base64.
std::string data_uri(std::string_view bytes);

/// Returns the names that a URI may mean: with characters for "%20" and the like, and as it is, as
/// some programs write it.
std::array<std::string, 2> uri_file_names(const std::string& uri);

} // namespace geodisk::tools
