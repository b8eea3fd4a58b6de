// Reads triangle meshes from files and from the built-in generators, and writes them to
// PLY files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files/meshes/mesh_fields.hpp"
#include "files/meshes/reading_progress.hpp"
#include "geometry/mesh.hpp"
#include "program/arguments.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// The files that make up a mesh.
struct MeshSources {
    std::string mesh;         ///< File of one of mesh_formats(), or `builtin:NAME[:RESOLUTION]`.
    std::string format;       ///< "obj", or "" for that of the extension.
    std::string coordinates;  ///< See read_coordinates(); they replace those of the mesh. Or "".
    std::string edge_lengths; ///< See EdgeLengths, numbered as the mesh is. Or "".
    WantedFields fields{};    ///< Attributes and numbers to read.
    /// Join vertices no farther apart; with a length of 0, those in one place,
    /// as of STL in any case.
    std::optional<Length> weld = std::nullopt;
    ReadingProgress progress = {}; ///< Progress of reading the mesh file; not for glTF and XML.
    /// Leave border edges apart that lie exactly on others. They are joined otherwise, unless
    /// `weld` or `edge_lengths` is given.
    bool keep_seams = false;
    std::string numbering{};     ///< The option whose file numbers vertices; or "".
    bool allows_outside = false; ///< Read files that the mesh names anywhere, see FileScope.
};

/// Reads a mesh.
///
/// Every index is in range, every used vertex is finite, and at least one triangle has an area (but
/// with edge lengths, which are not judged). Triangles that repeat a vertex or copy an earlier one
/// are dropped with a warning: they keep their number but take no part. Triangles without area are
/// kept, as paths may lead through them.
///
/// Throws UserError(bad_input) that names the file, the cause, and the line or element;
/// UserError(usage) for an unknown built-in name or resolution, or sources that contradict each
/// other.
MeshFile read_mesh(const MeshSources& sources);

struct PolygonMesh;

/// Makes a mesh of polygons that no file has, as read_mesh() does of those of a file.
/// `sources.mesh` names them in messages.
MeshFile split_into_triangles(const MeshSources& sources, PolygonMesh&& polygons);

/// The names of all formats: "obj".
std::vector<std::string> mesh_formats();
/// The extensions that tell a format, behind `before`: ".obj".
std::vector<std::string> mesh_extensions(const std::string& before = ".");

/// Returns true for the formats in which y points up: glTF. `format` is "" for that of the
/// extension.
bool has_y_up(const Path& path, const std::string& format);

/// Returns true if `path` is "builtin:NAME" rather than a file.
bool is_builtin(const std::string& path);

/// Reads the mesh of one file.
MeshFile read_mesh(const std::string& path);

/// Writes positions and triangles as binary PLY that reads back exactly: element vertex with double
/// x y z, and beyond three dimensions also x0 x1 ..., of which x y z repeat the first three so that
/// viewers show them; element face with vertex_indices. The file appears complete or not at all.
/// Throws UserError(usage) for another extension, UserError(bad_output) when it cannot be written.
void write_mesh(const Path& path, const MeshFile& mesh);

} // namespace geodisk::tools
