// Texture coordinates of a mesh, v = 0 at the lower edge of an image.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/mesh.hpp"

namespace geodisk::tools {

/// Texture coordinates of a vertex.
struct VertexUv {
    std::uint32_t vertex;
    double u, v;

    friend auto operator<=>(const VertexUv&, const VertexUv&) = default;
};

/// Returns the MeshFile::texture_uvs of a corner of a face.
std::array<double, 2> uv_of_corner(const MeshFile& mesh, std::size_t face, std::size_t k);

/// Returns where the centre of a triangle is in the image of its material.
std::array<double, 2> image_centre(const MeshFile& mesh, const MaterialColour& material,
                                   std::size_t triangle);

/// Sorts texture coordinates, and drops copies.
void sort_uvs(std::vector<VertexUv>& uvs);

/// Returns the MeshFile::texture_uvs of all corners. They ascend by vertex, each just once, with
/// several at a vertex on a seam.
std::vector<VertexUv> vertex_uvs(const MeshFile& mesh);

} // namespace geodisk::tools
