// The lines and numbers of VTK's legacy files, which are text, or text with numbers in binary.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "files/meshes/reading_progress.hpp"
#include "files/number_type.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// Type of an array: numbers, bits or text.
struct VtkType {
    NumberType number;
    bool is_bit = false, is_text = false;
};

/// Steps through a file. Throws UserError(bad_input) with the line, or of a binary file the byte.
class VtkStream {
  public:
    /// Reads the first three lines. `bytes` must outlive it.
    VtkStream(const Path& path, std::string_view bytes, const ReadingProgress& progress);

    bool is_binary() const { return is_binary_; }
    /// Returns true since version 5, where cells are two arrays.
    bool has_offsets() const { return version_ >= 5; }

    /// Splits the next line that is not blank into words. Returns false at the end of the file.
    bool next_line(std::vector<std::string_view>& words);
    /// Skips all lines up to a blank one. Returns true.
    bool skip_block();

    /// Returns the type that a file calls so: "unsigned_char".
    VtkType type_named(std::string_view name) const;

    /// Returns the numbers that follow the last line.
    std::vector<double> values(const VtkType& type, std::uint64_t count);
    /// Skips an array of numbers or texts.
    void skip(const VtkType& type, std::uint64_t components, std::uint64_t rows);
    /// Fails where so many rows of numbers cannot be.
    void check_product(std::uint64_t components, std::uint64_t rows) const;

    [[noreturn]] void fail(const std::string& message) const;

  private:
    std::string_view take_line();
    void read_head();
    [[noreturn]] void fail_at_end(std::uint64_t count) const;
    std::vector<double> text_values(std::uint64_t count);
    std::vector<double> binary_values(const NumberType& type, std::uint64_t count);
    std::vector<double> bit_values(std::uint64_t count);
    void skip_texts(std::uint64_t count);

    const Path& path_;
    std::string_view bytes_;
    const ReadingProgress& progress_;
    std::size_t position_ = 0; ///< Where the next line or number begins.
    std::size_t place_ = 0;    ///< Where the last line began.
    bool is_binary_ = false;
    int version_ = 0;
};

} // namespace geodisk::tools
