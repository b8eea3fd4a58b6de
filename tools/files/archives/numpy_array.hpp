// Arrays of numpy, as .npy files and the members of .npz files have them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "program/path.hpp"

namespace geodisk::tools {

/// An array of numbers or characters in bytes that must outlive it.
class NumpyArray {
  public:
    /// Reads the header of `bytes`, which are of the file `path`; `name` is what errors call the
    /// array. Throws UserError(bad_input) for bytes that are no array, and for too few of them.
    NumpyArray(const Path& path, const std::string& name, std::string_view bytes);

    const std::vector<std::size_t>& shape() const { return shape_; }
    /// Returns true for integers, truth values and floats of up to eight bytes.
    bool has_numbers() const { return value_ != nullptr; }

    /// Returns the number in `row` and `column`, 0 where there are none.
    double at(std::size_t row, std::size_t column = 0) const;
    /// Returns the text of an array without dimensions; "" for others, and unless it is ASCII.
    std::string text() const;

    /// "float64 (12, 3)", or how numpy spells the type if it is none of numbers.
    std::string description() const;

  private:
    using Reader = double (*)(const char* bytes, bool is_little);

    void parse_header(std::string_view header);
    void parse_type(std::string_view type);
    [[noreturn]] void fail(const std::string& message) const;

    const Path& path_;
    std::string name_, type_;
    std::vector<std::size_t> shape_;
    std::string_view content_;
    std::size_t item_ = 0; ///< Bytes of a value.
    char kind_ = 0;        ///< As numpy has it: 'f', 'i', 'u', 'b', 'U' or another.
    bool is_little_ = true, is_by_columns_ = false;
    Reader value_ = nullptr;
};

} // namespace geodisk::tools
