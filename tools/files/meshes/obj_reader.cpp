// A parser of our own. The libraries at hand read a bad number as 0 and a good one several bits
// off, let indices wrap and do not tell of lines, so that every record would have to be parsed here
// first in any case. Where tinyobjloader reads all a file holds, a test compares the two.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/meshes/mtl_reader.hpp"
#include "files/meshes/mtl_records.hpp"
#include "files/meshes/obj_lines.hpp"
#include "files/meshes/polygon_mesh.hpp"
#include "files/name_text.hpp"
#include "files/text_file.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::uint32_t kNone = PolygonMesh::kNoUv;

bool is_integer(std::string_view text) {
    text.remove_prefix(text.starts_with('-') ? 1 : 0);
    return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// Indices that nothing is taken from, so that one out of range is odd and no more.
class UnusedIndices {
  public:
    void add_record() { ++records_; }

    /// `index` as written, of a corner of `face`.
    void add(std::int64_t index, std::uint64_t face) {
        if (index > records_) {
            ahead_.push_back({index, face}); // The record may follow.
        } else if (index == 0 || -index > records_) {
            bad_.add(face);
        }
    }

    Found bad() const {
        Found bad = bad_;
        for (const auto& [index, face] : ahead_) {
            if (index > records_) {
                bad.add(face);
            }
        }
        return bad;
    }

  private:
    std::int64_t records_ = 0;
    Found bad_;
    std::vector<std::pair<std::int64_t, std::uint64_t>> ahead_;
};

/// The parts that materials, groups and objects divide the faces into.
class ObjParts {
  public:
    /// Takes the words of a record; ignores other records.
    void take(Words words) {
        if (words.empty()) {
            return;
        }
        if (words[0] == "usemtl") {
            material_ = number_of(materials_, names_.materials,
                                  readable_name(joined_text(words.subspan(1))));
        } else if (words[0] == "g") {
            groups_.clear();
            for (const std::string_view name : words.subspan(1)) {
                groups_.push_back(number_of(known_groups_, names_.groups, readable_name(name)));
            }
        } else if (words[0] == "o") {
            object_ = number_of(known_groups_, names_.groups,
                                readable_name(joined_text(words.subspan(1))));
        } else {
            return;
        }
        current_.reset();
    }

    /// Returns the part of a face that comes next.
    std::uint32_t current() {
        if (!current_) {
            MeshPart part;
            part.material = material_;
            part.groups = groups_;
            if (object_) {
                part.groups.push_back(*object_);
            }
            const auto [known, is_new] = known_.try_emplace(
                {part.material, part.groups}, static_cast<std::uint32_t>(parts_.size()));
            if (is_new) {
                parts_.push_back(std::move(part));
            }
            current_ = known->second;
        }
        return *current_;
    }

    /// Puts them into the mesh, if the file divides its faces at all.
    void give(PolygonMesh& mesh) {
        if (names_.materials.empty() && names_.groups.empty()) {
            mesh.part_of_face.clear();
            mesh.part_of_face.shrink_to_fit();
            return;
        }
        mesh.parts = std::move(parts_);
        mesh.part_names = std::move(names_);
    }

  private:
    using Numbers = std::map<std::string, std::uint32_t>;

    static std::uint32_t number_of(Numbers& known, std::vector<std::string>& names,
                                   const std::string& name) {
        const auto [found, is_new] =
            known.try_emplace(name, static_cast<std::uint32_t>(names.size()));
        if (is_new) {
            names.push_back(name);
        }
        return found->second;
    }

    PartNames names_;
    Numbers materials_, known_groups_;
    std::optional<std::uint32_t> material_, object_;
    std::vector<std::uint32_t> groups_;
    std::optional<std::uint32_t> current_;
    std::map<std::pair<std::optional<std::uint32_t>, std::vector<std::uint32_t>>, std::uint32_t>
        known_;
    std::vector<MeshPart> parts_;
};

class ObjReader {
  public:
    ObjReader(const Path& path, std::string_view bytes, const WantedFields& fields,
              const FileScope& scope, const ReadingProgress& progress)
        : path_(path), scope_(scope), lines_(bytes, progress),
          has_uvs_(fields.materials || fields.has(kUvField)), has_normals_(fields.normals),
          has_colours_(fields.has(kColourField)), has_materials_(fields.materials),
          needs_uvs_(fields.needs(kUvField)) {
        mesh_.names.first_vertex = 1;
    }

    PolygonMesh read() && {
        std::string_view line;
        while (lines_.next(line)) {
            line_ = lines_.number();
            if (line.find('\0') != std::string_view::npos) {
                fail(lines_.nul_message());
            }
            split_tokens(line, tokens_);
            const std::string_view keyword = tokens_.empty() ? std::string_view() : tokens_[0];
            if (keyword == "v") {
                add_vertex();
            } else if (keyword == "f") {
                add_face();
            } else if (keyword == "vt") {
                add_uv();
            } else if (keyword == "vn") {
                add_normal();
            } else if (keyword == "mtllib") {
                libraries_.push_back(joined_text(Words(tokens_).subspan(1)));
            } else {
                parts_.take(tokens_);
            }
        }
        try_uvs([&] { check_indices("texture", mesh_.corner_uvs, uv_count_); });
        check_indices("normal", normals_.corners, normal_count_);
        warn_of_indices();
        give_fields();
        parts_.give(mesh_);
        if (has_materials_ && !libraries_.empty()) {
            mesh_.materials =
                read_mtl_files(path_, libraries_, used_materials(), scope_, mesh_.warnings);
        }
        return std::move(mesh_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const { fail_at(line_, message); }
    [[noreturn]] void fail_at(std::uint32_t line, const std::string& message) const {
        fail_input(path_, "line " + std::to_string(line) + ": " + message);
    }

    double number(std::string_view token) const {
        const std::optional<double> value = parse_real(token);
        if (!value) {
            fail(in_quotes(token) + " is not a number");
        }
        return *value;
    }

    /// Coordinates need be finite only where a face uses the vertex.
    void add_vertex() {
        const std::size_t vertex = mesh_.names.vertex_lines.size();
        is_flat_ = vertex == 0 ? tokens_.size() == 3 : is_flat_;
        if (tokens_.size() < 4 && !(is_flat_ && tokens_.size() == 3)) {
            fail("a vertex needs 3 coordinates");
        }
        if (is_flat_ && tokens_.size() > 3) {
            fail("has " + std::to_string(tokens_.size() - 1) +
                 " coordinates, but vertices before have 2");
        }
        const bool has_colour = tokens_.size() >= 7;
        for (std::size_t i = 1; i < tokens_.size(); ++i) { // Weight or colour may follow x y z.
            const double value = number(tokens_[i]);
            if (i <= 3) {
                mesh_.positions.push_back(value);
            } else if (has_colours_ && has_colour && i <= 6) {
                colours_.values.push_back(value);
            }
        }
        if (is_flat_) {
            mesh_.positions.push_back(0);
        }
        if (has_colour && has_colours_) {
            vertex_colours_.resize(vertex, kNone);
            vertex_colours_.push_back(colour_count_);
        }
        colour_count_ += has_colour ? 1 : 0;
        mesh_.names.vertex_lines.push_back(line_);
    }

    void add_normal() {
        unused_normals_.add_record();
        ++normal_count_;
        if (!has_normals_) {
            return;
        }
        if (tokens_.size() < 4) {
            fail("a normal needs 3 coordinates");
        }
        for (std::size_t i = 1; i <= 3; ++i) {
            normals_.values.push_back(number(tokens_[i]));
        }
    }

    void add_uv() {
        unused_uvs_.add_record();
        ++uv_count_;
        if (!has_uvs_) {
            return;
        }
        try_uvs([&] {
            if (tokens_.size() < 3) {
                fail("texture coordinates are two numbers");
            }
            for (std::size_t i = 1; i <= 2; ++i) { // A third one, of depth, may follow.
                const std::optional<double> value = parse_real(tokens_[i]);
                if (!value || !std::isfinite(*value)) {
                    fail(in_quotes(tokens_[i]) + " is not a finite number");
                }
                mesh_.uvs.push_back(*value);
            }
        });
    }

    /// Reads texture coordinates; leaves them out if that fails and they are not needed.
    template <class Read>
    void try_uvs(const Read& read) {
        try {
            read();
        } catch (const UserError& error) {
            if (needs_uvs_) {
                throw;
            }
            if (!std::exchange(mesh_.has_lost_uvs, true)) {
                warn_left_out(path_, kUvField, error, mesh_.warnings);
            }
        }
    }

    void add_face() {
        for (std::size_t i = 1; i < tokens_.size(); ++i) {
            add_corner(tokens_[i]);
        }
        mesh_.face_ends.push_back(mesh_.corners.size());
        mesh_.part_of_face.push_back(parts_.current());
        mesh_.names.face_lines.push_back(line_);
    }

    /// "v", "v/vt", "v//vn" or "v/vt/vn".
    void add_corner(std::string_view corner) {
        std::string_view parts[3];
        std::string_view rest = corner;
        bool has_more = true;
        for (std::size_t part = 0; part < 3 && has_more; ++part) {
            const std::size_t slash = rest.find('/');
            has_more = slash != std::string_view::npos;
            parts[part] = rest.substr(0, slash);
            rest.remove_prefix(has_more ? slash + 1 : rest.size());
            const bool may_be_absent = part > 0;
            if (!is_integer(parts[part]) && !(may_be_absent && parts[part].empty())) {
                fail(in_quotes(corner) + " is not a face corner");
            }
        }
        if (has_more) {
            fail(in_quotes(corner) + " is not a face corner");
        }
        mesh_.corners.push_back(resolve("vertex", parts[0], mesh_.names.vertex_lines.size()));
        if (has_uvs_) {
            mesh_.corner_uvs.push_back(kNone);
            if (!parts[1].empty()) {
                try_uvs([&] { mesh_.corner_uvs.back() = resolve("texture", parts[1], uv_count_); });
            }
        } else {
            add_unused(unused_uvs_, parts[1]);
        }
        if (has_normals_) {
            normals_.corners.push_back(
                parts[2].empty() ? kNone : resolve("normal", parts[2], normal_count_));
        } else {
            add_unused(unused_normals_, parts[2]);
        }
    }

    /// From 0. One of `count` records so far, or of those that follow.
    std::uint32_t resolve(const char* what, std::string_view text, std::size_t count) const {
        const std::int64_t index = parse_integer<std::int64_t>(text).value_or(0);
        const auto so_far = static_cast<std::int64_t>(count);
        if (index == 0 || index >= kNone) { // A number that does not fit counts as 0.
            fail(std::string(what) + " index " + in_quotes(text) + " is out of range");
        }
        if (index < -so_far) {
            const std::string records =
                what == std::string_view("vertex") ? " vertices" : " records";
            fail(std::string(what) + " index " + std::to_string(index) + " is out of range, only " +
                 std::to_string(count) + records + " come before it");
        }
        return static_cast<std::uint32_t>(index > 0 ? index - 1 : so_far + index);
    }

    void add_unused(UnusedIndices& indices, std::string_view text) const {
        if (!text.empty()) {
            constexpr std::int64_t kFar = std::numeric_limits<std::int64_t>::max();
            indices.add(parse_integer<std::int64_t>(text).value_or(kFar), mesh_.face_ends.size());
        }
    }

    /// Checks the indices of corners, now that the number of records is known.
    void check_indices(const std::string& what, const std::vector<std::uint32_t>& corners,
                       std::size_t count) const {
        std::size_t face = 0;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            while (i >= mesh_.face_ends[face]) {
                ++face;
            }
            if (corners[i] != kNone && corners[i] >= count) {
                fail_at(mesh_.names.face_lines[face],
                        what + " index " + std::to_string(corners[i] + std::int64_t{1}) +
                            " is out of range");
            }
        }
    }

    /// Puts the attributes that the file has into the mesh.
    void give_fields() {
        if (colour_count_ > 0) {
            give_colours();
        }
        if (uv_count_ > 0 && !mesh_.has_lost_uvs) {
            mesh_.fields.push_back(make_uvs());
        }
        if (has_normals_ && normal_count_ > 0) {
            mesh_.normals = std::move(normals_);
        }
    }

    /// Returns the names of materials that faces use, by number.
    std::vector<std::optional<std::string>> used_materials() const {
        std::vector<std::optional<std::string>> names(mesh_.part_names.materials.size());
        for (const MeshPart& part : mesh_.parts) {
            if (part.material) {
                names[*part.material] = mesh_.part_names.materials[*part.material];
            }
        }
        return names;
    }

    /// By corners, as some vertices may have no colour.
    void give_colours() {
        for (const std::uint32_t vertex : mesh_.corners) {
            if (has_colours_) {
                colours_.corners.push_back(vertex < vertex_colours_.size() ? vertex_colours_[vertex]
                                                                           : kNone);
            }
        }
        scale_colours(colours_);
        mesh_.fields.push_back(std::move(colours_));
    }

    void warn_of_indices() {
        Found bad = unused_normals_.bad();
        if (const Found uvs = unused_uvs_.bad(); uvs.count > 0) {
            bad = {bad.count + uvs.count, std::min(bad.first, uvs.first)};
        }
        if (bad.count > 0) {
            add_warning(mesh_.warnings, "bad_unused_index", bad.count,
                        mesh_.names.of_face(bad.first),
                        "texture or normal index out of range, and not used",
                        "texture or normal indices out of range, and not used");
        }
    }

    const Path& path_;
    const FileScope& scope_;
    ObjLines lines_;
    std::uint32_t line_ = 0;
    std::vector<std::string_view> tokens_;
    bool has_uvs_, has_normals_, has_colours_, has_materials_; ///< Parts of the file to read.
    bool needs_uvs_; ///< Else they are left out if they cannot be read.
    MeshField colours_ = make_colours(MeshField::Of::corners, 3);
    MeshField normals_ = make_field("normal", MeshField::Of::corners, 3);
    std::vector<std::uint32_t> vertex_colours_; ///< Index of each, or kNone.
    std::uint32_t colour_count_ = 0;
    bool is_flat_ = false;                        ///< Vertices have two coordinates.
    std::size_t uv_count_ = 0, normal_count_ = 0; ///< Records so far.
    PolygonMesh mesh_;
    ObjParts parts_;
    std::vector<std::string> libraries_; ///< Texts behind `mtllib`.
    UnusedIndices unused_uvs_, unused_normals_;
};

} // namespace

PolygonMesh read_obj(const Path& path, const WantedFields& fields, const FileScope& scope,
                     const ReadingProgress& progress) {
    std::string bytes = read_text(path);
    const std::size_t nuls = drop_final_nuls(bytes);
    if (bytes.empty()) {
        fail_input(path, "is empty");
    }
    refuse_other_mesh(path, bytes, ".obj");
    PolygonMesh mesh = ObjReader(path, bytes, fields, scope, progress).read();
    warn_of_final_nuls(mesh, nuls);
    return mesh;
}

} // namespace geodisk::tools
