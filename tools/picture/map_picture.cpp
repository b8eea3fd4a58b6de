#include "picture/map_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "files/block_writer.hpp"
#include "picture/srgb.hpp"
#include "picture/surface_content.hpp"

namespace geodisk::tools::picture {
namespace {

using Light = std::array<float, 3>;

// As kBare in colors.glsl.
constexpr Light kBare{0.81f, 0.80f, 0.77f};

/// As cell_color() in colors.glsl.
Light cell_light(std::uint32_t number) {
    constexpr Light kKinds[7] = {{0.79f, 0.34f, 0.0f},   {0.093f, 0.456f, 0.815f},
                                 {0.0f, 0.342f, 0.171f}, {0.871f, 0.776f, 0.054f},
                                 {0.0f, 0.168f, 0.445f}, {0.665f, 0.112f, 0.0f},
                                 {0.604f, 0.19f, 0.386f}};
    const float part = 0.35f + 0.11f * static_cast<float>((number >> 8) % 4);
    Light light = kKinds[number % 7];
    for (float& one : light) {
        one += part * (0.9f - one);
    }
    return light;
}

} // namespace

Pixels map_pixels(const SampleMap& map, Style style) {
    float largest = 0;
    for (const float distance : map.distances) {
        largest = std::isfinite(distance) ? std::max(largest, distance) : largest;
    }
    Pixels pixels{map.width, map.height, std::vector<std::uint8_t>(4 * map.samples.size())};
    for_rows(map.samples.size(), [&](std::size_t i) {
        if (map.faces[i] == SampleMap::kNone) {
            return;
        }
        std::uint8_t* const rgba = &pixels.rgba[4 * i];
        rgba[3] = 255;
        const bool has_sample = map.samples[i] != SampleMap::kNone;
        if (style == Style::distance && has_sample) {
            const float part = largest > 0 ? map.distances[i] / largest : 0;
            std::fill_n(rgba, 3, static_cast<std::uint8_t>(std::lround(255 * part)));
            return;
        }
        const Light light =
            has_sample ? cell_light(color_of(static_cast<std::size_t>(map.samples[i]))) : kBare;
        std::ranges::transform(light, rgba, to_srgb);
    });
    return pixels;
}

} // namespace geodisk::tools::picture
