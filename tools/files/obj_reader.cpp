// tinyobjloader does the parsing but forgives: it reads a bad number as 0 and rounds a good one
// several bits off, lets indices wrap, and knows no line continuation. So check_records() first
// copies the records that matter, one per line, keeps the coordinates, and refuses what
// tinyobjloader would take silently.
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string_view>

#include <tiny_obj_loader.h>

#include "files/input_file.hpp"
#include "files/polygon_mesh.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Steps through the logical lines of a text: continued lines joined, comments removed.
class LineReader {
  public:
    explicit LineReader(std::string_view text) : rest_(text) {
        constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
        if (rest_.starts_with(kByteOrderMark)) {
            rest_.remove_prefix(kByteOrderMark.size());
        }
    }

    /// The next line in `line`, its (first) number in number(); false at the end.
    bool next(std::string& line) {
        if (rest_.empty()) {
            return false;
        }
        number_ = next_number_;
        line.clear();
        bool continued = true;
        while (continued && !rest_.empty()) {
            std::string_view part = take_physical_line();
            const std::size_t comment = part.find('#');
            continued = comment == std::string_view::npos && part.ends_with('\\');
            line += part.substr(0, continued ? part.size() - 1 : comment);
        }
        return true;
    }

    std::uint32_t number() const noexcept { return number_; }

  private:
    std::string_view take_physical_line() {
        const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
        const std::string_view line = rest_.substr(0, end);
        const bool crlf = rest_.substr(end).starts_with("\r\n");
        rest_.remove_prefix(std::min(end + (crlf ? 2u : 1u), rest_.size()));
        ++next_number_;
        return line;
    }

    std::string_view rest_;
    std::uint32_t number_ = 0;
    std::uint32_t next_number_ = 1;
};

/// The clean text for tinyobjloader, and where its records stood.
struct CheckedRecords {
    std::string text;
    std::vector<double> positions;
    std::vector<double> uvs;
    std::vector<std::uint32_t> vertex_lines;
    std::vector<std::uint32_t> face_lines;
};

[[noreturn]] void fail_line(const Path& path, std::uint32_t line, const std::string& message) {
    fail_input(path, "line " + std::to_string(line) + ": " + message);
}

/// Why the `v` record is wrong, or "". Appends its coordinates, finite or not: that matters only
/// if a face uses the vertex.
std::string take_vertex(const std::vector<std::string_view>& tokens,
                        std::vector<double>& positions) {
    if (tokens.size() < 4) {
        return "a vertex needs 3 coordinates";
    }
    for (std::size_t i = 1; i < tokens.size(); ++i) { // Weight or colour may follow x y z.
        const std::optional<double> value = parse_real(tokens[i]);
        if (!value) {
            return in_quotes(tokens[i]) + " is not a number";
        }
        if (i <= 3) {
            positions.push_back(*value);
        }
    }
    return {};
}

/// Why the `vt` record is wrong, or "". Appends u and v.
std::string take_uv(const std::vector<std::string_view>& tokens, std::vector<double>& uvs) {
    if (tokens.size() < 3) {
        return "texture coordinates are two numbers";
    }
    for (std::size_t i = 1; i <= 2; ++i) { // A third one, of depth, may follow.
        const std::optional<double> value = parse_real(tokens[i]);
        if (!value || !std::isfinite(*value)) {
            return in_quotes(tokens[i]) + " is not a finite number";
        }
        uvs.push_back(*value);
    }
    return {};
}

bool is_integer(std::string_view text) {
    text.remove_prefix(text.starts_with('-') ? 1 : 0);
    return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// Why a corner "v", "v/vt", "v//vn" or "v/vt/vn" is wrong, or "".
std::string corner_fault(std::string_view corner) {
    std::string_view rest = corner;
    for (int part = 0; part < 3; ++part) {
        const std::size_t slash = std::min(rest.find('/'), rest.size());
        const std::string_view index = rest.substr(0, slash);
        // Normal indices are not used, and texture indices mostly; they have to be integers or
        // absent.
        const bool may_be_absent = part > 0;
        if (!is_integer(index) && !(may_be_absent && index.empty())) {
            return in_quotes(corner) + " is not a face corner";
        }
        if (part == 0 && parse_integer<int>(index).value_or(0) == 0) {
            return "vertex index " + in_quotes(index) + " is out of range";
        }
        if (slash == rest.size()) {
            return {};
        }
        rest.remove_prefix(slash + 1);
    }
    return in_quotes(corner) + " is not a face corner";
}

/// Why the `f` record is wrong, or "".
std::string face_fault(const std::vector<std::string_view>& tokens) {
    for (std::size_t i = 1; i < tokens.size(); ++i) {
        if (std::string fault = corner_fault(tokens[i]); !fault.empty()) {
            return fault;
        }
    }
    return tokens.size() < 4 ? "a face needs at least 3 corners" : "";
}

CheckedRecords check_records(const Path& path, std::string_view bytes, bool has_uvs) {
    CheckedRecords records;
    LineReader reader(bytes);
    std::string line;
    std::vector<std::string_view> tokens;
    while (reader.next(line)) {
        if (line.find('\0') != std::string::npos) {
            fail_line(path, reader.number(), "contains a NUL byte, so this is not a text file");
        }
        split_tokens(line, tokens);
        const std::string_view keyword = tokens.empty() ? std::string_view() : tokens[0];
        std::string fault;
        if (keyword == "v") {
            fault = take_vertex(tokens, records.positions);
            records.vertex_lines.push_back(reader.number());
        } else if (keyword == "vt" && has_uvs) {
            fault = take_uv(tokens, records.uvs);
        } else if (keyword == "f") {
            fault = face_fault(tokens);
            records.face_lines.push_back(reader.number());
        } else {
            continue;
        }
        if (!fault.empty()) {
            fail_line(path, reader.number(), fault);
        }
        records.text += line;
        records.text += '\n';
    }
    return records;
}

/// Receives tinyobjloader's callbacks.
struct MeshBuilder {
    const Path& path;
    PolygonMesh mesh;
    bool has_uvs = false;
    std::int64_t vertices_so_far = 0;
    std::int64_t uvs_so_far = 0;

    static void on_vertex(void* self, tinyobj::real_t, tinyobj::real_t, tinyobj::real_t,
                          tinyobj::real_t) {
        ++static_cast<MeshBuilder*>(self)->vertices_so_far;
    }

    static void on_uv(void* self, tinyobj::real_t, tinyobj::real_t, tinyobj::real_t) {
        ++static_cast<MeshBuilder*>(self)->uvs_so_far;
    }

    static void on_face(void* self, tinyobj::index_t* corners, int corner_count) {
        static_cast<MeshBuilder*>(self)->add_face(corners, corners + corner_count);
    }

    void add_face(const tinyobj::index_t* corner, const tinyobj::index_t* end) {
        for (; corner != end; ++corner) {
            const std::int64_t index = corner->vertex_index;
            const std::int64_t resolved = index > 0 ? index - 1 : vertices_so_far + index;
            if (resolved < 0) {
                fail_line(path, mesh.names.face_lines[mesh.face_ends.size()],
                          "vertex index " + std::to_string(index) + " is out of range, only " +
                              std::to_string(vertices_so_far) + " vertices come before it");
            }
            mesh.corners.push_back(static_cast<std::uint32_t>(resolved));
            if (has_uvs) {
                mesh.corner_uvs.push_back(uv_of(corner->texcoord_index));
            }
        }
        mesh.face_ends.push_back(mesh.corners.size());
    }

    std::uint32_t uv_of(std::int64_t index) const {
        if (index == 0) {
            return PolygonMesh::kNoUv;
        }
        const std::int64_t resolved = index > 0 ? index - 1 : uvs_so_far + index;
        if (resolved < 0 || resolved >= static_cast<std::int64_t>(mesh.uvs.size() / 2)) {
            fail_line(path, mesh.names.face_lines[mesh.face_ends.size()],
                      "texture index " + std::to_string(index) + " is out of range");
        }
        return static_cast<std::uint32_t>(resolved);
    }
};

} // namespace

PolygonMesh read_obj(const Path& path, bool has_uvs) {
    const std::string bytes = read_file(path);
    if (bytes.empty()) {
        fail_input(path, "is empty");
    }
    if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) {
        fail_input(path, "is a PLY file, so its name should end in .ply");
    }
    CheckedRecords records = check_records(path, bytes, has_uvs);
    if (records.vertex_lines.size() > std::numeric_limits<std::int32_t>::max()) {
        fail_input(path, "has more vertices than a face can refer to");
    }
    MeshBuilder builder{path, {}, has_uvs};
    builder.mesh.uvs = std::move(records.uvs);
    builder.mesh.names.vertex_lines = std::move(records.vertex_lines);
    builder.mesh.names.face_lines = std::move(records.face_lines);
    builder.mesh.names.first_vertex = 1;
    builder.mesh.positions = std::move(records.positions);
    builder.mesh.face_ends.reserve(builder.mesh.names.face_lines.size());

    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = MeshBuilder::on_vertex;
    callbacks.texcoord_cb = MeshBuilder::on_uv;
    callbacks.index_cb = MeshBuilder::on_face;
    std::istringstream stream(std::move(records.text));
    std::string error;
    const bool parsed =
        tinyobj::LoadObjWithCallback(stream, callbacks, &builder, nullptr, nullptr, &error);
    const std::size_t vertices_read = static_cast<std::size_t>(builder.vertices_so_far);
    if (!parsed || 3 * vertices_read != builder.mesh.positions.size() ||
        builder.mesh.face_ends.size() != builder.mesh.names.face_lines.size()) {
        fail_input(path, "tinyobjloader cannot parse it: " + in_quotes(error));
    }
    return std::move(builder.mesh);
}

} // namespace geodisk::tools
