// Padding of maps: texels around islands of a texture, which filters of renderers read.
#pragma once

#include <cstdint>

#include "files/samples/map_file.hpp"

namespace geodisk::tools {

/// Fills texels without a face with the sample and the distance of the nearest texel that has one,
/// up to `padding` texels away; of equally near ones the upper, then the left one. Their face stays
/// kNoFace. Returns their number. Takes four bytes for each texel meanwhile.
std::uint64_t pad(SampleMap& map, std::uint32_t padding);

} // namespace geodisk::tools
