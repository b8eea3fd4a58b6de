#include "files/images/textures.hpp"

#include <algorithm>

#include "files/images/srgb_encoding.hpp"
#include "files/meshes/image_tiles.hpp"
#include "geometry/vertex_uvs.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

double multiplied(double factor, bool is_linear, double encoded) {
    if (factor == 1) {
        return encoded; // Without rounding.
    }
    const double product = is_linear ? encoded_light(factor * light_of(encoded)) : factor * encoded;
    return std::clamp(product, 0.0, 1.0);
}

} // namespace

Textures::Textures(const MeshFile& mesh, const Path& image) : of_all_(MaterialColour{}) {
    of_all_->image = 0;
    const std::u8string utf8 = image.generic_u8string();
    const auto set = tile_name(std::string(utf8.begin(), utf8.end()));
    if (set && set->is_pattern) {
        of_all_->has_tiles_by_name = true;
        for (const auto& [tile, file] : find_tiles("", *set)) {
            of_all_->tiles[tile] = static_cast<std::uint32_t>(images_.size());
            images_.emplace_back(Path(file));
        }
    }
    if (images_.empty()) {
        images_.emplace_back(image);
    }
    check_tiles(mesh);
}

Textures::Textures(const MeshFile& mesh) {
    check_tiles(mesh);
    for (const ImageFile& image : mesh.materials->images) {
        images_.emplace_back(image);
    }
}

void Textures::check_tiles(const MeshFile& mesh) const {
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const MaterialColour* const colour = material(mesh, t);
        if (colour == nullptr || !colour->has_tiles_by_name || !mesh.takes_part(t) ||
            !mesh.has_texture_uvs(t)) {
            continue;
        }
        const auto tile = MaterialColour::tile_at(image_centre(mesh, *colour, t));
        if (!tile || !colour->tiles.contains(*tile)) {
            throw UserError(ExitCode::bad_input,
                            mesh.name_of_triangle(t) +
                                (tile ? ": lies in tile " + std::to_string(*tile) +
                                            " of its texture (UDIM), whose image is not there"
                                      : ": lies beyond all tiles of its texture (UDIM)"));
        }
    }
}

std::array<double, 3> Textures::image_colour(const MaterialColour& material,
                                             const std::array<double, 2>& place,
                                             const std::array<double, 2>& centre) const {
    // On the edge of two tiles it is that of the face.
    constexpr double kInside = 1e-6;
    const auto tile = material.tiles.empty()
                          ? std::nullopt
                          : MaterialColour::tile_at({place[0] + kInside * (centre[0] - place[0]),
                                                     place[1] + kInside * (centre[1] - place[1])});
    const auto found = tile ? material.tiles.find(*tile) : material.tiles.end();
    if (found == material.tiles.end()) {
        return images_[*material.image].at(place[0], place[1], material.wrap_u, material.wrap_v);
    }
    const std::uint32_t column = (*tile - kFirstTile) % kTilesPerRow;
    const std::uint32_t row = (*tile - kFirstTile) / kTilesPerRow;
    return images_[found->second].at(place[0] - column, place[1] - row, ImageWrap::clamp,
                                     ImageWrap::clamp);
}

std::array<double, 3> Textures::colour(const MaterialColour& material,
                                       const std::optional<std::array<double, 2>>& place,
                                       const std::array<double, 2>& centre) const {
    std::array<double, 3> colour{1, 1, 1};
    if (place && material.image) {
        colour = image_colour(material, *place, centre);
    }
    for (std::size_t i = 0; i < colour.size(); ++i) {
        colour[i] = multiplied(material.factor[i], material.is_linear, colour[i]);
    }
    return colour;
}

} // namespace geodisk::tools
