#include "files/meshes/material_fields.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

#include "files/meshes/polygon_mesh.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

/// Refuses texture coordinates that are not finite where the image is.
void check_places(const Path& path, const ElementNames& names, std::size_t face,
                  const MaterialColour& material, const MeshField& uvs, std::size_t triangle) {
    for (std::size_t k = 3 * triangle; k < 3 * triangle + 3; ++k) {
        const double* const uv = &uvs.values[std::size_t{2} * uvs.corners[k]];
        for (const double at : material.place(uv[0], uv[1])) {
            if (!std::isfinite(at)) {
                fail_input(path, names.of_face(face) +
                                     ": its texture coordinates are too large where its material "
                                     "puts them");
            }
        }
    }
}

} // namespace

void take_materials(const Path& path, PolygonMesh& polygons, MeshFile& mesh) {
    if (!polygons.materials && !mesh.vertex_colours) {
        fail_input(path, "has no materials, which --texture auto needs; only glTF files, OBJ "
                         "files with MTL files, and PLY files with images, may have them");
    }
    mesh.materials = std::move(polygons.materials).value_or(MaterialColours{});
    Found without, bare;
    std::size_t last = MeshField::kNone;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const std::size_t face = mesh.polygons.empty() ? t : mesh.polygons[t];
        const bool is_new = std::exchange(last, face) != face;
        const MaterialColour* const material = mesh.material_colour(t);
        const bool has_image = material != nullptr && material->image;
        if (has_image && mesh.has_texture_uvs(t)) {
            check_places(path, polygons.names, face, *material, *mesh.texture_uvs, t);
        } else if (is_new && has_image) {
            bare.add(face);
        } else if (is_new && material == nullptr && !mesh.has_values(mesh.vertex_colours, t)) {
            without.add(face);
        }
    }
    const auto place = [&](const Found& found) {
        return found.count == 0 ? "" : polygons.names.of_face(found.first);
    };
    add_warning(mesh.warnings, "no_material", without.count, place(without),
                "face without material is white", "faces without material are white");
    add_warning(mesh.warnings, "no_texture_coordinates", bare.count, place(bare),
                "face has a texture but no texture coordinates, so only the colour of its material",
                "faces have a texture but no texture coordinates, so only the colour of their "
                "material");
}

} // namespace geodisk::tools
