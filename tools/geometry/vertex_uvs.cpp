#include "geometry/vertex_uvs.hpp"

#include <algorithm>

namespace geodisk::tools {

std::array<double, 2> uv_of_corner(const MeshFile& mesh, std::size_t face, std::size_t k) {
    const MeshField& uvs = *mesh.texture_uvs;
    const std::size_t value = mesh.value_index(uvs, 3 * face + k);
    const double v = uvs.values[2 * value + 1];
    return {uvs.values[2 * value], uvs.is_from_top ? 1 - v : v};
}

std::array<double, 2> image_centre(const MeshFile& mesh, const MaterialColour& material,
                                   std::size_t triangle) {
    const MeshField& uvs = *mesh.texture_uvs;
    double u = 0, v = 0;
    for (std::size_t corner = 3 * triangle; corner < 3 * triangle + 3; ++corner) {
        const double* const uv = &uvs.values[2 * mesh.value_index(uvs, corner)];
        u += uv[0] / 3;
        v += uv[1] / 3;
    }
    std::array<double, 2> centre = material.place(u, v);
    centre[1] = uvs.is_from_top ? 1 - centre[1] : centre[1];
    return centre;
}

void sort_uvs(std::vector<VertexUv>& uvs) {
    std::ranges::sort(uvs);
    uvs.erase(std::unique(uvs.begin(), uvs.end()), uvs.end());
}

std::vector<VertexUv> vertex_uvs(const MeshFile& mesh) {
    std::vector<VertexUv> uvs;
    for (std::size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
        if (mesh.takes_part(corner / 3)) {
            const auto [u, v] = uv_of_corner(mesh, corner / 3, corner % 3);
            uvs.push_back({mesh.triangles[corner], u, v});
        }
    }
    sort_uvs(uvs);
    return uvs;
}

} // namespace geodisk::tools
