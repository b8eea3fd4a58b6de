// Labels of vertices of FreeSurfer: annotations, which give each vertex one, and lists of the
// vertices of one.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "files/byte_order.hpp"
#include "files/input_file.hpp"
#include "files/meshes/value_files.hpp"
#include "files/text_file.hpp"
#include "files/text_lines.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::string_view kLabelMagic = "#!ascii label", kLabelExtension = ".label";
constexpr double kNoLabel = -1;

/// The numbers and texts of an annotation, in turn.
class AnnotationBytes {
  public:
    AnnotationBytes(const Path& path, std::string_view bytes) : path_(&path), bytes_(bytes) {}

    std::int32_t number(const char* what) {
        constexpr bool kLowestFirst = false;
        if (left() < sizeof(std::int32_t)) {
            fail("the file ends before " + std::string(what));
        }
        const auto value = value_of_bytes<std::int32_t>(bytes_.data() + at_, kLowestFirst);
        at_ += sizeof value;
        return value;
    }

    /// Returns a number of things that take at least `size` bytes each.
    std::size_t count(const char* what, std::size_t size) {
        const std::size_t begin = at_;
        const std::int32_t value = number(what);
        if (value < 0 || static_cast<std::size_t>(value) > left() / size) {
            at_ = begin;
            fail(std::string(what) + " is " + std::to_string(value) + ", but " + grouped(left()) +
                 " bytes are left");
        }
        return static_cast<std::size_t>(value);
    }

    /// Returns a text, which NUL may end early, behind its length.
    std::string text(const char* what) {
        const std::size_t size = count(what, 1);
        const std::string_view text = bytes_.substr(at_, size);
        at_ += text.size();
        return std::string(text.substr(0, text.find('\0')));
    }

    bool at_end() const { return left() == 0; }
    [[noreturn]] void fail(const std::string& message) const {
        fail_input(*path_, "byte " + std::to_string(at_) + ": " + message);
    }

  private:
    std::size_t left() const { return bytes_.size() - at_; }

    const Path* path_;
    std::string_view bytes_;
    std::size_t at_ = 0;
};

/// What vertices are marked by, and the labels that this means.
struct ColourTable {
    std::vector<ValueName> names;
    std::unordered_map<std::int32_t, double> labels; ///< By colour.
};

constexpr std::size_t kColourBytes = 4 * sizeof(std::int32_t);

/// Adds the label of that number, whose name and colour follow.
void read_label(AnnotationBytes& bytes, double number, ColourTable& table) {
    table.names.push_back({bytes.text("the length of the name of a label"), number});
    std::uint32_t colour = 0;
    for (const int shift : {0, 8, 16}) {
        colour |= static_cast<std::uint32_t>(bytes.number("the colour of a label")) << shift;
    }
    bytes.number("the transparency of a label");
    // Vertices tell no label from another one of the same colour.
    table.names.back().value =
        table.labels.emplace(static_cast<std::int32_t>(colour), number).first->second;
}

/// Reads the table of either form: labels in order, or with their numbers.
ColourTable read_table(AnnotationBytes& bytes) {
    constexpr std::int32_t kVersion = -2;
    constexpr std::size_t kTextBytes = sizeof(std::int32_t);
    const AnnotationBytes begin = bytes;
    ColourTable table;
    if (const std::int32_t form = bytes.number("its colour table"); form >= 0) {
        bytes = begin;
        const std::size_t count = bytes.count("the number of labels", kTextBytes + kColourBytes);
        bytes.text("the length of the name of the table");
        for (std::size_t i = 0; i < count; ++i) {
            read_label(bytes, static_cast<double>(i), table);
        }
        return table;
    } else if (form != kVersion) {
        begin.fail("the colour table has version " + std::to_string(-std::int64_t{form}) +
                   "; version 2 is read");
    }
    bytes.number("the largest number of a label");
    bytes.text("the length of the name of the table");
    const std::size_t count = bytes.count("the number of labels", 2 * kTextBytes + kColourBytes);
    for (std::size_t i = 0; i < count; ++i) {
        const std::int32_t number = bytes.number("the number of a label");
        if (number < 0) {
            bytes.fail("a label has the number " + std::to_string(number));
        }
        read_label(bytes, number, table);
    }
    return table;
}

} // namespace

VertexValues read_freesurfer_annotation(const Path& path, std::string_view content) {
    AnnotationBytes bytes(path, content);
    const std::size_t count = bytes.count("the number of vertices", 2 * sizeof(std::int32_t));
    std::vector<std::int32_t> colours(count);
    std::vector<bool> is_known(count, false);
    for (std::size_t i = 0; i < count; ++i) {
        const AnnotationBytes begin = bytes;
        const std::int32_t vertex = bytes.number("a vertex");
        const auto index = static_cast<std::size_t>(vertex);
        if (vertex < 0 || index >= count) {
            begin.fail("vertex " + std::to_string(vertex) + " is out of range, the file has " +
                       counted(count, "vertex", "vertices"));
        }
        if (is_known[index]) {
            begin.fail("vertex " + std::to_string(vertex) + " has two labels");
        }
        is_known[index] = true;
        colours[index] = bytes.number("the label of a vertex");
    }
    if (bytes.at_end() || bytes.number("its colour table") == 0) {
        fail_input(path, "has no colour table, which numbers and names its labels");
    }
    ColourTable table = read_table(bytes);
    VertexValues result;
    result.is_whole = true;
    result.values.reserve(count);
    for (const std::int32_t colour : colours) {
        const auto found = table.labels.find(colour);
        result.values.push_back(found == table.labels.end() ? kNoLabel : found->second);
    }
    result.names = std::move(table.names);
    return result;
}

bool is_freesurfer_label(const Path& path, std::string_view bytes) {
    return bytes.starts_with(kLabelMagic) || lower_extension(path) == kLabelExtension;
}

VertexValues read_freesurfer_label(const Path& path, std::string_view bytes,
                                   std::size_t vertex_count) {
    refuse_other_content(path, bytes);
    TextLines lines(bytes);
    std::vector<std::string_view> words;
    const auto fail = [&](const std::string& message) {
        fail_input(path, "line " + std::to_string(lines.number()) + ": " + message);
    };
    const auto next_words = [&] {
        std::string_view line;
        for (words.clear(); words.empty() && lines.next(line);) {
            if (line.find('\0') != line.npos) {
                fail(lines.nul_message());
            }
            split_tokens(without_comment(line), words);
        }
        return !words.empty();
    };
    if (!next_words()) {
        fail_input(path, "ends before its number of vertices");
    }
    const auto count = parse_integer<std::uint32_t>(words[0]);
    if (!count || words.size() != 1) {
        fail("has no number of vertices, as a list of FreeSurfer does after its comment");
    }
    VertexValues result;
    result.is_whole = true;
    result.values.assign(vertex_count, 0);
    std::size_t width = 0;
    for (std::uint32_t i = 0; i < *count; ++i) {
        if (!next_words()) {
            fail_input(path,
                       "ends after " + grouped(i) + " of " + counted(*count, "vertex", "vertices"));
        }
        width = i == 0 ? words.size() : width;
        if (words.size() != width) { // Such as one that is cut off.
            fail("has " + counted(words.size(), "word", "words") +
                 ", but the first line of a vertex " + std::to_string(width));
        }
        if (words[0] == "-1") {
            fail("has a point of space instead of a vertex (-1); assign it to the surface first, "
                 "such as by mri_label2label");
        }
        const auto vertex = parse_integer<std::uint32_t>(words[0]);
        if (!vertex) {
            fail(in_quotes(words[0]) + " is not the number of a vertex");
        }
        if (*vertex >= vertex_count) {
            fail("vertex " + std::to_string(*vertex) + " is out of range, the mesh has " +
                 counted(vertex_count, "vertex", "vertices"));
        }
        result.values[*vertex] = 1;
    }
    if (next_words()) {
        fail("follows the last of " + counted(*count, "vertex", "vertices"));
    }
    return result;
}

} // namespace geodisk::tools
