#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "files/meshes/ply_fields.hpp"
#include "files/meshes/polygon_mesh.hpp"
#include "files/meshes/sidecar_files.hpp"
#include "files/ply_file.hpp"
#include "files/samples/told_samples.hpp"
#include "geometry/mesh.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/suggestion.hpp"

namespace geodisk::tools {
namespace {

/// The properties x0, x1 and so on.
std::vector<std::size_t> numbered_columns(const Path& path, const PlyElement& element) {
    std::vector<std::size_t> columns;
    for (std::uint32_t i = 0; i <= kMaxCoordinates; ++i) {
        const char name[] = {'x', static_cast<char>('0' + i), '\0'};
        const std::optional<std::size_t> column = element.find_scalar(name);
        if (column && columns.size() < i) {
            fail_input(path, std::string("element vertex has a property ") + name + " but no x" +
                                 std::to_string(columns.size()));
        }
        if (column) {
            columns.push_back(*column);
        }
    }
    if (columns.size() < kFewestCoordinates || columns.size() > kMaxCoordinates) {
        fail_input(path, "element vertex has properties x0 to x" +
                             std::to_string(columns.size() - 1) +
                             "; a vertex has 3 to 8 coordinates");
    }
    return columns;
}

/// Returns the columns of the coordinates; none if the element has none and need not have any.
std::vector<std::size_t> coordinate_columns(const Path& path, const PlyElement& element,
                                            bool must_exist) {
    if (element.find_scalar("x0")) {
        return numbered_columns(path, element);
    }
    std::vector<std::size_t> columns;
    std::string missing;
    for (const char* const name : {"x", "y", "z"}) {
        if (const std::optional<std::size_t> column = element.find_scalar(name)) {
            columns.push_back(*column);
        } else if (missing.empty()) {
            missing = name;
        }
    }
    if (!missing.empty() && (must_exist || !columns.empty())) {
        fail_input(path, "element vertex has no property " + missing);
    }
    return columns;
}

std::size_t attribute_column(const Path& path, const PlyElement& element, const std::string& name) {
    const std::optional<std::size_t> column = element.find_scalar(name);
    if (!column) {
        fail_input(path, "element vertex has no " +
                             std::string(element.find_list(name) ? "scalar " : "") + "property " +
                             in_quotes(name));
    }
    return *column;
}

/// The two columns of texture coordinates, where any are wanted.
std::vector<std::size_t> uv_columns(const Path& path, const PlyElement& element,
                                    const PlyWanted& wanted) {
    if (!wanted.has_uvs && !wanted.fields.has(kUvField)) {
        return {};
    }
    std::vector<std::size_t> columns = find_uv_columns(element);
    if (columns.empty() && wanted.has_uvs) {
        fail_input(path, "element vertex has no texture coordinates: none of s t, u v and "
                         "texture_u texture_v");
    }
    return columns;
}

/// Column of a property of faces or vertices.
struct PropertyColumn {
    std::size_t index; ///< In PolygonMesh::properties.
    std::size_t column;
};

std::string names_of_scalars(const PlyFile& file) {
    constexpr std::size_t kMax = 10;
    std::vector<std::string> names;
    for (const char* const of : {"face", "vertex"}) {
        for (const PlyElement& element : file.elements()) {
            for (const PlyProperty& property : element.properties) {
                if (element.name == of && !property.count_type) {
                    names.push_back(property.name);
                }
            }
        }
    }
    const std::size_t more = names.size() - std::min(names.size(), kMax);
    names.resize(names.size() - more);
    if (more > 0) {
        names.push_back(std::to_string(more) + " more");
    }
    return listed(names);
}

/// Finds the properties that either element has, and says of which they are.
void find_properties(const PlyFile& file, const PlyWanted& wanted, PolygonMesh& mesh) {
    for (const std::string& name : wanted.properties) {
        bool of_faces = false, of_vertices = false;
        for (const PlyElement& element : file.elements()) {
            of_faces |= element.name == "face" && element.find_scalar(name).has_value();
            of_vertices |= element.name == "vertex" && element.find_scalar(name).has_value();
        }
        if (of_faces && of_vertices) {
            fail_input(file.path(), "both faces and vertices have a property " + in_quotes(name) +
                                        "; rename one of them");
        }
        if (!of_faces && !of_vertices) {
            fail_input(file.path(), "has no scalar property " + in_quotes(name) +
                                        " of faces or vertices; it has " + names_of_scalars(file));
        }
        mesh.properties.push_back({of_faces, {}});
    }
}

/// Returns the columns of the properties that this element has.
std::vector<PropertyColumn> property_columns(const PlyElement& element, const PlyWanted& wanted,
                                             const PolygonMesh& mesh) {
    std::vector<PropertyColumn> columns;
    for (std::size_t i = 0; i < wanted.properties.size(); ++i) {
        if (mesh.properties[i].of_faces == (element.name == "face")) {
            columns.push_back({i, *element.find_scalar(wanted.properties[i])});
        }
    }
    return columns;
}

void add_properties(const std::vector<PropertyColumn>& columns, const PlyRecord& record,
                    PolygonMesh& mesh) {
    for (const auto& [index, column] : columns) {
        mesh.properties[index].values.push_back(record.scalars[column]);
    }
}

void scale_colours(const PlyColours& colours, const std::vector<PropertyColumn>& columns,
                   PolygonMesh& mesh) {
    for (const auto& [index, column] : columns) {
        colours.scale(column, mesh.properties[index].values);
    }
}

void read_vertices(const Path& path, PlyFile& file, const PlyElement& element,
                   const PlyWanted& wanted, PolygonMesh& mesh) {
    const std::vector<std::size_t> columns =
        coordinate_columns(path, element, wanted.has_coordinates);
    std::vector<std::size_t> attributes;
    for (const std::string& name : wanted.attributes) {
        attributes.push_back(attribute_column(path, element, name));
    }
    const std::vector<std::size_t> uvs = uv_columns(path, element, wanted);
    PlyFieldReader fields(file, element, wanted.fields, mesh);
    const std::vector<PropertyColumn> properties = property_columns(element, wanted, mesh);
    mesh.dimension = columns.empty() ? 3 : static_cast<std::uint32_t>(columns.size());
    mesh.attributes.resize(attributes.size());
    mesh.positions.reserve(columns.size() * file.possible_records(element));
    file.read_records(element, [&](std::uint64_t index, const PlyRecord& record) {
        for (const std::size_t column : columns) {
            mesh.positions.push_back(record.scalars[column]);
        }
        for (const std::size_t column : uvs) {
            mesh.uvs.push_back(record.scalars[column]);
        }
        for (std::size_t i = 0; i < attributes.size(); ++i) {
            mesh.attributes[i].push_back(record.scalars[attributes[i]]);
        }
        add_properties(properties, record, mesh);
        fields.add(index, record);
    });
    for (std::size_t i = 0; i < attributes.size(); ++i) {
        fields.colours().scale(attributes[i], mesh.attributes[i]);
    }
    scale_colours(fields.colours(), properties, mesh);
    fields.finish();
}

std::size_t index_column(const PlyFile& file, const PlyElement& element) {
    std::optional<std::size_t> column = element.find_list("vertex_indices");
    if (!column) {
        column = element.find_list("vertex_index");
    }
    if (!column) {
        fail_input(file.path(), "element " + element.name + " has no list property vertex_indices");
    }
    return *column;
}

std::uint32_t to_corner(const PlyFile& file, const PlyElement& element, std::uint64_t index,
                        double value) {
    const bool in_range = value >= 0 && value <= std::numeric_limits<std::uint32_t>::max();
    const std::uint32_t corner = in_range ? static_cast<std::uint32_t>(value) : 0;
    if (!in_range || static_cast<double>(corner) != value) {
        file.fail(element, index,
                  "vertex index " + exact_text(value) + " is out of range or not a whole number");
    }
    return corner;
}

void read_faces(PlyFile& file, const PlyElement& element, const PlyWanted& wanted,
                PolygonMesh& mesh) {
    const std::size_t column = index_column(file, element);
    const std::vector<PropertyColumn> properties = property_columns(element, wanted, mesh);
    PlyFieldReader fields(file, element, wanted.fields, mesh);
    mesh.face_ends.reserve(file.possible_records(element));
    file.read_records(element, [&](std::uint64_t index, const PlyRecord& record) {
        for (const double value : record.lists[column]) {
            mesh.corners.push_back(to_corner(file, element, index, value));
        }
        mesh.face_ends.push_back(mesh.corners.size());
        add_properties(properties, record, mesh);
        fields.add(index, record, record.lists[column].size());
    });
    scale_colours(fields.colours(), properties, mesh);
    fields.finish();
}

/// Strips of triangles: each vertex makes one with the two before it, every other one turned; -1
/// ends a strip.
void read_strips(PlyFile& file, const PlyElement& element, PolygonMesh& mesh) {
    const std::size_t column = index_column(file, element);
    file.read_records(element, [&](std::uint64_t index, const PlyRecord& record) {
        std::size_t length = 0;
        std::uint32_t before = 0, last = 0;
        for (const double value : record.lists[column]) {
            if (value == -1) {
                length = 0;
                continue;
            }
            const std::uint32_t corner = to_corner(file, element, index, value);
            if (++length >= 3) {
                const bool is_turned = length % 2 == 0;
                mesh.corners.insert(mesh.corners.end(),
                                    {is_turned ? last : before, is_turned ? before : last, corner});
                mesh.face_ends.push_back(mesh.corners.size());
            }
            before = std::exchange(last, corner);
        }
    });
}

} // namespace

PolygonMesh read_ply(const Path& path, const PlyWanted& wanted, const ReadingProgress& progress) {
    PlyFile file(path, progress);
    PolygonMesh mesh;
    mesh.names = {"element face, record ", "element vertex, record ", {}, {}, 0};
    find_properties(file, wanted, mesh);
    bool has_vertices = false;
    bool has_faces = false, has_weights = false;
    for (const PlyElement& element : file.elements()) {
        if (element.name == "vertex") {
            file.check_unique(element);
            has_vertices = true;
            has_weights = element.find_scalar("bary_u").has_value();
            read_vertices(path, file, element, wanted, mesh);
        } else if (element.name == "face") {
            file.check_unique(element);
            has_faces = true;
            read_faces(file, element, wanted, mesh);
        } else if (element.name == "tristrips") {
            file.check_unique(element);
            has_faces = true;
            read_strips(file, element, mesh);
            mesh.names.face = "triangle "; // Of some record.
        } else {
            file.read_records(element, [](std::uint64_t, const PlyRecord&) {});
        }
    }
    if (!has_vertices) {
        fail_input(path, "has no element vertex");
    }
    if (!has_faces) {
        if (has_weights) { // As samples have; of a stream nothing else tells.
            fail_input(path, kHoldsSamples);
        }
        fail_input(path, "has no faces: there is no element face or tristrips");
    }
    for (const MeshProperty& property : mesh.properties) {
        if (property.of_faces && property.values.size() != mesh.face_ends.size()) {
            fail_input(path, "has strips of triangles, which have no properties of faces");
        }
    }
    if (mesh.corner_uvs.empty() && (wanted.has_uvs || !mesh.uvs.empty())) {
        mesh.corner_uvs = mesh.corners;
    }
    if (!mesh.corner_uvs.empty() && mesh.corner_uvs.size() != mesh.corners.size()) {
        fail_input(path, "has strips of triangles, which have no texcoord");
    }
    const Found& unknown = file.unknown_lines();
    add_warning(mesh.warnings, "unknown_header_lines", unknown.count,
                unknown.count == 0 ? "" : "line " + std::to_string(unknown.first),
                "unknown header line ignored", "unknown header lines ignored");
    add_warning(mesh.warnings, "surplus_values", file.surplus_lines(), "",
                "line has more values than its element has properties; they are ignored",
                "lines have more values than their elements have properties; they are ignored");
    add_warning(mesh.warnings, "trailing_data", file.trailing_bytes(), "",
                "byte after the last element ignored", "bytes after the last element ignored");
    return mesh;
}

} // namespace geodisk::tools
