#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "files/meshes/ply_fields.hpp"
#include "files/meshes/ply_materials.hpp"
#include "files/meshes/polygon_mesh.hpp"
#include "files/meshes/sidecar_files.hpp"
#include "files/meshes/triangle_strip.hpp"
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

/// The two columns of texture coordinates, where any are wanted.
std::vector<std::size_t> uv_columns(const PlyElement& element, const PlyWanted& wanted) {
    return wanted.fields.has(kUvField) ? find_uv_columns(element) : std::vector<std::size_t>();
}

void read_vertices(const Path& path, PlyFile& file, const PlyElement& element,
                   const PlyWanted& wanted, PolygonMesh& mesh) {
    const std::vector<std::size_t> columns =
        coordinate_columns(path, element, wanted.has_coordinates);
    const std::vector<std::size_t> uvs = uv_columns(element, wanted);
    PlyFieldReader fields(file, element, wanted.fields, mesh);
    mesh.dimension = columns.empty() ? 3 : static_cast<std::uint32_t>(columns.size());
    mesh.positions.reserve(columns.size() * file.possible_records(element));
    file.read_records(element, [&](std::uint64_t index, const PlyRecord& record) {
        for (const std::size_t column : columns) {
            mesh.positions.push_back(record.scalars[column]);
        }
        for (const std::size_t column : uvs) {
            mesh.uvs.push_back(record.scalars[column]);
        }
        fields.add(index, record);
    });
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
    PlyFieldReader fields(file, element, wanted.fields, mesh);
    mesh.face_ends.reserve(file.possible_records(element));
    mesh.corners.reserve(3 * file.possible_records(element)); // Most faces are triangles.
    file.read_records(element, [&](std::uint64_t index, const PlyRecord& record) {
        for (const double value : record.lists[column]) {
            mesh.corners.push_back(to_corner(file, element, index, value));
        }
        mesh.face_ends.push_back(mesh.corners.size());
        fields.add(index, record, record.lists[column].size());
    });
    fields.finish();
}

/// Reads strips of triangles; -1 ends one.
void read_strips(PlyFile& file, const PlyElement& element, PolygonMesh& mesh) {
    const std::size_t column = index_column(file, element);
    TriangleStrip strip(mesh);
    file.read_records(element, [&](std::uint64_t index, const PlyRecord& record) {
        strip.restart();
        for (const double value : record.lists[column]) {
            if (value == -1) {
                strip.restart();
            } else {
                strip.add(to_corner(file, element, index, value));
            }
        }
    });
}

} // namespace

PolygonMesh read_ply(const Path& path, PlyWanted wanted, const FileScope& scope,
                     const ReadingProgress& progress) {
    PlyFile file(path, progress);
    if (wanted.fields.materials) {
        wanted.fields.numbers.emplace_back(kImageNumber);
    }
    PolygonMesh mesh;
    mesh.names = {"element face, record ", "element vertex, record ", {}, {}, 0};
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
    if (mesh.corner_uvs.empty() && !mesh.uvs.empty()) {
        mesh.corner_uvs = mesh.corners;
    }
    if (!mesh.corner_uvs.empty() && mesh.corner_uvs.size() != mesh.corners.size()) {
        const std::string text = "has strips of triangles, which have no texcoord";
        if (wanted.fields.needs(kUvField)) {
            fail_input(path, text);
        }
        warn_left_out(path, kUvField, UserError(ExitCode::bad_input, text), mesh.warnings);
        mesh.has_lost_uvs = true;
    }
    if (mesh.has_lost_uvs) {
        std::erase_if(mesh.fields, [](const MeshField& field) { return field.name == kUvField; });
    }
    if (wanted.fields.materials) {
        take_ply_materials(file, scope, mesh);
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
