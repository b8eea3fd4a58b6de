// The records of an MTL file and the names of files in them, for its reader and for whoever looks
// for such names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/text_lines.hpp"

namespace geodisk::tools {

/// Words of one line; all are parts of the same text.
using Words = std::span<const std::string_view>;

/// Returns the text from the first word to the end of the last one, as names may hold blanks.
std::string joined_text(Words words);

/// Steps through the lines that hold a record.
class MtlRecords {
  public:
    explicit MtlRecords(std::string_view text) : lines_(text) {}

    /// Gives the words of the next record without its comment; false at the end of the text.
    bool next(std::vector<std::string_view>& words);

    /// Number of the line of the record that next() gave last, from 1.
    std::uint32_t number() const noexcept { return lines_.number(); }

  private:
    TextLines lines_;
};

/// Returns the files that the text behind `mtllib` means: one whose name may hold blanks, or a list
/// of such. `is_file` tells which names are there; others end with ".mtl" or a blank.
std::vector<std::string> library_names(const std::string& text,
                                       const std::function<bool(const std::string&)>& is_file);

/// Returns the number of words of the option that `words` begin with, itself included; 0 if they
/// begin with the name of the image, which the last word always belongs to.
std::size_t map_option_size(Words words);

/// Returns true for the options of a map whose values are numbers, one at least.
bool has_numbers(std::string_view map_option);

} // namespace geodisk::tools
