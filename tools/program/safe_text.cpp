#include "program/safe_text.hpp"

#include <algorithm>

#include "program/exact_text.hpp"

namespace geodisk::tools {
namespace {

/// The character of `bytes`, as many as character_size() gives.
char32_t decoded(std::string_view bytes) {
    const auto first = static_cast<unsigned char>(bytes.front());
    if (bytes.size() == 1) {
        return first;
    }
    char32_t character = first & (0x7fu >> bytes.size());
    for (const char byte : bytes.substr(1)) {
        character = character << 6 | (static_cast<unsigned char>(byte) & 0x3fu);
    }
    return character;
}

/// Calls `visit(bytes, is_plain)` for each character; stray bytes are one each, and not plain.
template <class Visit>
void visit_characters(std::string_view text, const Visit& visit) {
    while (!text.empty()) {
        const std::size_t size = character_size(text);
        const std::string_view bytes = text.substr(0, std::max<std::size_t>(size, 1));
        visit(bytes, size > 0 && !is_control(decoded(bytes)));
        text.remove_prefix(bytes.size());
    }
}

/// Returns true if a spreadsheet computes a cell that begins so.
bool begins_formula(std::string_view text) {
    return !text.empty() && std::string_view("=+-@").find(text.front()) != std::string_view::npos;
}

void append_escape(std::string& text, char32_t character) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    text += "\\u";
    for (unsigned shift = 16; shift > 0; shift -= 4) {
        text += kDigits[character >> (shift - 4) & 15u];
    }
}

} // namespace

std::size_t character_size(std::string_view text) {
    if (text.empty()) {
        return 0;
    }
    const auto byte = static_cast<unsigned char>(text.front());
    const std::size_t size = byte < 0x80   ? 1
                             : byte < 0xc2 ? 0
                             : byte < 0xe0 ? 2
                             : byte < 0xf0 ? 3
                             : byte < 0xf5 ? 4
                                           : 0;
    const std::string_view bytes = text.substr(0, size);
    const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; };
    if (size < 2 || bytes.size() < size ||
        !std::all_of(bytes.begin() + 1, bytes.end(), continues)) {
        return size == 1 ? 1 : 0;
    }
    const char32_t character = decoded(bytes);
    constexpr char32_t kMin[] = {0x80, 0x800, 0x10000}; // Of 2, 3 and 4 bytes.
    const bool is_surrogate = character >= 0xd800 && character <= 0xdfff;
    const bool is_character = character >= kMin[size - 2] && character <= 0x10ffff && !is_surrogate;
    return is_character ? size : 0;
}

bool is_control(char32_t character) {
    const auto is_of = [character](char32_t first, char32_t last) {
        return character >= first && character <= last;
    };
    return is_of(0, 0x1f) || is_of(0x7f, 0x9f) || character == 0x61c || is_of(0x200e, 0x200f) ||
           is_of(0x2028, 0x202e) || is_of(0x2066, 0x2069);
}

bool is_printable(std::string_view text) {
    bool all = true;
    visit_characters(text, [&all](std::string_view, bool is_plain) { all = all && is_plain; });
    return all;
}

std::string plain_lines(std::string_view text) {
    std::string result;
    visit_characters(text, [&result](std::string_view bytes, bool is_plain) {
        result += is_plain || bytes == "\n" ? bytes : "?";
    });
    return result;
}

std::string one_line(std::string_view text) {
    std::string line(text);
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
    return plain_lines(line);
}

std::string csv_cell(std::string_view text) {
    std::string plain = one_line(text); // Blanks for line breaks, which may come first.
    if (begins_formula(trimmed(plain)) && !parse_real(text)) {
        plain.insert(0, 1, '\'');
    }
    if (plain.find_first_of(",;\"#") == std::string::npos) {
        return plain;
    }
    std::string cell = "\"";
    for (const char character : plain) {
        cell += character;
        cell += character == '"' ? "\"" : "";
    }
    return cell + '"';
}

std::string csv_comment(std::string_view text) {
    const std::string plain = one_line(text);
    std::string line;
    for (std::size_t at = 0; at < plain.size(); ++at) {
        line += plain[at];
        const bool separates = plain[at] == ',' || plain[at] == ';';
        const std::string_view rest = std::string_view(plain).substr(at + 1);
        line += separates && begins_formula(trimmed(rest)) ? "'" : "";
    }
    return line;
}

std::string escaped_json(std::string json) {
    if (is_printable(json)) {
        return json;
    }
    std::string result;
    visit_characters(json, [&result](std::string_view bytes, bool is_plain) {
        if (is_plain || bytes == "\n") { // Line breaks are between strings.
            result += bytes;
        } else {
            append_escape(result, decoded(bytes));
        }
    });
    return result;
}

} // namespace geodisk::tools
