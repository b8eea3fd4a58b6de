// What the OBJ and PLY readers hand over: faces as the file lists them, not yet checked against
// the vertices and not yet split into triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace geodisk::tools {

struct PolygonMesh {
    std::vector<double> positions; ///< `dimension` coordinates per vertex, if any.
    std::uint32_t dimension = 3;
    std::vector<std::vector<double>> attributes; ///< Those asked for, a value per vertex each.
    std::vector<std::uint32_t> corners; ///< Vertex indices of all faces, one face after another.
    std::vector<std::size_t> face_ends; ///< For each face, the end of its corners.
    /// Where asked for: texture coordinates, two each, and the one of every corner, or kNoUv.
    std::vector<double> uvs;
    std::vector<std::uint32_t> corner_uvs;
    std::vector<std::string> warnings;

    /// 1-based line of each vertex and face for messages; empty where records have no lines.
    std::vector<std::uint32_t> vertex_lines;
    std::vector<std::uint32_t> face_lines;

    static constexpr std::uint32_t kNoUv = std::numeric_limits<std::uint32_t>::max();

    std::size_t vertex_count() const { return positions.size() / dimension; }
};

} // namespace geodisk::tools
