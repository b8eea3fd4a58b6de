#include "files/images/textures.hpp"

#include <algorithm>

#include "files/images/srgb_encoding.hpp"

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

Textures::Textures(const Path& image) : of_all_(MaterialColour{}) {
    of_all_->image = 0;
    images_.emplace_back(image);
}

Textures::Textures(const MaterialColours& materials) {
    for (const ImageFile& image : materials.images) {
        images_.emplace_back(image);
    }
}

std::array<double, 3> Textures::colour(const MaterialColour& material,
                                       const std::optional<std::array<double, 2>>& place) const {
    std::array<double, 3> colour{1, 1, 1};
    if (place && material.image) {
        colour =
            images_[*material.image].at((*place)[0], (*place)[1], material.wrap_u, material.wrap_v);
    }
    for (std::size_t i = 0; i < colour.size(); ++i) {
        colour[i] = multiplied(material.factor[i], material.is_linear, colour[i]);
    }
    return colour;
}

} // namespace geodisk::tools
