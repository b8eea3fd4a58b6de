#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/byte_order.hpp"
#include "files/input_file.hpp"
#include "files/meshes/polygon_mesh.hpp"
#include "files/text_file.hpp"
#include "files/text_lines.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::size_t kHeaderSize = 80;
constexpr std::size_t kCountSize = 4;
constexpr std::size_t kFacetSize = 50; ///< Normal, three vertices, and two bytes of anything.
constexpr std::size_t kNormalSize = 12;

/// Adds the last three vertices as a face.
void add_face(PolygonMesh& mesh) {
    const std::size_t end = mesh.positions.size() / 3;
    for (std::size_t v = end - 3; v < end; ++v) {
        mesh.corners.push_back(static_cast<std::uint32_t>(v));
    }
    mesh.face_ends.push_back(mesh.corners.size());
}

void check_count(const Path& path, std::uint64_t facets) {
    if (3 * facets > std::numeric_limits<std::uint32_t>::max()) {
        fail_input(path, "has more facets than can be numbered");
    }
}

PolygonMesh read_binary(const Path& path, std::string_view bytes, const ReadingProgress& progress) {
    const std::uint64_t count = value_of_bytes<std::uint32_t>(bytes.data() + kHeaderSize);
    check_count(path, count);
    std::string_view rest = bytes.substr(kHeaderSize + kCountSize);
    if (rest.size() / kFacetSize < count) {
        fail_input(path, "facet " + std::to_string(rest.size() / kFacetSize) +
                             ": the file ends inside it or before, of " + std::to_string(count) +
                             " facets");
    }
    PolygonMesh mesh;
    mesh.names = {"facet ", "vertex ", {}, {}, 0};
    mesh.positions.reserve(9 * count);
    mesh.corners.reserve(3 * count);
    mesh.face_ends.reserve(count);
    for (std::uint64_t facet = 0; facet < count; ++facet) {
        std::array<double, 9> coordinates;
        numbers_of_bytes<float>(rest.data() + kNormalSize, true, coordinates);
        mesh.positions.insert(mesh.positions.end(), coordinates.begin(), coordinates.end());
        add_face(mesh);
        rest.remove_prefix(kFacetSize);
        tell(progress, facet, facet, count);
    }
    add_warning(mesh.warnings, "trailing_data", rest.size(), "",
                "byte after the last facet ignored", "bytes after the last facet ignored");
    return mesh;
}

class AsciiReader {
  public:
    AsciiReader(const Path& path, std::string_view bytes, const ReadingProgress& progress)
        : path_(path), lines_(bytes, progress) {
        mesh_.names = {"facet ", "vertex ", {}, {}, 0};
    }

    PolygonMesh read() && {
        std::string_view line;
        while (lines_.next(line)) {
            if (line.find('\0') != std::string_view::npos) {
                fail(lines_.nul_message());
            }
            split_tokens(line, tokens_);
            if (!tokens_.empty()) {
                read_record(lower_case(std::string(tokens_[0])));
            }
        }
        if (in_facet_) {
            fail("the file ends inside a facet");
        }
        add_warning(mesh_.warnings, "cut_short", in_solid_ ? 1 : 0, "",
                    "solid is not ended by endsolid: the file may be cut short", "");
        return std::move(mesh_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        fail_input(path_, "line " + std::to_string(lines_.number()) + ": " + message);
    }

    void read_record(std::string_view keyword) {
        if (keyword == "facet") {
            begin_facet();
        } else if (keyword == "vertex") {
            add_vertex();
        } else if (keyword == "endfacet") {
            end_facet();
        } else if (keyword == "solid" || keyword == "endsolid") {
            if (in_facet_) {
                fail("a facet is not ended");
            }
            in_solid_ = keyword == "solid";
        } else if (keyword == "end" && tokens_.size() > 1) { // "end facet"
            tokens_.erase(tokens_.begin());
            read_record("end" + lower_case(std::string(tokens_[0])));
        } else if (keyword != "outer" && keyword != "endloop") {
            fail("unknown record " + in_quotes(tokens_[0]));
        }
    }

    void begin_facet() {
        if (in_facet_) {
            fail("a facet begins inside another one");
        }
        in_facet_ = true;
        vertices_ = 0;
        mesh_.names.face_lines.push_back(lines_.number());
        check_count(path_, mesh_.names.face_lines.size());
    }

    void add_vertex() {
        if (!in_facet_) {
            fail("a vertex is outside of facets");
        }
        if (tokens_.size() != 4) {
            fail("a vertex is three numbers");
        }
        if (++vertices_ > 3) {
            fail("a facet has three vertices, not more");
        }
        for (std::size_t i = 1; i < 4; ++i) {
            const std::optional<double> value = parse_real(tokens_[i]);
            if (!value) {
                fail(in_quotes(tokens_[i]) + " is not a number");
            }
            mesh_.positions.push_back(*value);
        }
        mesh_.names.vertex_lines.push_back(lines_.number());
    }

    void end_facet() {
        if (!in_facet_ || vertices_ != 3) {
            fail(in_facet_ ? "a facet has three vertices, not " + std::to_string(vertices_)
                           : "no facet is to be ended here");
        }
        in_facet_ = false;
        add_face(mesh_);
    }

    const Path& path_;
    TextLines lines_;
    std::vector<std::string_view> tokens_;
    PolygonMesh mesh_;
    bool in_solid_ = false, in_facet_ = false;
    int vertices_ = 0; ///< Vertices of the facet so far.
};

/// Some binary files begin with "solid" as well; these have just the size they tell, or a count
/// with a zero byte where text has none.
bool has_binary_size(std::string_view bytes) {
    return bytes.size() >= kHeaderSize + kCountSize &&
           bytes.size() ==
               kHeaderSize + kCountSize +
                   kFacetSize *
                       std::uint64_t{value_of_bytes<std::uint32_t>(bytes.data() + kHeaderSize)};
}

bool begins_with_solid(std::string_view bytes) {
    const std::size_t text = bytes.find_first_not_of(" \t\r\n", text_begin(bytes));
    return text != std::string_view::npos &&
           lower_case(std::string(bytes.substr(text, 5))) == "solid";
}

} // namespace

PolygonMesh read_stl(const Path& path, const ReadingProgress& progress) {
    std::string bytes = read_file(path);
    if (bytes.empty()) {
        fail_input(path, "is empty");
    }
    if (has_binary_size(bytes)) {
        return read_binary(path, bytes, progress);
    }
    refuse_other_content(path, bytes);
    refuse_other_mesh(path, bytes, ".stl");
    const std::string_view head = std::string_view(bytes).substr(0, kHeaderSize + kCountSize);
    const bool has_binary_head =
        head.size() == kHeaderSize + kCountSize && head.find('\0') != std::string_view::npos;
    if (!begins_with_solid(bytes) || has_binary_head) {
        if (head.size() == kHeaderSize + kCountSize) {
            return read_binary(path, bytes, progress);
        }
        fail_input(path, "is not an STL file: it is too short for a binary one and does not begin "
                         "with 'solid'");
    }
    const std::size_t nuls = drop_final_nuls(bytes);
    PolygonMesh mesh = AsciiReader(path, bytes, progress).read();
    warn_of_final_nuls(mesh, nuls);
    return mesh;
}

} // namespace geodisk::tools
