#include "program/table.hpp"

#include <algorithm>

#include "program/human_text.hpp"
#include "program/safe_text.hpp"

namespace geodisk::tools {
namespace {

std::string csv_line(const std::vector<std::string>& cells) {
    std::string line;
    for (const std::string& cell : cells) {
        line += line.empty() ? "" : ",";
        line += csv_cell(cell);
    }
    return line + '\n';
}

const std::string& shown(const std::string& cell) {
    static const std::string kMissing = "-";
    return cell.empty() ? kMissing : cell;
}

/// The names of columns line by line, from the top; short ones stand at the bottom.
std::vector<std::vector<std::string>> lines_of(const std::vector<std::string>& names) {
    const auto breaks_in = [](const std::string& name) {
        return static_cast<std::size_t>(std::count(name.begin(), name.end(), '\n'));
    };
    std::size_t count = 1;
    for (const std::string& name : names) {
        count = std::max(count, breaks_in(name) + 1);
    }
    std::vector<std::vector<std::string>> lines(count, std::vector<std::string>(names.size()));
    for (std::size_t column = 0; column < names.size(); ++column) {
        std::size_t line = count - 1 - breaks_in(names[column]);
        for (const char character : names[column]) {
            if (character == '\n') {
                ++line;
            } else {
                lines[line][column] += character;
            }
        }
    }
    return lines;
}

} // namespace

std::string Table::text(std::size_t left_columns) const {
    const std::vector<std::vector<std::string>> headings = lines_of(columns_);
    std::vector<std::size_t> widths;
    for (std::size_t column = 0; column < columns_.size(); ++column) {
        std::size_t width = 0;
        for (const auto& heading : headings) {
            width = std::max(width, heading[column].size());
        }
        for (const auto& row : rows_) {
            width = std::max(width, shown(row[column]).size());
        }
        widths.push_back(width);
    }
    std::string text;
    const auto add_cell = [&](std::size_t column, const std::string& cell) {
        text += column == 0 ? "" : "  ";
        text += column < left_columns ? padded(cell, widths[column])
                                      : std::string(widths[column] - cell.size(), ' ') + cell;
    };
    const auto end_line = [&text] {
        text.erase(text.find_last_not_of(' ') + 1);
        text += '\n';
    };
    for (const auto& heading : headings) {
        for (std::size_t column = 0; column < heading.size(); ++column) {
            add_cell(column, heading[column]);
        }
        end_line();
    }
    for (const auto& row : rows_) {
        for (std::size_t column = 0; column < row.size(); ++column) {
            add_cell(column, shown(row[column]));
        }
        end_line();
    }
    return text;
}

std::string Table::csv() const {
    std::string text = csv_line(columns_);
    for (const auto& row : rows_) {
        text += csv_line(row);
    }
    return text;
}

} // namespace geodisk::tools
