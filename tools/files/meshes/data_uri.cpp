#include "files/meshes/data_uri.hpp"

#include <charconv>
#include <cstddef>

#include "files/base64.hpp"

namespace geodisk::tools {

std::string percent_decoded(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned value = 0;
        const char* const begin = text.data() + i + 1;
        if (text[i] == '%' && i + 2 < text.size() &&
            std::from_chars(begin, begin + 2, value, 16).ptr == begin + 2) {
            result += static_cast<char>(value);
            i += 2;
        } else {
            result += text[i];
        }
    }
    return result;
}

std::optional<std::string> data_of_uri(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) {
        return std::nullopt;
    }
    const std::string_view data = uri.substr(comma + 1);
    const bool is_base64 = uri.substr(0, comma).ends_with(";base64");
    return is_base64 ? from_base64(data) : std::optional(percent_decoded(data));
}

std::string data_uri(std::string_view bytes) {
    std::string uri = "data:application/octet-stream;base64,";
    append_base64(uri, bytes);
    return uri;
}

std::array<std::string, 2> uri_file_names(const std::string& uri) {
    return {percent_decoded(uri), uri};
}

} // namespace geodisk::tools
