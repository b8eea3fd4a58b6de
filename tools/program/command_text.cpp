#include "program/command_text.hpp"

#include <algorithm>
#include <cstddef>

namespace geodisk::tools {
namespace {

bool is_plain(char c) {
    constexpr std::string_view kSigns = "_./:=,+@%-";
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           kSigns.find(c) != std::string_view::npos;
}

/// Bytes of the character that `text` begins with; 0 for no UTF-8. Longer forms than need be pass.
std::size_t character_size(std::string_view text) {
    const auto byte = static_cast<unsigned char>(text.front());
    const std::size_t size = byte < 0x80   ? 1
                             : byte < 0xc2 ? 0
                             : byte < 0xe0 ? 2
                             : byte < 0xf0 ? 3
                             : byte < 0xf5 ? 4
                                           : 0;
    const std::string_view rest = text.substr(1, size > 0 ? size - 1 : 0);
    const bool is_whole =
        rest.size() + 1 == size && std::all_of(rest.begin(), rest.end(), [](char c) {
            return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
        });
    return is_whole ? size : 0;
}

bool is_printable(std::string_view text) {
    while (!text.empty()) {
        const std::size_t size = character_size(text);
        const auto byte = static_cast<unsigned char>(text.front());
        if (size == 0 || byte < 0x20 || byte == 0x7f) {
            return false;
        }
        text.remove_prefix(size);
    }
    return true;
}

std::string escaped(std::string_view text) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string word = "$'";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte >= 0x7f) {
            word.append("\\x").append(1, kDigits[byte >> 4]).append(1, kDigits[byte & 15]);
        } else {
            word.append(c == '\'' || c == '\\' ? "\\" : "").append(1, c);
        }
    }
    return word + '\'';
}

} // namespace

std::string shell_word(std::string_view argument) {
    if (!argument.empty() && std::all_of(argument.begin(), argument.end(), is_plain)) {
        return std::string(argument);
    }
    if (!is_printable(argument)) {
        return escaped(argument);
    }
    std::string word = "'";
    for (const char c : argument) {
        word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return word + '\'';
}

std::string command_text(std::string_view program, std::span<const std::string> arguments) {
    std::string text = shell_word(program);
    for (const std::string& argument : arguments) {
        text += ' ' + shell_word(argument);
    }
    return text;
}

} // namespace geodisk::tools
