#include "picture/map_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "files/output/block_writer.hpp"
#include "picture/srgb.hpp"

namespace geodisk::tools::picture {
namespace {

using Light = std::array<float, 3>;

// As kBare in colors.glsl.
constexpr Light kBare{0.81f, 0.80f, 0.77f};

constexpr std::size_t kHues = 7, kTones = 4;

/// The hues of cell_color() in colors.glsl, in the tones there.
Light cell_light(std::uint32_t color) {
    constexpr Light kKinds[kHues] = {{0.79f, 0.34f, 0.0f},   {0.093f, 0.456f, 0.815f},
                                     {0.0f, 0.342f, 0.171f}, {0.871f, 0.776f, 0.054f},
                                     {0.0f, 0.168f, 0.445f}, {0.665f, 0.112f, 0.0f},
                                     {0.604f, 0.19f, 0.386f}};
    const float part = 0.35f + 0.11f * static_cast<float>(color / kHues % kTones);
    Light light = kKinds[color % kHues];
    for (float& one : light) {
        one += part * (0.9f - one);
    }
    return light;
}

/// Draws texels with a sample by `set(texel, rgba)`.
template <class Set>
Pixels draw(const SampleMap& map, const Set& set) {
    Pixels pixels{map.width, map.height, std::vector<std::uint8_t>(4 * map.samples.size())};
    for_rows(map.samples.size(), [&](std::size_t i) {
        if (std::isnan(map.distances[i])) {
            return;
        }
        std::uint8_t* const rgba = &pixels.rgba[4 * i];
        rgba[3] = 255;
        if (map.samples[i] == SampleMap::kNone) {
            std::ranges::transform(kBare, rgba, to_srgb);
        } else {
            set(i, rgba);
        }
    });
    return pixels;
}

float largest_distance(const SampleMap& map) {
    float largest = 0;
    for (const float distance : map.distances) {
        largest = std::isfinite(distance) ? std::max(largest, distance) : largest;
    }
    return largest;
}

/// Returns the grey of a distance: 0 at a sample, the maximum at the largest one and beyond.
template <class Level>
Level level(float distance, float largest) {
    const float part = distance > 0 ? std::min(distance / largest, 1.0f) : 0.0f;
    return static_cast<Level>(std::lround(part * float{std::numeric_limits<Level>::max()}));
}

} // namespace

Pixels cell_pixels(const SampleMap& map, std::span<const std::uint32_t> colors) {
    return draw(map, [&](std::size_t i, std::uint8_t* rgba) {
        const std::uint32_t color = colors[static_cast<std::size_t>(map.samples[i])];
        std::ranges::transform(cell_light(color), rgba, to_srgb);
    });
}

Pixels distance_pixels(const SampleMap& map) {
    const float largest = largest_distance(map);
    return draw(map, [&](std::size_t i, std::uint8_t* rgba) {
        std::fill_n(rgba, 3, level<std::uint8_t>(map.distances[i], largest));
    });
}

DeepPixels deep_distance_pixels(const SampleMap& map) {
    const float largest = largest_distance(map);
    DeepPixels pixels{map.width, map.height, std::vector<DeepPixels::Texel>(map.distances.size())};
    for_rows(map.distances.size(), [&](std::size_t i) {
        if (!std::isnan(map.distances[i])) {
            pixels.texels[i] = {level<std::uint16_t>(map.distances[i], largest), true};
        }
    });
    return pixels;
}

} // namespace geodisk::tools::picture
