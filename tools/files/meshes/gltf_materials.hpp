// The colours of the materials of a glTF file.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "files/meshes/gltf_data.hpp"
#include "files/meshes/gltf_json.hpp"
#include "geometry/material_colours.hpp"

namespace geodisk::tools {

/// Reads the base colour of materials, or the diffuse one where KHR_materials_pbrSpecularGlossiness
/// gives it, with its image. Throws UserError(bad_input) naming the material.
class GltfMaterials {
  public:
    GltfMaterials(const GltfDocument& document, GltfData& data)
        : document_(document), data_(data) {}

    /// Reads a material that faces use. Returns the attribute that has the texture coordinates for
    /// its image, as "TEXCOORD_0"; "" without image.
    std::string read(std::uint32_t material);

    /// Returns the materials that were read; nothing if the file has none.
    std::optional<MaterialColours> take() &&;

  private:
    std::string add_image(const GltfJson& info, MaterialColour& colour, const std::string& where);
    std::optional<std::uint64_t> source_of(const GltfJson& texture, const std::string& where) const;
    std::uint32_t image_of(const GltfJson& texture, const std::string& where);
    ImageWrap wrap_of(const GltfJson& sampler, const char* name, const std::string& where) const;

    const GltfDocument& document_;
    GltfData& data_;
    MaterialColours read_;
    std::map<std::uint32_t, std::string> uvs_;       ///< By material.
    std::map<std::uint64_t, std::uint32_t> indices_; ///< Indices of images read, by their number.
};

} // namespace geodisk::tools
