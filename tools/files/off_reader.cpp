#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/input_file.hpp"
#include "files/polygon_mesh.hpp"
#include "files/text_lines.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

class OffReader {
  public:
    OffReader(const Path& path, std::string_view bytes, const ReadingProgress& progress)
        : path_(path), size_(bytes.size()), lines_(bytes, progress) {}

    PolygonMesh read() && {
        read_header();
        for (std::uint64_t v = 0; v < vertices_; ++v) {
            read_vertex(v);
        }
        for (std::uint64_t f = 0; f < faces_; ++f) {
            read_face(f);
        }
        std::uint64_t left = 0;
        while (next_record()) {
            ++left;
        }
        add_warning(mesh_.warnings, "trailing_data", left, "", "line after the last face ignored",
                    "lines after the last face ignored");
        return std::move(mesh_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        fail_input(path_, "line " + std::to_string(lines_.number()) + ": " + message);
    }

    /// The tokens of the next line that has any besides a comment.
    bool next_record() {
        std::string_view line;
        tokens_.clear();
        while (tokens_.empty() && lines_.next(line)) {
            if (line.find('\0') != std::string_view::npos) {
                fail("contains a NUL byte, so this is not a text file");
            }
            split_tokens(line.substr(0, line.find('#')), tokens_);
        }
        return !tokens_.empty();
    }

    void need_record(const char* element, std::uint64_t index) {
        if (!next_record()) {
            fail_input(path_, std::string("the file ends before ") + element + ' ' +
                                  std::to_string(index));
        }
    }

    /// What the letters before OFF tell: vertex lines have more after the coordinates.
    void check_keyword(std::string_view keyword) const {
        std::string_view rest = keyword;
        for (const std::string_view part : {"ST", "C", "N"}) {
            rest.remove_prefix(rest.starts_with(part) ? part.size() : 0);
        }
        if (rest == "4OFF" || rest == "nOFF" || rest == "4nOFF") {
            fail(in_quotes(keyword) + " has vertices of other than 3 coordinates; PLY files may");
        }
        if (rest != "OFF") {
            fail_input(path_, "is not an OFF file: it does not begin with 'OFF'");
        }
    }

    void read_header() {
        if (!next_record()) {
            fail_input(path_, "is empty");
        }
        check_keyword(tokens_[0]);
        if (tokens_.size() > 1 && tokens_[1] == "BINARY") {
            fail("a binary OFF file; only text is read");
        }
        tokens_.erase(tokens_.begin()); // The counts may stand on the same line.
        if (tokens_.empty() && !next_record()) {
            fail("the file ends before the numbers of vertices and faces");
        }
        const auto count = [this](std::size_t i) {
            const auto value =
                i < tokens_.size() ? parse_integer<std::uint64_t>(tokens_[i]) : std::nullopt;
            if (!value || *value > std::numeric_limits<std::uint32_t>::max()) {
                fail("the numbers of vertices, faces and edges are expected");
            }
            return *value;
        };
        vertices_ = count(0);
        faces_ = count(1);
        // A line has at least so many bytes; the file may promise more.
        mesh_.positions.reserve(3 * std::min<std::uint64_t>(vertices_, size_ / 6));
        mesh_.face_ends.reserve(std::min<std::uint64_t>(faces_, size_ / 2));
    }

    void read_vertex(std::uint64_t index) {
        need_record("vertex", index);
        if (tokens_.size() < 3) {
            fail("a vertex needs 3 coordinates");
        }
        for (std::size_t i = 0; i < 3; ++i) {
            const std::optional<double> value = parse_real(tokens_[i]);
            if (!value) {
                fail(in_quotes(tokens_[i]) + " is not a number");
            }
            mesh_.positions.push_back(*value);
        }
        mesh_.names.vertex_lines.push_back(lines_.number());
    }

    /// Colours may follow the corners.
    void read_face(std::uint64_t index) {
        need_record("face", index);
        const auto count = parse_integer<std::uint64_t>(tokens_[0]);
        if (!count) {
            fail(in_quotes(tokens_[0]) + " is not a number of corners");
        }
        if (*count > tokens_.size() - 1) {
            fail("the face has fewer than its " + grouped(*count) + " corners");
        }
        for (std::size_t i = 1; i <= *count; ++i) {
            const auto corner = parse_integer<std::uint32_t>(tokens_[i]);
            if (!corner || *corner >= vertices_) {
                fail("vertex index " + in_quotes(tokens_[i]) + " is out of range, the file has " +
                     std::to_string(vertices_) + " vertices");
            }
            mesh_.corners.push_back(*corner);
        }
        mesh_.face_ends.push_back(mesh_.corners.size());
        mesh_.names.face_lines.push_back(lines_.number());
    }

    const Path& path_;
    std::size_t size_;
    TextLines lines_;
    std::vector<std::string_view> tokens_;
    std::uint64_t vertices_ = 0, faces_ = 0;
    PolygonMesh mesh_;
};

} // namespace

PolygonMesh read_off(const Path& path, const ReadingProgress& progress) {
    const std::string bytes = read_file(path);
    return OffReader(path, bytes, progress).read();
}

} // namespace geodisk::tools
