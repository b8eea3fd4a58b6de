#include "picture/lettering.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wcast-qual"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace geodisk::tools::picture {
namespace {

/// font/sans.ttf.
constexpr std::uint8_t kFontFile[] = {
#include "font_bytes.inc"
};

const stbtt_fontinfo& font() {
    static const stbtt_fontinfo kFont = [] {
        stbtt_fontinfo info{};
        stbtt_InitFont(&info, kFontFile, 0);
        return info;
    }();
    return kFont;
}

float scale_of(double size) {
    return stbtt_ScaleForMappingEmToPixels(&font(), static_cast<float>(size));
}

int code_of(char letter) {
    return static_cast<unsigned char>(letter);
}

double advance(char letter, double size) {
    int width = 0, left = 0;
    stbtt_GetCodepointHMetrics(&font(), code_of(letter), &width, &left);
    return static_cast<double>(width) * static_cast<double>(scale_of(size));
}

struct Extents {
    int ascent = 0, descent = 0, gap = 0;
};

Extents extents() {
    Extents found;
    stbtt_GetFontVMetrics(&font(), &found.ascent, &found.descent, &found.gap);
    return found;
}

/// Lays a colour over a pixel, if there is one there; `part` from 0 to 1 of it.
void cover(Pixels& pixels, std::int64_t x, std::int64_t y, glm::vec3 color, float part) {
    if (x < 0 || y < 0 || x >= pixels.width || y >= pixels.height || part <= 0) {
        return;
    }
    std::uint8_t* const to =
        &pixels
             .rgba[4 * (static_cast<std::size_t>(y) * pixels.width + static_cast<std::size_t>(x))];
    const float behind = (1 - part) * static_cast<float>(to[3]) / 255;
    const float alpha = part + behind;
    for (int k = 0; k < 3; ++k) {
        const float mixed = part * 255 * color[k] + behind * static_cast<float>(to[k]);
        to[k] = static_cast<std::uint8_t>(std::lround(mixed / alpha));
    }
    to[3] = static_cast<std::uint8_t>(std::lround(255 * alpha));
}

} // namespace

double text_width(std::string_view text, double size) {
    double width = 0;
    for (const char letter : text) {
        width += advance(letter, size);
    }
    return width;
}

double ascent(double size) {
    return extents().ascent * static_cast<double>(scale_of(size));
}

double descent(double size) {
    return -extents().descent * static_cast<double>(scale_of(size));
}

void draw_text(Pixels& pixels, double x, double y, std::string_view text, double size,
               glm::vec3 color) {
    const float scale = scale_of(size);
    const double line = std::round(y);
    std::vector<std::uint8_t> glyph;
    for (const char letter : text) {
        const double whole = std::floor(x);
        const auto shift = static_cast<float>(x - whole);
        int left = 0, top = 0, right = 0, bottom = 0;
        stbtt_GetCodepointBitmapBoxSubpixel(&font(), code_of(letter), scale, scale, shift, 0, &left,
                                            &top, &right, &bottom);
        const int width = right - left, height = bottom - top;
        if (width > 0 && height > 0) {
            glyph.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
            stbtt_MakeCodepointBitmapSubpixel(&font(), glyph.data(), width, height, width, scale,
                                              scale, shift, 0, code_of(letter));
            for (std::size_t i = 0; i < glyph.size(); ++i) {
                const auto column = static_cast<std::int64_t>(i) % width;
                const auto row = static_cast<std::int64_t>(i) / width;
                cover(pixels, static_cast<std::int64_t>(whole) + left + column,
                      static_cast<std::int64_t>(line) + top + row, color,
                      static_cast<float>(glyph[i]) / 255);
            }
        }
        x += advance(letter, size);
    }
}

void fill(Pixels& pixels, double left, double top, double right, double bottom, glm::vec3 color) {
    const auto covered = [](std::int64_t at, double from, double to) {
        const auto start = static_cast<double>(at);
        return std::clamp(std::min(start + 1, to) - std::max(start, from), 0.0, 1.0);
    };
    for (auto y = static_cast<std::int64_t>(std::floor(top)); static_cast<double>(y) < bottom;
         ++y) {
        for (auto x = static_cast<std::int64_t>(std::floor(left)); static_cast<double>(x) < right;
             ++x) {
            cover(pixels, x, y, color,
                  static_cast<float>(covered(x, left, right) * covered(y, top, bottom)));
        }
    }
}

} // namespace geodisk::tools::picture
