// Pictures of maps, as textures of their mesh.
#pragma once

#include "files/map_file.hpp"
#include "picture/picture.hpp"

namespace geodisk::tools::picture {

/// Draws the cells of samples in the colours of Style::voronoi, or with Style::distance the
/// distance as grey: black at a sample, white at the largest one. Texels without a face are
/// transparent, those without a sample are bare.
Pixels map_pixels(const SampleMap& map, Style style);

} // namespace geodisk::tools::picture
