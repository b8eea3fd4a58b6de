// Colours of a surface, by the images and materials of its faces.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "files/images/image.hpp"
#include "geometry/material_colours.hpp"
#include "geometry/mesh.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// The colours of one image for all faces, or of the material of each face.
class Textures {
  public:
    /// Reads an image for all faces, or a set of tiles. Throws UserError(bad_input) as ColourImage,
    /// and for a tile that is not there but that a face of `mesh` lies in.
    Textures(const MeshFile& mesh, const Path& image);
    /// Decodes the images of the materials of `mesh`. Throws UserError(bad_input) likewise.
    explicit Textures(const MeshFile& mesh);

    /// Returns the material of a triangle; null for none.
    const MaterialColour* material(const MeshFile& mesh, std::size_t triangle) const {
        return of_all_ ? &*of_all_ : mesh.material_colour(triangle);
    }
    /// Returns the colour of a material, from 0 to 1 as sRGB encodes it. `place` is where in its
    /// image, v = 0 the lower edge; without, the image is left out. `centre` is that of the face.
    std::array<double, 3> colour(const MaterialColour& material,
                                 const std::optional<std::array<double, 2>>& place,
                                 const std::array<double, 2>& centre) const;

  private:
    /// Throws UserError(bad_input) for a face in a tile that its material has no image of.
    void check_tiles(const MeshFile& mesh) const;
    std::array<double, 3> image_colour(const MaterialColour& material,
                                       const std::array<double, 2>& place,
                                       const std::array<double, 2>& centre) const;

    std::optional<MaterialColour> of_all_;
    std::vector<ColourImage> images_; ///< As in MaterialColours.
};

} // namespace geodisk::tools
