#include "files/meshes/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "files/input_file.hpp"
#include "files/meshes/face_splitting.hpp"
#include "files/meshes/file_scope.hpp"
#include "files/meshes/polygon_mesh.hpp"
#include "files/meshes/sidecar_files.hpp"
#include "files/meshes/value_fields.hpp"
#include "geometry/shape_warnings.hpp"
#include "geometry/weld_mesh.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/suggestion.hpp"
#include "shapes/builtin_shapes.hpp"

namespace geodisk::tools {
namespace {

constexpr std::string_view kBuiltin = "builtin:";

bool is_finite(const PolygonMesh& mesh, std::size_t vertex) {
    const auto coordinates =
        std::span(mesh.positions).subspan(vertex * mesh.dimension, mesh.dimension);
    return std::all_of(coordinates.begin(), coordinates.end(),
                       [](double x) { return std::isfinite(x); });
}

[[noreturn]] void fail_index(const Path& path, const PolygonMesh& mesh, std::size_t face,
                             std::uint32_t vertex) {
    fail_input(path, mesh.names.of_face(face) + ": vertex index " +
                         mesh.names.vertex_number(vertex) + " is out of range, the file has " +
                         std::to_string(mesh.vertex_count()) + " vertices");
}

[[noreturn]] void fail_not_finite(const Path& path, const PolygonMesh& mesh, std::size_t vertex) {
    fail_input(path, mesh.names.of_vertex(vertex) + ": the coordinates are not finite");
}

/// A face may name any vertex then, so that their number has to be bounded.
void check_bare_corners(const Path& path, const PolygonMesh& polygons) {
    const std::uint64_t bound = polygons.corners.size();
    for (const std::uint32_t vertex : polygons.corners) {
        if (vertex >= bound) {
            fail_input(path, "vertex index " + polygons.names.vertex_number(vertex) +
                                 " is out of range: without coordinates, a mesh of " +
                                 std::to_string(bound) + " corners has at most this many vertices");
        }
    }
}

/// Checks every face against the vertices; warns of unused vertices.
void check_corners(const Path& path, const PolygonMesh& polygons, MeshFile& mesh) {
    const std::size_t vertex_count = polygons.vertex_count();
    if (vertex_count > std::numeric_limits<std::uint32_t>::max()) {
        fail_input(path, "has more vertices than a face can refer to");
    }
    std::vector<bool> is_used(vertex_count, false);
    for (std::size_t i = 0; i < polygons.corners.size(); ++i) {
        const std::uint32_t vertex = polygons.corners[i];
        if (vertex >= vertex_count) {
            const auto face = std::ranges::upper_bound(polygons.face_ends, i);
            fail_index(path, polygons, static_cast<std::size_t>(face - polygons.face_ends.begin()),
                       vertex);
        }
        if (!is_used[vertex] && !is_finite(polygons, vertex)) {
            fail_not_finite(path, polygons, vertex);
        }
        is_used[vertex] = true;
    }
    Found unused, not_finite;
    for (std::size_t vertex = 0; vertex < vertex_count; ++vertex) {
        if (!is_used[vertex]) {
            (is_finite(polygons, vertex) ? unused : not_finite).add(vertex);
        }
    }
    const auto place = [&](const Found& found) {
        return found.count == 0 ? "" : polygons.names.of_vertex(found.first);
    };
    add_warning(mesh.warnings, "unused_vertices", unused.count, place(unused),
                "vertex is in no face", "vertices are in no face");
    add_warning(mesh.warnings, "unused_not_finite", not_finite.count, place(not_finite),
                "vertex that is in no face has coordinates that are not finite",
                "vertices that are in no face have coordinates that are not finite");
}

/// Refuses a mesh all of whose faces are flat.
void check_areas(const Path& path, const TriangleShapes& shapes, MeshFile& mesh) {
    if (shapes.with_area.count == 0) {
        fail_input(path, "has no face with an area");
    }
    if (const Found& found = shapes.without_area; found.count > 0) {
        add_warning(mesh.warnings, "zero_area_faces", found.count,
                    mesh.name_of_triangle(found.first),
                    "triangle without area kept: paths may lead through it",
                    "triangles without area kept: paths may lead through them");
    }
}

/// Polygons have sides but no diagonals.
void check_triangles(const Path& path, const PolygonMesh& polygons) {
    for (std::size_t face = 0; face < polygons.face_ends.size(); ++face) {
        if (const std::size_t size = polygons.face(face).size(); size > 3) {
            fail_input(path, polygons.names.of_face(face) + ": has " + std::to_string(size) +
                                 " corners; with edge lengths all faces must be triangles");
        }
    }
}

void check_size(const Path& path, const PolygonMesh& polygons) {
    const std::uint64_t triangles = triangles_of(polygons);
    if (triangles == 0) {
        fail_input(path, "has no faces of 3 or more corners");
    }
    constexpr std::uint32_t kMax = std::numeric_limits<std::uint32_t>::max();
    if (triangles > kMax || polygons.face_ends.size() > kMax) {
        fail_input(path, "has more faces than can be numbered");
    }
}

void split_polygons(PolygonMesh& polygons, MeshFile& mesh) {
    const auto [small, bent, polygon_count, repeating] = split_faces(polygons, mesh);
    const auto place = [&](const Found& found) {
        return found.count == 0 ? "" : polygons.names.of_face(found.first);
    };
    add_warning(mesh.warnings, "small_faces", small.count, place(small),
                "face with fewer than 3 corners makes no triangle",
                "faces with fewer than 3 corners make no triangle");
    warn_of_repeated_vertices(mesh.warnings, repeating.count, place(repeating));
    constexpr std::uint64_t kOneIn = 10; // A few are in many models, as at their poles.
    if (bent.count * kOneIn >= polygon_count) {
        add_warning(mesh.warnings, "bent_polygons", bent.count, place(bent),
                    "polygon is not flat: its surface depends on how it is split into triangles",
                    "polygons are not flat: their surface depends on how they are split into "
                    "triangles");
    }
}

void take_parts(PolygonMesh& polygons, MeshFile& mesh) {
    mesh.parts = std::move(polygons.parts);
    mesh.part_names = std::move(polygons.part_names);
    if (mesh.polygons.empty()) {
        mesh.part_of_triangle = std::move(polygons.part_of_face);
        return;
    }
    for (std::size_t t = 0; t < mesh.triangle_count() && !mesh.parts.empty(); ++t) {
        mesh.part_of_triangle.push_back(polygons.part_of_face[mesh.polygons[t]]);
    }
}

void drop_copied_triangles(MeshFile& mesh) {
    if (const Found copies = drop_copies(mesh); copies.count > 0) {
        add_warning(mesh.warnings, "duplicate_faces", copies.count,
                    mesh.name_of_triangle(copies.first), "copy of an earlier triangle dropped",
                    "copies of earlier triangles dropped");
    }
}

void take_lengths(EdgeLengths& lengths, MeshFile& mesh) {
    mesh.lengths.reserve(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const std::uint32_t* const corner = &mesh.triangles[3 * t];
        for (std::size_t k = 0; k < 3; ++k) {
            mesh.lengths.push_back(
                mesh.takes_part(t) ? lengths.between(corner[k], corner[(k + 1) % 3]) : 0);
        }
    }
    add_warning(mesh.warnings, "unused_lengths", lengths.unused(), "",
                "length of an edge that no face has ignored",
                "lengths of edges that no face has ignored");
}

/// Replaces the coordinates of a mesh, of either kind.
template <class Mesh>
void take_coordinates(const MeshSources& sources, Mesh& mesh) {
    Coordinates given = read_coordinates(sources.coordinates);
    const std::size_t count = given.positions.size() / given.dimension;
    const std::size_t vertices = mesh.positions.size() / mesh.dimension;
    if (vertices != 0 && count != vertices) {
        fail_input(sources.coordinates, "has the coordinates of " + std::to_string(count) +
                                            " vertices, but " + sources.mesh + " has " +
                                            std::to_string(vertices));
    }
    mesh.positions = std::move(given.positions);
    mesh.dimension = given.dimension;
}

/// Numbers vertices by their places, in the order of the corners.
void number_places(const std::string& path, MeshFile& mesh) {
    weld_mesh(path, mesh, {});
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> numbers(mesh.positions.size() / 3, kNone);
    std::vector<double> positions;
    std::vector<std::uint32_t> lines;
    for (std::uint32_t& vertex : mesh.triangles) {
        std::uint32_t& number = numbers[vertex];
        if (number == kNone) {
            number = static_cast<std::uint32_t>(positions.size() / 3);
            const double* const point = &mesh.positions[std::size_t{3} * vertex];
            positions.insert(positions.end(), point, point + 3);
            if (!mesh.names.vertex_lines.empty()) {
                lines.push_back(mesh.names.vertex_lines[vertex]);
            }
        }
        vertex = number;
    }
    mesh.names.vertex_lines = std::move(lines);
    positions.shrink_to_fit();
    mesh.positions = std::move(positions);
    for (std::vector<std::uint32_t>* const numbers_before : {&mesh.joined, &mesh.file_triangles}) {
        numbers_before->clear();
        numbers_before->shrink_to_fit();
    }
}

MeshFile to_triangles(const MeshSources& sources, PolygonMesh&& polygons,
                      bool has_places_alone = false) {
    const Path path = sources.mesh;
    const bool has_lengths = !sources.edge_lengths.empty();
    MeshFile mesh;
    mesh.warnings = std::move(polygons.warnings);
    if (polygons.face_ends.empty()) {
        fail_input(path, "has no faces");
    }
    if (!sources.coordinates.empty() && !has_places_alone) {
        take_coordinates(sources, polygons);
    }
    if (has_lengths) {
        check_triangles(path, polygons);
    }
    if (has_lengths && polygons.positions.empty()) {
        check_bare_corners(path, polygons);
    } else {
        check_corners(path, polygons, mesh);
    }
    check_size(path, polygons);
    split_polygons(polygons, mesh);
    take_parts(polygons, mesh);
    take_fields(path, add_value_files(sources.fields, polygons), polygons, mesh);
    mesh.positions = std::move(polygons.positions);
    mesh.dimension = polygons.dimension;
    mesh.names = std::move(polygons.names);
    if (has_places_alone) {
        number_places(sources.mesh, mesh);
        if (!sources.coordinates.empty()) {
            take_coordinates(sources, mesh);
        }
    }
    if (sources.weld) {
        weld_mesh(sources.mesh, mesh, *sources.weld);
    } else if (!has_lengths && !sources.keep_seams) {
        join_mesh_seams(sources.mesh, mesh);
    }
    drop_copied_triangles(mesh);
    if (has_lengths) {
        EdgeLengths lengths(sources.edge_lengths, mesh.names.first_vertex);
        take_lengths(lengths, mesh);
    } else {
        const TriangleShapes shapes = shapes_of(mesh);
        check_areas(path, shapes, mesh);
        warn_of_shapes(shapes, mesh);
    }
    return mesh;
}

/// Moves values of files into a mesh that has no attributes of its own.
void take_value_files(const Path& path, const WantedFields& wanted, MeshFile& mesh) {
    PolygonMesh vertices;
    vertices.positions = mesh.positions;
    vertices.dimension = mesh.dimension;
    take_fields(path, add_value_files(wanted, vertices), vertices, mesh);
}

/// `spec` is NAME or NAME:RESOLUTION.
MeshFile read_builtin(std::string_view spec) {
    const std::size_t colon = std::min(spec.find(':'), spec.size());
    std::optional<int> resolution;
    if (colon < spec.size()) {
        resolution = parse_integer<int>(spec.substr(colon + 1));
        if (!resolution) {
            fail_usage("builtin:" + std::string(spec) + ": " + in_quotes(spec.substr(colon + 1)) +
                       " is not a resolution");
        }
    }
    return make_builtin(spec.substr(0, colon), resolution);
}

/// Refuses options that need numbers of vertices, for a file that has places alone.
void check_no_numbers(const MeshSources& sources) {
    const std::vector<std::string> files = value_files(sources.fields);
    const std::string option = !sources.edge_lengths.empty() ? "--edge-lengths"
                               : !files.empty()     ? std::string(kValueFile) + files.front()
                               : sources.keep_seams ? "--keep-seams"
                                                    : sources.numbering;
    if (!option.empty()) {
        fail_usage(option + " needs numbers of vertices, which " + sources.mesh + " has not");
    }
}

std::string extension_of(const Path& path, const std::string& format) {
    return format.empty() ? lower_extension(path) : '.' + format;
}

struct MeshFormat {
    std::string_view name; ///< "obj", of files named *.obj.
    PolygonMesh (*read)(const Path& path, const MeshSources& sources);
    bool has_places_alone = false; ///< Vertices have no numbers.
};

PolygonMesh read_ply_of(const Path& path, const MeshSources& sources) {
    const bool has_other_source = !sources.coordinates.empty() || !sources.edge_lengths.empty();
    return read_ply(path, {!has_other_source, sources.fields},
                    FileScope(path, sources.allows_outside), sources.progress);
}

PolygonMesh read_obj_of(const Path& path, const MeshSources& sources) {
    return read_obj(path, sources.fields, FileScope(path, sources.allows_outside),
                    sources.progress);
}

PolygonMesh read_stl_of(const Path& path, const MeshSources& sources) {
    return read_stl(path, sources.progress);
}

PolygonMesh read_gltf_of(const Path& path, const MeshSources& sources) {
    return read_gltf(path, sources.fields, FileScope(path, sources.allows_outside));
}

PolygonMesh read_freesurfer_of(const Path& path, const MeshSources& sources) {
    return read_freesurfer(path, sources.progress);
}

template <PolygonMesh (*kRead)(const Path&, const WantedFields&)>
PolygonMesh read_fields_of(const Path& path, const MeshSources& sources) {
    return kRead(path, sources.fields);
}

template <PolygonMesh (*kRead)(const Path&, const WantedFields&, const ReadingProgress&)>
PolygonMesh read_records_of(const Path& path, const MeshSources& sources) {
    return kRead(path, sources.fields, sources.progress);
}

/// Lists are in this order.
constexpr std::array kMeshFormats{
    MeshFormat{"gltf", read_gltf_of},
    MeshFormat{"glb", read_gltf_of},
    MeshFormat{"obj", read_obj_of},
    MeshFormat{"off", read_records_of<read_off>},
    MeshFormat{"ply", read_ply_of},
    MeshFormat{"stl", read_stl_of, true},
    MeshFormat{"vtk", read_records_of<read_vtk>},
    MeshFormat{"vtp", read_fields_of<read_vtp>},
    MeshFormat{"gii", read_fields_of<read_gifti>},
    MeshFormat{"asc", read_freesurfer_of},
    MeshFormat{"usda", read_fields_of<read_usd>},
    MeshFormat{"usd", read_fields_of<read_usd>},
};

/// Files have no extension that tells them.
constexpr MeshFormat kByMagic{"freesurfer", read_freesurfer_of};

/// Throws UserError for a format that is unknown.
const MeshFormat& format_of(const MeshSources& sources) {
    const Path path = sources.mesh;
    const auto find = [](const std::string& extension) {
        return std::ranges::find_if(kMeshFormats, [&](const MeshFormat& format) {
            return extension == '.' + std::string(format.name);
        });
    };
    if (const auto found = find(extension_of(path, sources.format)); found != kMeshFormats.end()) {
        return *found;
    }
    if (sources.format == kByMagic.name) {
        return kByMagic;
    }
    if (!sources.format.empty()) {
        fail_usage("--mesh-format: " + in_quotes(sources.format) + " is none of " +
                   listed(mesh_formats()));
    }
    check_no_folder(path);
    if (const std::string extension = lower_extension(path);
        extension == ".usdc" || extension == ".usdz") {
        refuse_binary_usd(path);
    }
    if (begins_as_freesurfer(path)) {
        return kByMagic;
    }
    fail_input(path, "unknown mesh format; known are " + listed(mesh_extensions(), ", ") +
                         ", surfaces of FreeSurfer and builtin:NAME, or give --mesh-format");
}

} // namespace

MeshFile split_into_triangles(const MeshSources& sources, PolygonMesh&& polygons) {
    return to_triangles(sources, std::move(polygons));
}

bool is_builtin(const std::string& path) {
    return path.starts_with(kBuiltin);
}

MeshFile read_mesh(const MeshSources& sources) {
    const std::string& path = sources.mesh;
    if (!sources.coordinates.empty() && !sources.edge_lengths.empty()) {
        fail_usage("--coordinates and --edge-lengths contradict each other; give just one");
    }
    if (sources.weld && !sources.edge_lengths.empty()) {
        fail_usage("--weld and --edge-lengths contradict each other: lengths leave no coordinates "
                   "to join vertices by");
    }
    if (is_builtin(path)) {
        if (!sources.coordinates.empty() || !sources.edge_lengths.empty()) {
            fail_usage(path + " is complete; --coordinates and "
                              "--edge-lengths are for mesh files");
        }
        MeshFile mesh = read_builtin(std::string_view(path).substr(kBuiltin.size()));
        take_value_files(path, sources.fields, mesh);
        if (sources.weld) {
            weld_mesh(path, mesh, *sources.weld);
            drop_copied_triangles(mesh);
        }
        return mesh;
    }
    const MeshFormat& format = format_of(sources);
    if (format.has_places_alone) {
        check_no_numbers(sources);
    }
    return to_triangles(sources, format.read(path, sources), format.has_places_alone);
}

bool has_y_up(const Path& path, const std::string& format) {
    const std::string extension = extension_of(path, format);
    return extension == ".gltf" || extension == ".glb";
}

std::vector<std::string> mesh_formats() {
    std::vector<std::string> names = mesh_extensions("");
    names.emplace_back(kByMagic.name);
    return names;
}

std::vector<std::string> mesh_extensions(const std::string& before) {
    std::vector<std::string> names;
    names.reserve(kMeshFormats.size());
    for (const MeshFormat& format : kMeshFormats) {
        names.push_back(before + std::string(format.name));
    }
    return names;
}

MeshFile read_mesh(const std::string& path) {
    MeshSources sources;
    sources.mesh = path;
    return read_mesh(sources);
}

} // namespace geodisk::tools
