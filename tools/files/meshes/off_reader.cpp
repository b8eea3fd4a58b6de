#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/meshes/polygon_mesh.hpp"
#include "files/text_file.hpp"
#include "files/text_lines.hpp"
#include "geometry/mesh.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

class OffReader {
  public:
    OffReader(const Path& path, std::string_view bytes, const WantedFields& fields,
              const ReadingProgress& progress)
        : path_(path), bytes_(bytes), lines_(bytes, progress), fields_(fields) {}

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
        give_fields();
        return std::move(mesh_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const { fail(lines_.number(), message); }
    [[noreturn]] void fail(std::uint32_t line, const std::string& message) const {
        fail_input(path_, "line " + std::to_string(line) + ": " + message);
    }

    /// Appends the tokens of the next line that has any besides a comment to the record. Returns
    /// false at the end of the file.
    bool append_line() {
        std::string_view line;
        const std::size_t before = tokens_.size();
        while (tokens_.size() == before && lines_.next(line)) {
            if (line.find('\0') != std::string_view::npos) {
                fail(lines_.nul_message());
            }
            append_tokens(without_comment(line), tokens_);
        }
        return tokens_.size() > before;
    }

    /// Begins the next record with a line. Returns false at the end of the file.
    bool next_record() {
        tokens_.clear();
        return append_line();
    }

    void need_record(const char* element, std::uint64_t index) {
        if (!next_record()) {
            fail_input(path_, std::string("the file ends before ") + element + ' ' +
                                  std::to_string(index));
        }
    }

    /// Adds further lines to the record until it has `count` tokens, as files need that break lines
    /// anywhere. Returns false if those lines end with other tokens than that.
    bool complete_record(std::uint64_t count) {
        while (tokens_.size() < count) {
            if (!append_line() || tokens_.size() > count) {
                return false;
            }
        }
        return true;
    }

    /// Takes the keyword off the first record. Letters before OFF tell that vertex lines have more
    /// after the coordinates, or how many these are.
    void take_keyword() {
        std::string_view rest = tokens_[0];
        for (const std::string_view part : {"ST", "C", "N", "C"}) { // Some write NCOFF.
            if (rest.starts_with(part)) {
                rest.remove_prefix(part.size());
                has_uvs_ |= part == "ST";
                has_normals_ |= part == "N";
                has_colours_ |= part == "C";
            }
        }
        if (rest == "4OFF" || rest == "4nOFF") {
            fail(in_quotes(tokens_[0]) + " has 4-D vertices (homogeneous: x y z w), which are not "
                                         "read; write them as nOFF or OFF");
        }
        has_dimension_ = rest.starts_with('n');
        rest.remove_prefix(has_dimension_ ? 1 : 0);
        if (!rest.starts_with("OFF")) {
            refuse_other_mesh(path_, bytes_, ".off");
            fail_input(path_, "is not an OFF file: it does not begin with 'OFF'");
        }
        rest.remove_prefix(3);
        if (rest.empty()) {
            tokens_.erase(tokens_.begin());
            return;
        }
        if (!parse_integer<std::uint64_t>(rest)) {
            fail_input(path_, "is not an OFF file: it does not begin with 'OFF'");
        }
        if (tokens_.size() < 3) {
            fail(in_quotes(tokens_[0]) + " is no keyword of OFF; points of 4 coordinates (4-D) are "
                                         "written as nOFF");
        }
        add_warning(mesh_.warnings, "glued_header", 1, "line " + std::to_string(lines_.number()),
                    "number behind OFF without a blank read as the number of vertices", "");
        tokens_[0] = rest;
    }

    /// Goes on to the next record if no token is left of this one.
    void need_tokens(const char* what) {
        if (tokens_.empty() && !next_record()) {
            fail(std::string("the file ends before ") + what);
        }
    }

    void take_dimension() {
        need_tokens("the number of coordinates");
        const auto dimension = parse_integer<std::uint32_t>(tokens_[0]);
        if (!dimension || *dimension < kFewestCoordinates || *dimension > kMaxCoordinates) {
            fail(in_quotes(tokens_[0]) + " is no number of coordinates; vertices have 3 to 8");
        }
        mesh_.dimension = *dimension;
        tokens_.erase(tokens_.begin());
    }

    void read_header() {
        if (!next_record()) {
            fail_input(path_, "is empty");
        }
        take_keyword(); // The counts may stand on the same line.
        if (!tokens_.empty() && tokens_[0] == "BINARY") {
            fail("a binary OFF file; only text is read");
        }
        if (has_dimension_) {
            take_dimension();
        }
        need_tokens("the numbers of vertices and faces");
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
        mesh_.positions.reserve(mesh_.dimension *
                                std::min<std::uint64_t>(vertices_, bytes_.size() / 6));
        mesh_.face_ends.reserve(std::min<std::uint64_t>(faces_, bytes_.size() / 2));
    }

    void read_vertex(std::uint64_t index) {
        need_record("vertex", index);
        const std::uint32_t line = lines_.number();
        if (!complete_record(mesh_.dimension)) {
            fail(line, "a vertex needs " + std::to_string(mesh_.dimension) + " coordinates");
        }
        for (std::size_t i = 0; i < mesh_.dimension; ++i) {
            const std::optional<double> value = parse_real(tokens_[i]);
            if (!value) {
                fail(in_quotes(tokens_[i]) + " is not a number");
            }
            mesh_.positions.push_back(*value);
        }
        read_attributes();
        mesh_.names.vertex_lines.push_back(line);
    }

    /// Reads what follows the coordinates: a normal, a colour, and texture coordinates.
    void read_attributes() {
        const bool any = (has_normals_ && fields_.normals) ||
                         (has_colours_ && fields_.has(kColourField)) ||
                         (has_uvs_ && fields_.has(kUvField));
        if (!any) {
            return;
        }
        const std::size_t normal = mesh_.dimension, colour = normal + (has_normals_ ? 3 : 0);
        const std::size_t others = colour + (has_uvs_ ? 2 : 0);
        const std::size_t components = tokens_.size() - std::min(tokens_.size(), others);
        colour_size_ = colour_size_ == 0 ? components : colour_size_;
        if (tokens_.size() < others ||
            (has_colours_ && (components < 3 || components > 4 || components != colour_size_))) {
            fail("a vertex needs all numbers that the first line of the file says: coordinates" +
                 std::string(has_normals_ ? ", a normal" : "") +
                 (has_colours_ ? ", a colour of 3 or of 4 numbers" : "") +
                 (has_uvs_ ? ", texture coordinates" : ""));
        }
        const std::size_t colours = has_colours_ ? components : 0;
        if (fields_.normals && has_normals_) {
            append(normals_, normal, 3);
        }
        if (has_colours_ && fields_.has(kColourField)) {
            append(colours_, colour, colours);
        }
        if (has_uvs_ && fields_.has(kUvField)) {
            append(mesh_.uvs, colour + colours, 2);
        }
    }

    /// Appends the numbers of this line from token `begin` on.
    void append(std::vector<double>& values, std::size_t begin, std::size_t count) const {
        for (std::size_t i = begin; i < begin + count; ++i) {
            const std::optional<double> value = parse_real(tokens_[i]);
            if (!value) {
                fail(in_quotes(tokens_[i]) + " is not a number");
            }
            values.push_back(*value);
        }
    }

    /// Puts the attributes that the file has into the mesh.
    void give_fields() {
        if (has_normals_) {
            mesh_.normals = make_field("normal", MeshField::Of::vertices, 3);
            mesh_.normals->values = std::move(normals_);
        }
        if (has_colours_) {
            mesh_.fields.push_back(make_colours(MeshField::Of::vertices, colour_size_));
            mesh_.fields.back().values = std::move(colours_);
            scale_colours(mesh_.fields.back());
        }
        if (has_uvs_) {
            mesh_.fields.push_back(make_uvs());
            mesh_.corner_uvs = mesh_.corners;
        }
    }

    /// Colours may follow the corners.
    void read_face(std::uint64_t index) {
        need_record("face", index);
        const std::uint32_t line = lines_.number();
        const auto count = parse_integer<std::uint64_t>(tokens_[0]);
        if (!count) {
            fail(in_quotes(tokens_[0]) + " is not a number of corners");
        }
        if (*count > bytes_.size() || !complete_record(*count + 1)) {
            fail(line, "the face has fewer than its " + grouped(*count) + " corners");
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
        mesh_.names.face_lines.push_back(line);
    }

    const Path& path_;
    std::string_view bytes_;
    TextLines lines_;
    std::vector<std::string_view> tokens_;
    std::uint64_t vertices_ = 0, faces_ = 0;
    PolygonMesh mesh_;
    bool has_dimension_ = false; ///< The number of coordinates follows the keyword.
    const WantedFields& fields_;
    bool has_uvs_ = false, has_normals_ = false, has_colours_ = false; ///< Vertices have them.
    std::size_t colour_size_ = 0; ///< Size of the first vertex's colour.
    std::vector<double> normals_, colours_;
};

} // namespace

PolygonMesh read_off(const Path& path, const WantedFields& fields,
                     const ReadingProgress& progress) {
    std::string bytes = read_text(path);
    const std::size_t nuls = drop_final_nuls(bytes);
    PolygonMesh mesh = OffReader(path, bytes, fields, progress).read();
    warn_of_final_nuls(mesh, nuls);
    return mesh;
}

} // namespace geodisk::tools
