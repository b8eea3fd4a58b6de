#include "files/meshes/mesh_fields.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "files/images/colour_encoding.hpp"
#include "files/images/image_pixels.hpp"
#include "files/input_file.hpp"
#include "files/meshes/material_fields.hpp"
#include "files/meshes/part_columns.hpp"
#include "files/meshes/polygon_mesh.hpp"
#include "files/name_text.hpp"
#include "files/samples/sample_columns.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/suggestion.hpp"

namespace geodisk::tools {
namespace {

using Of = MeshField::Of;

constexpr std::string_view kAll = "all";

/// Corners of the faces of a file, face after face.
struct FaceCorners {
    std::span<const std::uint32_t> vertices;
    std::span<const std::size_t> ends; ///< Empty for triangles.

    std::size_t face_of(std::size_t corner) const {
        return ends.empty() ? corner / 3
                            : static_cast<std::size_t>(std::ranges::upper_bound(ends, corner) -
                                                       ends.begin());
    }
    std::pair<std::size_t, std::size_t> range_of(std::size_t face) const {
        return ends.empty() ? std::pair{3 * face, 3 * face + 3}
                            : std::pair{face == 0 ? 0 : ends[face - 1], ends[face]};
    }
};

/// Puts a '_' for each character that some format does not allow in a name.
std::string column_name(std::string name) {
    std::ranges::replace_if(
        name,
        [](char c) {
            const auto byte = static_cast<unsigned char>(c);
            return byte >= 128 || (std::isalnum(byte) == 0 && c != '_' && c != '.' && c != '-');
        },
        '_');
    return name;
}

/// The name that all formats tell apart, whatever the case and however glTF marks its own: USD has
/// '_' for further characters.
std::string bare_name(std::string name) {
    name = lower_case(column_name(std::move(name)));
    name.erase(0, std::min(name.find_first_not_of('_'), name.size()));
    std::ranges::replace_if(
        name, [](char c) { return c == '.' || c == '-'; }, '_');
    return name;
}

std::set<std::string> names_taken() {
    // Those of NPZ, glTF, PCD and USD, which differ from the columns below.
    std::set<std::string> names{"points", "normals",      "barycentric",   "header",
                                "frames", "position",     "min_distance",  "seed",
                                "normal", "normal_x",     "normal_y",      "normal_z",
                                "st",     "displaycolor", "displayopacity"};
    names.insert(kSampleColumnNames.begin(), kSampleColumnNames.end());
    names.insert(kNumberedColumnNames.begin(), kNumberedColumnNames.end());
    names.insert(kFrameColumnNames.begin(), kFrameColumnNames.end());
    for (const std::string_view name : {kExistingColumn, kClassColumn, kLevelColumn, kFeatureColumn,
                                        kVertexColumn, kCoverColumn, kRowColumn}) {
        names.emplace(name);
    }
    for (const std::string& name : part_column_names()) {
        names.insert(name);
    }
    return names;
}

/// The columns that samples have: of attributes no two may have one name.
class Columns {
  public:
    /// Adds those of an attribute. Returns why it cannot have them; "" if it can.
    std::string add(const MeshField& field) {
        std::set<std::string> own{bare_name(field.name)};
        for (const std::string& component : field.components) {
            own.insert(bare_name(component));
        }
        for (const std::string& name : own) {
            if (taken_.contains(name)) {
                return "the attribute " + in_quotes(field.name) +
                       " has the name of a column of samples";
            }
            if (of_attributes_.contains(name)) {
                return "two attributes would have the column " + in_quotes(name);
            }
        }
        of_attributes_.merge(own);
        return "";
    }

  private:
    std::set<std::string> taken_ = names_taken(), of_attributes_;
};

[[noreturn]] void fail_unknown(const Path& path, const std::string& name,
                               const std::vector<MeshField>& fields) {
    std::vector<std::string> names;
    names.reserve(fields.size());
    for (const MeshField& field : fields) {
        names.push_back(field.name);
    }
    fail_input(path, "has no attribute " + in_quotes(name) +
                         (names.empty() ? ", or any other"
                                        : "; it has " + listed(names) + did_you_mean(name, names)));
}

/// Moves the values of attributes to those of the triangles that faces became.
class FieldTaker {
  public:
    FieldTaker(const Path& path, const PolygonMesh& polygons, const MeshFile& mesh)
        : path_(path), names_(polygons.names), mesh_(mesh) {
        faces_ = mesh.polygons.empty() ? FaceCorners{mesh.triangles, {}}
                                       : FaceCorners{polygons.corners, polygons.face_ends};
    }

    /// Returns where a corner first lacks a value; "" if none does.
    std::string gap(const MeshField& field) const {
        const auto found = std::ranges::find(field.corners, MeshField::kNone);
        if (found == field.corners.end()) {
            return "";
        }
        const auto corner = static_cast<std::size_t>(found - field.corners.begin());
        return names_.of_face(faces_.face_of(corner)) + ": vertex " +
               names_.vertex_number(faces_.vertices[corner]);
    }

    /// Oddities that values may have.
    struct Allowed {
        bool gaps = false;     ///< Corners may lack values.
        bool infinite = false; ///< Values need not be finite.
    };

    void take(MeshField& field, Allowed allowed) const {
        if (field.of == Of::corners && !mesh_.polygons.empty()) {
            split_corners(field);
        }
        for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
            if (mesh_.takes_part(t)) {
                check_triangle(field, t, allowed);
            }
        }
    }
    void take(MeshField& field) const { take(field, Allowed{}); }

  private:
    std::size_t face_of(std::size_t triangle) const {
        return mesh_.polygons.empty() ? triangle : mesh_.polygons[triangle];
    }

    /// From corners of polygons to those of triangles, which name the same vertices.
    void split_corners(MeshField& field) const {
        std::vector<std::uint32_t> corners;
        corners.reserve(mesh_.triangles.size());
        for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
            corners.push_back(corner_of(field, face_of(i / 3), mesh_.triangles[i]));
        }
        field.corners = std::move(corners);
    }

    std::uint32_t corner_of(const MeshField& field, std::size_t face, std::uint32_t vertex) const {
        const auto [begin, end] = faces_.range_of(face);
        std::uint32_t index = MeshField::kNone;
        for (std::size_t i = begin; i < end; ++i) {
            if (faces_.vertices[i] != vertex) {
                continue;
            }
            if (index != MeshField::kNone && !are_equal(field, index, field.corners[i])) {
                fail_input(path_, names_.of_face(face) + ": vertex " +
                                      names_.vertex_number(vertex) + " has two values of " +
                                      in_quotes(field.name) + " in it; split the face");
            }
            index = field.corners[i];
        }
        return index;
    }

    static bool are_equal(const MeshField& field, std::size_t a, std::size_t b) {
        if (a == MeshField::kNone || b == MeshField::kNone) {
            return a == b;
        }
        const std::size_t size = field.components.size();
        return std::ranges::equal(std::span(field.values).subspan(a * size, size),
                                  std::span(field.values).subspan(b * size, size));
    }

    void check_triangle(const MeshField& field, std::size_t t, Allowed allowed) const {
        const std::size_t size = field.components.size();
        for (std::size_t k = 3 * t; k < 3 * t + 3; ++k) {
            const std::size_t index = field.of == Of::vertices  ? mesh_.triangles[k]
                                      : field.of == Of::corners ? field.corners[k]
                                                                : face_of(t);
            if (allowed.gaps && index == MeshField::kNone) {
                continue;
            }
            if ((index + 1) * size > field.values.size()) {
                fail_input(path_, "has " + counted(field.values.size() / size, "value", "values") +
                                      " of " + in_quotes(field.name) + ", but " +
                                      names_.of_face(face_of(t)) + " names vertex " +
                                      names_.vertex_number(mesh_.triangles[k]));
            }
            const auto values = std::span(field.values).subspan(index * size, size);
            if (!allowed.infinite &&
                !std::ranges::all_of(values, [](double x) { return std::isfinite(x); })) {
                fail_input(path_, (field.of == Of::vertices ? names_.of_vertex(index)
                                                            : names_.of_face(face_of(t))) +
                                      ": " + in_quotes(field.name) +
                                      " is not finite; leave it out, or correct the file");
            }
        }
    }

    const Path& path_;
    const ElementNames& names_;
    const MeshFile& mesh_;
    FaceCorners faces_;
};

/// Returns the names that the components of an attribute of this name have if it is of colours or
/// texture coordinates: "face_red" for "face_color", "u1" for "uv1".
std::vector<std::string> component_names(std::string_view name) {
    const std::string_view set = name.substr(name.find_last_not_of("0123456789") + 1);
    name.remove_suffix(set.size());
    const bool is_of_colours = name.ends_with(kColourField);
    const std::string_view prefix =
        name.substr(0, name.size() - std::min(name.size(), kColourField.size()));
    std::vector<std::string> names;
    if (is_of_colours && (prefix.empty() || prefix == "face_" || prefix == "vertex_")) {
        names = make_colours(Of::vertices, 4, std::string(prefix)).components;
    } else if (name == kUvField) {
        names = make_uvs().components;
    }
    for (std::string& component : names) {
        component += set;
    }
    return names;
}

/// Returns true for names of the same letters, however they are composed and encoded.
bool are_same(std::string_view a, std::string_view b) {
    return a == b || composed_name(a) == composed_name(b);
}

/// Returns true if `wanted` is `name`, or "red" for colours, "u" for texture coordinates and so on.
/// Colours have "vertex_" before their name beside a texture.
bool means(std::string_view wanted, std::string_view name) {
    constexpr std::string_view kVertex = "vertex_";
    if (name == kColourField && wanted.starts_with(kVertex)) {
        wanted.remove_prefix(kVertex.size());
    }
    if (are_same(wanted, name)) {
        return true;
    }
    const std::vector<std::string> components = component_names(name);
    return std::ranges::find(components, wanted) != components.end();
}

void check_known(const Path& path, const WantedFields& wanted,
                 const std::vector<MeshField>& fields) {
    for (const std::string& name : wanted.names) {
        if (std::ranges::none_of(fields, [&](const MeshField& f) { return means(name, f.name); })) {
            fail_unknown(path, name, fields);
        }
    }
}

/// Texture coordinates are where those of density images are.
void move_uvs(PolygonMesh& polygons) {
    for (MeshField& field : polygons.fields) {
        if (field.name == kUvField && field.values.empty()) {
            field.values = polygons.uvs;
            field.corners = polygons.corner_uvs;
        }
    }
}

MeshField texture_uvs(const Path& path, const PolygonMesh& polygons, const FieldTaker& taker) {
    const auto found = std::ranges::find(polygons.fields, kUvField, &MeshField::name);
    if (found == polygons.fields.end() || found->components.size() != 2) {
        fail_input(path, "has no texture coordinates, which an image needs");
    }
    if (const std::string gap = taker.gap(*found); !gap.empty()) {
        fail_input(path, gap + " has no texture coordinates, which an image needs");
    }
    MeshField uvs = *found;
    taker.take(uvs);
    return uvs;
}

/// The texture coordinates of faces with materials; nothing if no face has any.
std::optional<MeshField> material_uvs(PolygonMesh& polygons, const FieldTaker& taker) {
    std::optional<MeshField> uvs = std::move(polygons.material_uvs);
    const auto found = std::ranges::find(polygons.fields, kUvField, &MeshField::name);
    if (!uvs && found != polygons.fields.end() && !found->corners.empty()) {
        uvs = *found;
    }
    if (uvs) {
        taker.take(*uvs, {.gaps = true});
    }
    return uvs;
}

void check_count(const Path& path, const MeshField& field, const MeshFile& mesh,
                 std::size_t vertices) {
    const std::size_t count = field.values.size() / field.components.size();
    const std::size_t needed = field.of == Of::vertices ? vertices
                               : mesh.polygons.empty()  ? mesh.triangle_count()
                                                        : mesh.polygon_count;
    if (field.of != Of::corners && needed > 0 && count != needed) {
        fail_input(path, "has " + counted(count, "value", "values") + " of " +
                             in_quotes(field.name) + " for " +
                             (field.of == Of::vertices ? counted(needed, "vertex", "vertices")
                                                       : counted(needed, "face", "faces")));
    }
}

/// Returns a field of one component, without corners and values.
MeshField one_number(const std::string& name, const MeshField& field) {
    MeshField number = make_field(name, field.of);
    number.corners = field.corners;
    number.value_names = field.value_names;
    return number;
}

/// Returns component `k` of a field. Colours are as sRGB encodes them.
MeshField component_of(const std::string& name, const MeshField& field, std::size_t k) {
    MeshField number = one_number(name, field);
    for (std::size_t i = k; i < field.values.size(); i += field.components.size()) {
        number.values.push_back(field.is_light && k != kAlpha ? encoded_light(field.values[i])
                                                              : field.values[i]);
    }
    return number;
}

MeshField luminance_of(const std::string& name, const MeshField& colours) {
    MeshField number = one_number(name, colours);
    const MeshField red = component_of(name, colours, 0), green = component_of(name, colours, 1),
                    blue = component_of(name, colours, 2);
    for (std::size_t i = 0; i < red.values.size(); ++i) {
        number.values.push_back(grey_of(red.values[i], green.values[i], blue.values[i]));
    }
    return number;
}

/// Returns the number that a name means, see take_fields().
MeshField number_of(const Path& path, const std::string& name, const PolygonMesh& polygons) {
    const auto is_called = [&](const MeshField& field) { return are_same(name, field.name); };
    const auto own = std::ranges::find_if(polygons.own_columns, is_called);
    if (own != polygons.own_columns.end()) {
        return *own;
    }
    for (const MeshField& field : polygons.fields) {
        const auto found =
            std::ranges::find_if(field.components, [&](const std::string& component) {
                return are_same(name, component);
            });
        if (found != field.components.end()) {
            return component_of(name, field,
                                static_cast<std::size_t>(found - field.components.begin()));
        }
    }
    const auto field = std::ranges::find_if(polygons.fields, is_called);
    if (field == polygons.fields.end()) {
        fail_unknown(path, name, polygons.fields);
    }
    if (!field->is_colour) {
        fail_input(path, in_quotes(name) + " is of several numbers; give one of them: " +
                             listed(field->components));
    }
    return luminance_of(name, *field);
}

void take_numbers(const Path& path, const WantedFields& wanted, const PolygonMesh& polygons,
                  const FieldTaker& taker, MeshFile& mesh) {
    for (const std::string& name : wanted.numbers) {
        MeshField number = number_of(path, name, polygons);
        if (const std::string gap = taker.gap(number); !gap.empty()) {
            fail_input(path, gap + " has no value of " + in_quotes(name));
        }
        check_count(path, number, mesh, polygons.positions.size() / polygons.dimension);
        taker.take(number, {.infinite = true});
        mesh.numbers.push_back(std::move(number));
    }
}

/// Names colours apart from those of a texture.
void name_beside_texture(MeshField& colours) {
    const std::string prefix = colours.of == Of::faces ? "face_" : "vertex_";
    colours.name.insert(0, prefix);
    for (std::string& component : colours.components) {
        component.insert(0, prefix);
    }
}

/// Moves an attribute into `mesh`. With WantedFields::all it is left out if that cannot be.
void take_field(const Path& path, const WantedFields& wanted, MeshField& field,
                const FieldTaker& taker, std::size_t vertices, MeshFile& mesh) {
    try {
        check_count(path, field, mesh, vertices);
        taker.take(field);
    } catch (const UserError& error) {
        if (!wanted.all) {
            throw;
        }
        warn_left_out(path, field.name, error, mesh.warnings);
        return;
    }
    mesh.fields.push_back(std::move(field));
}

/// Puts colours of vertices where those of materials are asked for.
void take_vertex_colours(const PolygonMesh& polygons, const FieldTaker& taker, MeshFile& mesh) {
    const auto found = std::ranges::find(polygons.fields, kColourField, &MeshField::name);
    if (found != polygons.fields.end() && found->is_colour && found->of != Of::faces) {
        taker.take(mesh.vertex_colours.emplace(*found), {.gaps = true});
    }
}

} // namespace

void warn_left_out(const Path& path, std::string_view name, const UserError& error,
                   std::vector<MeshWarning>& warnings) {
    const std::string prefix = path.string() + ": ";
    std::string text = error.what();
    text.erase(0, text.starts_with(prefix) ? prefix.size() : 0);
    warnings.push_back(
        {"attribute_left_out", 1, "", text + ", so " + in_quotes(name) + " is left out", {}});
}

bool WantedFields::needs(std::string_view name) const {
    const bool is_of_texture =
        (uvs && name == kUvField) || (materials && (name == kUvField || name == kColourField));
    return is_of_texture || place_of(name) < names.size() ||
           std::ranges::any_of(numbers, [&](const std::string& n) { return means(n, name); });
}

bool WantedFields::has(std::string_view name) const {
    return all || needs(name);
}

bool WantedFields::lists(std::string_view name) const {
    return all || place_of(name) < names.size();
}

std::size_t WantedFields::place_of(std::string_view name) const {
    const auto found =
        std::ranges::find_if(names, [&](const std::string& wanted) { return means(wanted, name); });
    return static_cast<std::size_t>(found - names.begin());
}

WantedFields parse_fields(const std::string& text) {
    WantedFields wanted;
    wanted.all = text == kAll;
    if (wanted.all) {
        return wanted;
    }
    for (std::string& name : parts_of(text)) {
        if (name.empty() || name == kAll) {
            fail_usage("--attributes: " + in_quotes(text) +
                       " is neither all nor a list of names with commas between");
        }
        if (wanted.lists(name)) {
            fail_usage("--attributes: " + name + " is given twice");
        }
        wanted.names.push_back(std::move(name));
    }
    return wanted;
}

MeshField make_field(std::string_view name, Of of, std::size_t components) {
    MeshField field;
    field.name = name;
    field.of = of;
    for (std::size_t i = 0; i < components; ++i) {
        field.components.push_back(components == 1 ? field.name
                                                   : field.name + '_' + std::to_string(i));
    }
    return field;
}

MeshField make_colours(Of of, std::size_t components, const std::string& prefix) {
    MeshField field = make_field(prefix + std::string(kColourField), of, 0);
    field.is_colour = true;
    for (const char* const name : {"red", "green", "blue", "alpha"}) {
        if (field.components.size() < components) {
            field.components.push_back(prefix + name);
        }
    }
    return field;
}

MeshField make_uvs() {
    MeshField field = make_field(kUvField, Of::corners, 0);
    field.components = {"u", "v"};
    return field;
}

bool lists_name(const PolygonMesh& polygons, std::string_view name) {
    const auto has_name = [&](const MeshField& field) {
        return field.name == name ||
               std::ranges::find(field.components, name) != field.components.end();
    };
    return std::ranges::any_of(polygons.fields, has_name) ||
           std::ranges::any_of(polygons.own_columns, has_name);
}

void scale_colours(MeshField& colours) {
    constexpr double kMaxByte = 255;
    if (std::ranges::any_of(colours.values, [](double x) { return x > 1; })) {
        for (double& value : colours.values) {
            value /= kMaxByte;
        }
    }
}

void take_fields(const Path& path, const WantedFields& wanted, PolygonMesh& polygons,
                 MeshFile& mesh) {
    check_known(path, wanted, polygons.fields);
    move_uvs(polygons);
    const FieldTaker taker(path, polygons, mesh);
    if (wanted.uvs) {
        mesh.texture_uvs = texture_uvs(path, polygons, taker);
    }
    if (wanted.materials) {
        mesh.texture_uvs = material_uvs(polygons, taker);
        take_vertex_colours(polygons, taker, mesh);
        take_materials(path, polygons, mesh);
    }
    take_numbers(path, wanted, polygons, taker, mesh);
    Columns columns;
    for (MeshField& field : polygons.fields) {
        const bool is_lost = field.of == Of::corners && field.corners.empty();
        if (!wanted.lists(field.name) || is_lost) {
            continue;
        }
        if (const std::string gap = taker.gap(field); !gap.empty()) {
            const std::string text = gap + " has no value of " + in_quotes(field.name);
            if (!wanted.all) {
                fail_input(path, text);
            }
            mesh.warnings.push_back(
                {"partial_attribute", 1, gap, text + ", so this attribute is left out", {}});
            continue;
        }
        if (wanted.has_texture && field.name == kColourField) {
            name_beside_texture(field);
        }
        if (const std::string clash = columns.add(field); !clash.empty()) {
            if (!wanted.all) {
                fail_input(path,
                           clash + "; rename it in the file, or leave it out of --attributes");
            }
            mesh.warnings.push_back({"attribute_name",
                                     1,
                                     "",
                                     clash + ", so " + in_quotes(field.name) +
                                         " is left out; rename it in the file to have it",
                                     {}});
            continue;
        }
        take_field(path, wanted, field, taker, polygons.positions.size() / polygons.dimension,
                   mesh);
    }
    if (!wanted.names.empty()) { // In the order of the names.
        std::ranges::sort(mesh.fields, {},
                          [&](const MeshField& field) { return wanted.place_of(field.name); });
    }
    for (MeshField& field : mesh.fields) {
        field.name = column_name(field.name);
        std::ranges::transform(field.components, field.components.begin(), column_name);
    }
    if (wanted.normals) {
        if (!polygons.normals) {
            fail_input(path, "has no normals, as --normals file requests; use smooth or face");
        }
        if (const std::string gap = taker.gap(*polygons.normals); !gap.empty()) {
            fail_input(path,
                       gap + " has no normal, as --normals file requests; use smooth or face");
        }
        taker.take(*polygons.normals);
        mesh.normals = std::move(polygons.normals);
    }
}

} // namespace geodisk::tools
