// The cells of a line of a text table.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace geodisk::tools {

using Cells = std::vector<std::string_view>;

/// Stands for blanks and tabs alike, as a separator of cells.
inline constexpr char kBlanks = ' ';

/// Returns what stands between the cells of a line, outside of quotation marks: ';', ',' or
/// kBlanks.
char separator_of(std::string_view line);

/// Replaces `cells` by those of the line, without blanks and quotation marks around them. Between
/// blanks, a line of another number of cells than `columns` is split at tabs alone if that gives
/// so many; 0 for any number. Returns true if the last cell is quoted and has no end, so that the
/// next line belongs to it.
[[nodiscard]] bool split_cells(std::string_view line, char separator, std::size_t columns,
                               Cells& cells);

/// Returns the number that a cell is. Where semicolons part the cells, a comma may be its decimal
/// point.
std::optional<double> number_in(std::string_view cell, char separator);

} // namespace geodisk::tools
