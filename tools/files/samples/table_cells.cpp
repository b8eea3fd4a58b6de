#include "files/samples/table_cells.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "program/exact_text.hpp"

namespace geodisk::tools {
namespace {

constexpr char kQuote = '"';
constexpr std::string_view kBlankCharacters = " \t";
constexpr std::size_t kNowhere = std::string_view::npos;

/// Returns where a quoted text ends that `text` begins with, behind its mark; two marks stand for
/// one. kNowhere without an end.
std::size_t quoted_size(std::string_view text) {
    std::size_t end = 1;
    while ((end = text.find(kQuote, end)) != kNowhere) {
        if (end + 1 == text.size() || text[end + 1] != kQuote) {
            return end + 1;
        }
        end += 2;
    }
    return kNowhere;
}

/// A cell, and the size of the text that it takes up to the separator or the end.
struct Cell {
    std::string_view text;
    std::size_t size;
    bool is_open = false;
};

/// Returns the blanks that may stand around cells between `separators`.
std::string_view blanks_beside(std::string_view separators) {
    return separators == "\t" ? " " : kBlankCharacters;
}

/// Returns the first cell of `line`, which begins with no blank.
Cell first_cell(std::string_view line, std::string_view separators) {
    if (line.starts_with(kQuote)) {
        const std::size_t quoted = quoted_size(line);
        if (quoted == kNowhere) {
            return {line.substr(1), line.size(), true};
        }
        const std::size_t end =
            separators == kBlankCharacters
                ? quoted
                : std::min(line.find_first_not_of(blanks_beside(separators), quoted), line.size());
        if (end == line.size() || separators.find(line[end]) != kNowhere) {
            return {line.substr(1, quoted - 2), end};
        } // Otherwise text follows the mark, so this is no quoted cell.
    }
    const std::size_t end = std::min(line.find_first_of(separators), line.size());
    return {trimmed(line.substr(0, end)), end};
}

/// Splits at each of the separators; returns true if the last cell is open.
bool split_at(std::string_view line, std::string_view separators, Cells& cells) {
    cells.clear();
    for (;;) {
        line.remove_prefix(
            std::min(line.find_first_not_of(blanks_beside(separators)), line.size()));
        const Cell cell = first_cell(line, separators);
        cells.push_back(cell.text);
        if (cell.size == line.size()) {
            return cell.is_open;
        }
        line.remove_prefix(cell.size + 1);
    }
}

void split_at_blanks(std::string_view line, Cells& cells) {
    cells.clear();
    for (line = trimmed(line); !line.empty(); line = trimmed(line)) {
        Cell cell = first_cell(line, kBlankCharacters);
        if (cell.is_open) { // A mark of inches, or the like.
            cell.size = std::min(line.find_first_of(kBlankCharacters), line.size());
            cell.text = line.substr(0, cell.size);
        }
        cells.push_back(cell.text);
        line.remove_prefix(cell.size);
    }
}

} // namespace

char separator_of(std::string_view line) {
    for (const char separator : {';', ','}) {
        bool is_quoted = false;
        for (const char c : line) {
            is_quoted ^= c == kQuote;
            if (c == separator && !is_quoted) {
                return separator;
            }
        }
    }
    return kBlanks;
}

bool split_cells(std::string_view line, char separator, std::size_t columns, Cells& cells) {
    if (separator != kBlanks) {
        return split_at(line, {&separator, 1}, cells);
    }
    split_at_blanks(line, cells);
    if (columns != 0 && cells.size() != columns && line.find('\t') != kNowhere) {
        Cells at_tabs;
        const bool is_open = split_at(line, "\t", at_tabs);
        if (at_tabs.size() == columns && !is_open) {
            cells = std::move(at_tabs);
        }
    }
    return false;
}

std::optional<double> number_in(std::string_view cell, char separator) {
    std::string text(cell);
    if (separator == ';') {
        std::ranges::replace(text, ',', '.');
    }
    return parse_real(text);
}

} // namespace geodisk::tools
