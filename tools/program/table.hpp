// A table, for people and as CSV.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace geodisk::tools {

/// Rows of cells under the names of their columns. An empty cell is a value that does not exist.
class Table {
  public:
    explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

    /// As many cells as columns.
    void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

    /// Aligned lines: the first columns to the left, all others to the right; '-' for an empty
    /// cell. The name of a column may have several lines.
    std::string text(std::size_t left_columns = 1) const;

    /// Quoted where needed (RFC 4180).
    std::string csv() const;

  private:
    std::vector<std::string> columns_;
    std::vector<std::vector<std::string>> rows_;
};

} // namespace geodisk::tools
