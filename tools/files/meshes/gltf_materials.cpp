#include "files/meshes/gltf_materials.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "program/human_text.hpp"
#include "program/suggestion.hpp"

namespace geodisk::tools {
namespace {

/// Two rows, see MaterialColour::transform. Angles turn from u to -v, as all viewers have it.
std::array<double, 6> transform_of(const std::vector<double>& offset, double angle,
                                   const std::vector<double>& scale) {
    const double ou = offset.empty() ? 0 : offset[0], ov = offset.empty() ? 0 : offset[1];
    const double su = scale.empty() ? 1 : scale[0], sv = scale.empty() ? 1 : scale[1];
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * su, s * sv, ou, -s * su, c * sv, ov};
}

/// Returns the extensions that an object has, for messages.
std::string extensions_of(const GltfJson& object) {
    std::vector<std::string> names;
    if (const auto found = object.find("extensions"); found != object.end() && found->is_object()) {
        for (const auto& [name, unused] : found->items()) {
            names.push_back(name);
        }
    }
    return names.empty() ? "" : "; what " + listed(names) + " has is not read";
}

} // namespace

std::string GltfMaterials::read(std::uint32_t material) {
    const auto [uvs, is_new] = uvs_.try_emplace(material);
    if (!is_new) {
        return uvs->second;
    }
    const GltfJson& object = document_.at("materials", "material", material);
    const std::string number = "material " + std::to_string(material);
    const std::string name = document_.text(object, "name", number);
    const std::string where = name.empty() ? number : "material " + in_quotes(name);
    const GltfJson* const diffuse =
        document_.find_extension(object, "KHR_materials_pbrSpecularGlossiness", where);
    const GltfJson* const base =
        diffuse != nullptr ? diffuse : document_.find_object(object, "pbrMetallicRoughness", where);
    MaterialColour colour;
    colour.is_linear = true;
    if (base != nullptr) {
        const std::vector<double> factor = document_.numbers(
            *base, diffuse != nullptr ? "diffuseFactor" : "baseColorFactor", 4, where);
        std::copy_n(factor.begin(), std::min(factor.size(), colour.factor.size()),
                    colour.factor.begin());
        const GltfJson* const info = document_.find_object(
            *base, diffuse != nullptr ? "diffuseTexture" : "baseColorTexture", where);
        uvs->second = info == nullptr ? "" : add_image(*info, colour, where);
    }
    read_.colours.resize(std::max(read_.colours.size(), std::size_t{material} + 1));
    read_.colours[material] = colour;
    return uvs->second;
}

std::optional<MaterialColours> GltfMaterials::take() && {
    return document_.count("materials") == 0 ? std::nullopt : std::optional(std::move(read_));
}

/// Returns the attribute of its texture coordinates.
std::string GltfMaterials::add_image(const GltfJson& info, MaterialColour& colour,
                                     const std::string& where) {
    const GltfJson& texture =
        document_.at("textures", "texture", document_.index(info, "index", where));
    colour.image = image_of(texture, where);
    if (const auto index = document_.find_index(texture, "sampler", where)) {
        const GltfJson& sampler = document_.at("samplers", "sampler", *index);
        colour.wrap_u = wrap_of(sampler, "wrapS", where);
        colour.wrap_v = wrap_of(sampler, "wrapT", where);
    }
    std::uint64_t set = document_.index_or(info, "texCoord", 0, where);
    if (const GltfJson* const moved =
            document_.find_extension(info, "KHR_texture_transform", where)) {
        set = document_.index_or(*moved, "texCoord", set, where);
        colour.transform = transform_of(document_.numbers(*moved, "offset", 2, where),
                                        document_.number_or(*moved, "rotation", 0, where),
                                        document_.numbers(*moved, "scale", 2, where));
    }
    return "TEXCOORD_" + std::to_string(set);
}

/// The image of WebP is the better one, where there is another for readers that do not know it.
std::optional<std::uint64_t> GltfMaterials::source_of(const GltfJson& texture,
                                                      const std::string& where) const {
    const GltfJson* const webp = document_.find_extension(texture, "EXT_texture_webp", where);
    const auto source =
        webp == nullptr ? std::nullopt : document_.find_index(*webp, "source", where);
    return source ? source : document_.find_index(texture, "source", where);
}

std::uint32_t GltfMaterials::image_of(const GltfJson& texture, const std::string& where) {
    const std::optional<std::uint64_t> source = source_of(texture, where);
    if (!source) {
        document_.fail(where + ": its texture has no PNG, JPEG or WebP image" +
                       extensions_of(texture));
    }
    const auto next = static_cast<std::uint32_t>(read_.images.size());
    const auto [index, is_new] = indices_.try_emplace(*source, next);
    if (!is_new) {
        return index->second;
    }
    const GltfJson& image = document_.at("images", "image", *source);
    const std::string name = where + ": image " + std::to_string(*source);
    const std::string uri = document_.text(image, "uri", name);
    const bool is_file = !uri.empty() && !uri.starts_with("data:");
    read_.images.push_back({document_.path().string() + ": " + name + (is_file ? ", " + uri : ""),
                            uri.empty() ? std::string(data_.view_bytes(
                                              document_.index(image, "bufferView", name), name))
                                        : data_.uri_bytes(uri, name)});
    return next;
}

ImageWrap GltfMaterials::wrap_of(const GltfJson& sampler, const char* name,
                                 const std::string& where) const {
    constexpr std::uint64_t kRepeat = 10497, kClamp = 33071, kMirror = 33648;
    switch (const std::uint64_t mode = document_.index_or(sampler, name, kRepeat, where)) {
    case kRepeat:
        return ImageWrap::repeat;
    case kClamp:
        return ImageWrap::clamp;
    case kMirror:
        return ImageWrap::mirror;
    default:
        document_.fail(where + ": the sampler of its texture has the unknown " + name + ' ' +
                       std::to_string(mode));
    }
}

} // namespace geodisk::tools
