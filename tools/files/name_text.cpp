#include "files/name_text.hpp"

#include "program/safe_text.hpp"

namespace geodisk::tools {

std::string readable_name(std::string_view bytes) {
    for (std::string_view rest = bytes; !rest.empty();) {
        const std::size_t size = character_size(rest);
        if (size == 0) {
            std::string text;
            for (const char c : bytes) {
                const auto byte = static_cast<unsigned char>(c);
                if (byte >= 0x80) {
                    text += static_cast<char>(0xc0 | byte >> 6);
                    text += static_cast<char>(0x80 | (byte & 0x3f));
                } else {
                    text += c;
                }
            }
            return text;
        }
        rest.remove_prefix(size);
    }
    return std::string(bytes);
}

} // namespace geodisk::tools
