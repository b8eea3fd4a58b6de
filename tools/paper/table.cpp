#include "paper/table.hpp"

#include <algorithm>

#include "program/exact_text.hpp"
#include "program/human_text.hpp"

namespace geodisk::paper {
namespace {

std::string csv_line(const std::vector<std::string>& cells) {
    std::string line;
    for (const std::string& cell : cells) {
        line += line.empty() ? "" : ",";
        line += tools::csv_cell(cell);
    }
    return line + '\n';
}

const std::string& shown(const std::string& cell) {
    static const std::string missing = "-";
    return cell.empty() ? missing : cell;
}

} // namespace

std::string Table::text() const {
    std::vector<std::size_t> widths;
    for (std::size_t column = 0; column < columns_.size(); ++column) {
        std::size_t width = columns_[column].size();
        for (const auto& row : rows_) {
            width = std::max(width, shown(row[column]).size());
        }
        widths.push_back(width);
    }
    std::string text;
    const auto add_line = [&](const std::vector<std::string>& cells) {
        for (std::size_t column = 0; column < cells.size(); ++column) {
            const std::string& cell = shown(cells[column]);
            text += column == 0 ? tools::padded(cell, widths[column])
                                : std::string(2 + widths[column] - cell.size(), ' ') + cell;
        }
        text += '\n';
    };
    add_line(columns_);
    for (const auto& row : rows_) {
        add_line(row);
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

} // namespace geodisk::paper
