// Reads triangle meshes from OBJ and PLY files, and from the built-in generators.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

namespace geodisk::tools {

/// Texture coordinates of a vertex.
struct VertexUv {
    std::uint32_t vertex;
    double u, v;

    friend auto operator<=>(const VertexUv&, const VertexUv&) = default;
};

/// A mesh as read: `positions` holds `dimension` coordinates per vertex, `triangles` three vertex
/// indices each, in file order with polygons split in place (so triangle i of the file's n-th face
/// follows all triangles of earlier faces). Vertices are those of the file, in its order, also the
/// unused.
struct MeshFile {
    std::vector<double> positions; ///< Empty for a mesh of edge lengths without coordinates.
    std::vector<std::uint32_t> triangles;
    std::uint32_t dimension = 3;
    /// Of the edges of each triangle, from corner to corner, where they and not the positions make
    /// the surface; else empty.
    std::vector<double> lengths;
    std::vector<std::vector<double>> attributes; ///< By name as asked for, a value per vertex.
    /// Where asked for: all that the corners of faces have, ascending by vertex and each just once;
    /// several at a vertex on a seam.
    std::vector<VertexUv> uvs;
    std::vector<std::string>
        warnings; ///< One line each: what was repaired or ignored, with counts.
};

/// The files that make up a mesh.
struct MeshSources {
    std::string mesh; ///< `*.obj`, `*.ply` (in capitals or not) or `builtin:NAME[:RESOLUTION]`.
    std::string coordinates;  ///< See read_coordinates(); they replace those of the mesh. Or "".
    std::string edge_lengths; ///< See EdgeLengths, numbered as the mesh is. Or "".
    std::vector<std::string> attributes; ///< Scalar vertex properties of a PLY file to read.
    bool has_uvs = false; ///< Read texture coordinates: `vt` of OBJ, see PlyWanted for PLY.
};

/// Reads a mesh.
///
/// Every index is in range, every used vertex is finite, at least one triangle has an area (but
/// with edge lengths, which are not judged), and no triangle repeats a vertex or is a copy of an
/// earlier one: such faces are dropped with a warning. Triangles without area are kept, as paths
/// may lead through them.
///
/// Throws UserError(bad_input) that names the file, the cause, and the line or element;
/// UserError(usage) for an unknown built-in name or resolution, or sources that contradict each
/// other.
MeshFile read_mesh(const MeshSources& sources);

/// Of one file.
MeshFile read_mesh(const std::string& path);

} // namespace geodisk::tools
