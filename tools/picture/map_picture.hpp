// Pictures of maps, as textures of their mesh.
#pragma once

#include <cstdint>
#include <span>

#include "files/samples/map_file.hpp"
#include "picture/picture.hpp"

namespace geodisk::tools::picture {

/// Draws the cells of samples, each in its colour as distinct_colors() counts them: 28 of these
/// differ. Texels without a distance are transparent, those without a sample are light grey.
Pixels cell_pixels(const SampleMap& map, std::span<const std::uint32_t> colors);

/// Draws distances as grey: black at a sample, white at the largest one. Texels without a distance
/// are transparent, those without a sample are light grey.
Pixels distance_pixels(const SampleMap& map);

/// The same in 16 bits, where texels without a sample are white.
DeepPixels deep_distance_pixels(const SampleMap& map);

} // namespace geodisk::tools::picture
