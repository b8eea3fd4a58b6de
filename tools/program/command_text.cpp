#include "program/command_text.hpp"

#include <algorithm>

#include "program/safe_text.hpp"

namespace geodisk::tools {
namespace {

bool is_plain(char c) {
    constexpr std::string_view kSigns = "_./:=,+@%-";
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           kSigns.find(c) != std::string_view::npos;
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

std::string in_shell_quotes(std::string_view text) {
    std::string quoted = "'";
    for (const char c : text) {
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return quoted + '\'';
}

std::string shell_word(std::string_view argument) {
    if (!argument.empty() && std::all_of(argument.begin(), argument.end(), is_plain)) {
        return std::string(argument);
    }
    if (!is_printable(argument)) {
        return escaped(argument);
    }
    return in_shell_quotes(argument);
}

std::string command_text(std::string_view program, std::span<const std::string> arguments) {
    std::string text = shell_word(program);
    for (const std::string& argument : arguments) {
        text += ' ' + shell_word(argument);
    }
    return text;
}

} // namespace geodisk::tools
