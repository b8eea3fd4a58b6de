// Triangle meshes as read from files or generated, before the library prepares them.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

namespace geodisk::tools {

/// Fewest and most coordinates a vertex may have in a file.
inline constexpr std::uint32_t kFewestCoordinates = 3;
inline constexpr std::uint32_t kMostCoordinates = 8;

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

} // namespace geodisk::tools
