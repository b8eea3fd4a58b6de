// Formats of a head and of rows that each stand by themselves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "files/samples/sample_layout.hpp"

namespace geodisk::tools {

/// Returns the lines of a PLY header for the columns of a row.
std::string ply_properties(const SampleLayout& layout);

/// PLY, CSV and XYZ. Whoever knows where a row begins can write it, whatever the others are.
class RowFormat {
  public:
    /// Returns true for these formats.
    static bool is_one(SampleFormat format);

    /// The format of `target`, which is_one(). It keeps a copy of what it gets, but for what the
    /// further columns are views of.
    RowFormat(const SampleTarget& target, const SampleLayout& layout);

    /// Returns what is before so many rows: the header too, where the target has one.
    std::string head(const SampleHeader& header, std::uint64_t count) const;

    /// Appends a row; `index` is its place in the further columns.
    void append(std::string& bytes, const SampleRow& row, std::size_t index) const;

  private:
    SampleTarget target_;
    SampleLayout layout_;
};

} // namespace geodisk::tools
