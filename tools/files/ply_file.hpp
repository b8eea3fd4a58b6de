// A strict PLY parser: ascii and both binary orders, any elements and properties. It knows nothing
// of meshes; ply_reader.cpp and sample_reader.cpp pick what they need.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/meshes/reading_progress.hpp"
#include "geometry/mesh_warning.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
    std::string name;
    PlyType type;
    std::optional<PlyType> count_type; ///< Set for list properties.
    std::uint32_t line = 0;            ///< Line in the header, from 1.
};

struct PlyElement {
    Path file;
    std::string name;
    std::uint64_t count = 0; ///< As promised by the header: not to be trusted for allocations.
    std::vector<PlyProperty> properties;

    /// Index of the scalar (or list) property `name`. Throws UserError(bad_input) if there are
    /// several.
    std::optional<std::size_t> find_scalar(std::string_view name) const;
    std::optional<std::size_t> find_list(std::string_view name) const;
};

/// Returns the bytes of a value in binary files.
std::size_t size_of(PlyType type);
/// Returns the value of such bytes.
double value_of(PlyType type, const char* bytes, bool is_little_endian);

/// The values of one record, by property index. A double holds every PLY value exactly.
struct PlyRecord {
    std::vector<double> scalars;            ///< 0 for lists.
    std::vector<std::vector<double>> lists; ///< Empty for scalars.
};

class PlyFile {
  public:
    using Visitor = std::function<void(std::uint64_t index, const PlyRecord& record)>;

    /// Reads `path` and parses its header; `progress` is of the records. Like all members it throws
    /// UserError(bad_input) naming the file and the header line or the element and record (counting
    /// from 0).
    explicit PlyFile(const Path& path, ReadingProgress progress = {});

    /// The same for bytes that are read already, from `path`.
    PlyFile(const Path& path, std::string bytes, ReadingProgress progress = {});

    const Path& path() const noexcept { return path_; }
    const std::vector<PlyElement>& elements() const noexcept { return elements_; }
    const std::vector<std::string>& comments() const noexcept { return comments_; }

    bool is_binary() const noexcept { return format_ != Format::ascii; }
    bool is_little_endian() const noexcept { return format_ == Format::little_endian; }
    /// Returns the number of bytes before the next record.
    std::size_t position() const noexcept { return position_; }

    /// Throws UserError(bad_input) if another element has its name.
    void check_unique(const PlyElement& element) const;

    /// Reads all records of `element`. Every element must be read, in the order of elements().
    void read_records(const PlyElement& element, const Visitor& visit);

    /// Returns how many records of `element` the rest of the file can hold at most.
    std::size_t possible_records(const PlyElement& element) const;

    /// Header lines that are no records, and ascii lines with more values than properties: ignored.
    const Found& unknown_lines() const noexcept { return unknown_lines_; }
    std::uint64_t surplus_lines() const noexcept { return surplus_lines_; }

    /// Returns true if the last line of a file of text has no end.
    bool ends_within_line() const {
        return format_ == Format::ascii && !bytes_.ends_with('\n') && !bytes_.ends_with('\r');
    }

    /// Once all elements are read: how many bytes of anything but blanks follow.
    std::size_t trailing_bytes() const;

    [[noreturn]] void fail(const PlyElement& element, std::uint64_t record,
                           const std::string& message) const;

  private:
    void parse_header();
    bool parse_header_line(std::string_view line);
    void parse_format(const std::vector<std::string_view>& tokens);
    void parse_element(const std::vector<std::string_view>& tokens);
    void count_declaration();
    void parse_property(const std::vector<std::string_view>& tokens);
    [[noreturn]] void fail_header(const std::string& message) const;

    std::string_view next_line();
    void read_ascii_record(const PlyElement& element, std::uint64_t index, PlyRecord& record);
    /// Appends the values of the next line that has any to the record, which files may break
    /// anywhere. Returns false at the end of the file.
    bool append_line();
    void read_binary_record(const PlyElement& element, std::uint64_t index, PlyRecord& record);
    /// Reads values that follow each other. Returns false where the file ends before.
    bool read_binary_values(PlyType type, std::span<double> values);

    enum class Format { ascii, little_endian, big_endian };

    Path path_;
    ReadingProgress progress_;
    std::string bytes_;
    std::size_t position_ = 0; ///< The next byte to read.
    std::size_t line_ = 0;     ///< 1-based, of the header line being parsed.
    std::optional<Format> format_;
    std::vector<PlyElement> elements_;
    std::vector<std::string> comments_;
    std::size_t declarations_ = 0; ///< Elements and properties.
    Found unknown_lines_;
    std::uint64_t surplus_lines_ = 0;
    char line_end_ = '\n';                 ///< CR in files that have no LF after it.
    std::vector<std::string_view> tokens_; ///< Tokens of the ascii record being parsed.
};

} // namespace geodisk::tools
