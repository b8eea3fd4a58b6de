// Maps: the nearest sample of each texel of a texture.
#pragma once

#include <cstdint>
#include <vector>

#include "files/output/output_file.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// Values of texels, row by row. The first one has the corner u = 0, v = 1.
struct SampleMap {
    static constexpr std::int32_t kNone = -1;
    static constexpr std::uint32_t kNoFace = ~std::uint32_t{0}; ///< Written as -1.

    std::uint32_t width = 0, height = 0;
    std::vector<std::int32_t> samples; ///< The nearest one, or kNone.
    std::vector<float> distances; ///< In mesh units; infinite without a sample, NaN without a face.
    std::vector<std::uint32_t> faces; ///< The face that covers the centre, or kNoFace.
};

enum class MapFormat : std::uint8_t { npz, npy, png };

/// Returns the format of that extension. Throws UserError(usage) for another one.
MapFormat map_format(const Path& path);

/// Writes the arrays sample, distance and face, of the shape (height, width), as an .npz archive.
void write_arrays(AtomicFile& file, const SampleMap& map);

/// Writes the distances alone, as an .npy array.
void write_distances(AtomicFile& file, const SampleMap& map);

} // namespace geodisk::tools
