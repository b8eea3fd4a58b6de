// The readers of mesh files, and what they hand over: faces as the file lists them, not yet checked
// against the vertices and not yet split into triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "files/meshes/file_scope.hpp"
#include "files/meshes/mesh_fields.hpp"
#include "files/meshes/reading_progress.hpp"
#include "geometry/mesh.hpp"
#include "geometry/mesh_warning.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

struct PolygonMesh {
    std::vector<double> positions; ///< `dimension` coordinates per vertex, if any.
    std::uint32_t dimension = 3;
    std::vector<std::uint32_t> corners; ///< Vertex indices of all faces, one face after another.
    std::vector<std::size_t> face_ends; ///< For each face, the end of its corners.
    /// Texture coordinates, if asked for: two each, and the one of every corner, or kNoUv.
    std::vector<double> uvs;
    std::vector<std::uint32_t> corner_uvs;
    bool has_lost_uvs = false; ///< They are left out, with a warning, as they cannot be read.
    /// Parts that the file divides its faces into, if it does, and the index there of each face's.
    std::vector<MeshPart> parts;
    std::vector<std::uint32_t> part_of_face;
    PartNames part_names;
    /// Attributes that the file has, with values where asked for. Texture coordinates are in
    /// `uvs` instead.
    std::vector<MeshField> fields;
    /// Columns of a PLY file among WantedFields::numbers, by names that no attribute has: "nx".
    std::vector<MeshField> own_columns;
    std::optional<MeshField> normals;         ///< Those of the file, where asked for and there.
    std::optional<MaterialColours> materials; ///< Colours of materials, where asked for and there.
    /// Texture coordinates of each corner for its material, where they are not the field "uv".
    std::optional<MeshField> material_uvs;
    ElementNames names;
    std::vector<MeshWarning> warnings;

    static constexpr std::uint32_t kNoUv = std::numeric_limits<std::uint32_t>::max();

    std::size_t vertex_count() const { return positions.size() / dimension; }
    /// The corners of a face.
    std::span<const std::uint32_t> face(std::size_t index) const {
        const std::size_t begin = index == 0 ? 0 : face_ends[index - 1];
        return std::span(corners).subspan(begin, face_ends[index] - begin);
    }
};

/// Adds a warning of `count` NUL bytes that were dropped after the last line.
inline void warn_of_final_nuls(PolygonMesh& mesh, std::uint64_t count) {
    add_warning(mesh.warnings, "trailing_data", count, "", "NUL byte after the last line ignored",
                "NUL bytes after the last line ignored");
}

/// Reads the `v`, `f`, `usemtl`, `g`, `o` and, where asked for, `vt`, `vn` and `mtllib` records of
/// an OBJ file, for the last with the MTL files of `scope` that it names; everything else in it is
/// ignored. Understands every line end, line continuation, a byte order mark, relative indices and
/// faces of any size. Throws UserError(bad_input) naming the line, like the readers of other texts
/// below.
PolygonMesh read_obj(const Path& path, const WantedFields& fields, const FileScope& scope,
                     const ReadingProgress& progress);

/// Reads an STL file, binary if its size is as it tells or it does not begin with "solid", else
/// ascii: three vertices for each facet, so that no two facets hang together until vertices are
/// joined.
PolygonMesh read_stl(const Path& path, const ReadingProgress& progress);

/// Reads an ascii OFF file, with or without normals, colours and texture coordinates in the lines
/// of vertices and faces, one line to a record. nOFF has vertices of 3 to 8 coordinates.
PolygonMesh read_off(const Path& path, const WantedFields& fields, const ReadingProgress& progress);

/// Reads all triangles, strips and fans of the scene of a glTF 2.0 file, text or binary, one mesh
/// and primitive after the other. Nodes place them, or joints and the default weights of morph
/// targets, also several times as instances; a mirrored one is turned over. Primitives of a mesh
/// with the same positions share vertices. Compressed ones are read as this build can. Buffers are
/// read, colours and images of materials only where asked for. Throws UserError(bad_input) naming
/// mesh and primitive.
PolygonMesh read_gltf(const Path& path, const WantedFields& fields, const FileScope& scope);

/// Data to read of element `vertex`.
struct PlyWanted {
    bool has_coordinates = true; ///< False: if it has no coordinates, do without.
    WantedFields fields;
};

/// Reads the coordinates of element `vertex`, which are x0 x1 ..., 3 to 8 of them, where there is
/// an x0, and x y z otherwise, and the list `vertex_indices` or `vertex_index` of element `face`
/// and of strips of triangles in element `tristrips`, in any format, type and order; everything
/// else is skipped but, where asked for, the images of `scope` that comments name. Throws
/// UserError(bad_input) naming the element and record.
PolygonMesh read_ply(const Path& path, PlyWanted wanted, const FileScope& scope,
                     const ReadingProgress& progress);

/// Reads polygons and strips of triangles of VTK's legacy format, version 1 to 5, text or binary:
/// of polygonal data, and of an unstructured grid of such cells alone. Cells of other kinds are
/// refused by name if they have a volume, and ignored if they have no area.
PolygonMesh read_vtk(const Path& path, const WantedFields& fields, const ReadingProgress& progress);

/// Reads the same of VTK's XML format (`.vtp`), whose arrays are text, base64 or appended, also
/// compressed by zlib. Without pugixml, this and read_gifti() throw UserError(bad_input).
PolygonMesh read_vtp(const Path& path, const WantedFields& fields);

/// Reads the surface of a GIFTI file (`.surf.gii`). Coordinates are as the file has them: a warning
/// tells of a transform to another space.
PolygonMesh read_gifti(const Path& path, const WantedFields& fields);

/// Reads triangles of FreeSurfer, binary or text (`.asc`).
PolygonMesh read_freesurfer(const Path& path, const ReadingProgress& progress);

/// Reads all meshes of a text of USD (`.usda`) that viewers show, placed by the operations of their
/// prims and of those above. One that is left-handed or mirrored is turned over. Throws
/// UserError(bad_input) naming the line and the prim, also for what is in other files.
PolygonMesh read_usd(const Path& path, const WantedFields& fields);

/// Throws UserError(bad_input) that names the command that makes text of a binary file of USD.
[[noreturn]] void refuse_binary_usd(const Path& path);

/// Returns true for binary surfaces of FreeSurfer, whose files have no common extension. Reads no
/// stream.
bool begins_as_freesurfer(const Path& path);

} // namespace geodisk::tools
