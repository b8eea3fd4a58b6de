// The legend of a picture: what it tells fits below the view, and its bars are as long as they say.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "picture/legend.hpp"
#include "picture/lettering.hpp"
#include "unit/test_files.hpp"

namespace geodisk::tools {
namespace {

using picture::Background;
using picture::Legend;
using picture::LegendFacts;
using picture::Pixels;
using picture::Style;

constexpr Background kWhite{};

Pixels blank(std::uint32_t width, std::uint32_t height) {
    return {width, height, std::vector<std::uint8_t>(std::size_t{4} * width * height, 255)};
}

bool is_marked(const Pixels& pixels, std::size_t x, std::size_t y) {
    const std::uint8_t* const at = &pixels.rgba[4 * (y * pixels.width + x)];
    return at[0] != 255 || at[1] != 255 || at[2] != 255;
}

/// Longest run of dark pixels in any row.
std::uint32_t longest_line(const Pixels& pixels) {
    std::uint32_t longest = 0;
    for (std::uint32_t y = 0; y < pixels.height; ++y) {
        std::uint32_t run = 0;
        for (std::uint32_t x = 0; x < pixels.width; ++x) {
            const bool is_dark = pixels.rgba[4 * (std::size_t{y} * pixels.width + x)] < 60;
            run = is_dark ? run + 1 : 0;
            longest = std::max(longest, run);
        }
    }
    return longest;
}

} // namespace

TEST_CASE("lengths of scale bars are 1, 2 or 5 times a power of ten") {
    CHECK(picture::round_below(1) == 1);
    CHECK(picture::round_below(0.99) == doctest::Approx(0.5));
    CHECK(picture::round_below(4999) == 2000);
    CHECK(picture::round_below(0.0020001) == doctest::Approx(0.002));
    CHECK(picture::round_below(1e-30) == doctest::Approx(1e-30));
    CHECK(picture::round_below(7e20) == doctest::Approx(5e20));
}

TEST_CASE("the lightness of the scale grows evenly") {
    const auto lightness = [](double part) { // L* of CIELAB.
        const glm::vec3 color = picture::scale_color(part);
        const auto linear = [](float c) {
            return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
        };
        const float luminance =
            0.2126f * linear(color.r) + 0.7152f * linear(color.g) + 0.0722f * linear(color.b);
        return 116 * std::cbrt(static_cast<double>(luminance)) - 16;
    };
    const double low = lightness(0), high = lightness(1);
    CHECK(low < 20);
    CHECK(high > 85);
    for (int i = 1; i < 20; ++i) {
        const double part = i / 20.0;
        CAPTURE(part);
        CHECK(std::abs(lightness(part) - (low + part * (high - low))) < 4);
    }
}

TEST_CASE("text is drawn within its width, and within the picture") {
    Pixels pixels = blank(200, 40);
    const double width = picture::text_width("D = 0.0123", 20);
    CHECK(width > 80);
    CHECK(width < 140);
    picture::draw_text(pixels, 10, 28, "D = 0.0123", 20, glm::vec3(0));
    std::uint32_t left = 200, right = 0, marked = 0;
    for (std::uint32_t y = 0; y < 40; ++y) {
        for (std::uint32_t x = 0; x < 200; ++x) {
            if (is_marked(pixels, x, y)) {
                left = std::min(left, x);
                right = std::max(right, x);
                ++marked;
            }
        }
    }
    CHECK(left >= 10);
    CHECK(right <= 11 + width);
    CHECK(marked > 300);
    // Beyond the edges, and letters that the font has not.
    picture::draw_text(pixels, -30, 4, "D = \xc3\xa4\x01 longer than the picture is wide", 20,
                       glm::vec3(0));
}

TEST_CASE("a legend stays in its strip, and its bar is as long as its scale says") {
    for (const Style style : {Style::disks, Style::distance, Style::density}) {
        CAPTURE(picture::to_string(style));
        const Legend legend({12345, 0.01, 0.01, style, true}, 1920, 1080);
        CHECK(legend.height() < 100);
        Pixels pixels = blank(1920, 300);
        legend.draw(pixels, kWhite, 0, 200, {.pixels_per_unit = 900, .densest = 1234});
        bool is_above = false, is_within = false;
        for (std::uint32_t y = 0; y < 300; ++y) {
            for (std::uint32_t x = 0; x < 1920; ++x) {
                const bool is_strip = y >= 200 && y < 200 + legend.height();
                is_within = is_within || (is_strip && is_marked(pixels, x, y));
                is_above = is_above || (!is_strip && is_marked(pixels, x, y));
            }
        }
        CHECK(is_within);
        CHECK_FALSE(is_above);
        if (style == Style::disks) {
            // At most nine letters of 24 pixels: 0.2 units of 900.
            CHECK(longest_line(pixels) == doctest::Approx(180).epsilon(0.02));
        }
    }
}

TEST_CASE("a small view has a short legend, a tiny one an error") {
    const LegendFacts facts{400, 0.01, 0.2, Style::density, true};
    for (const auto& [width, height] : {std::pair(1920u, 1080u), std::pair(640u, 480u),
                                        std::pair(320u, 240u), std::pair(160u, 160u)}) {
        const std::uint32_t shown = width; // Before Clang 16 lambdas capture no bindings.
        CAPTURE(shown);
        const Legend legend(facts, width, height);
        CHECK(legend.height() <= height / 2);
    }
    const auto error = error_of([&] { const Legend legend(facts, 60, 60); });
    REQUIRE(error);
    CHECK(error->code() == ExitCode::usage);
    CHECK(contains(error->what(), "60 x 60 pixels"));
}

TEST_CASE("a legend without a scale has no bar") {
    Pixels pixels = blank(900, 100);
    Legend({7, 0.5, 0.5, Style::disks, false}, 900, 600).draw(pixels, kWhite, 0, 0, {});
    CHECK(longest_line(pixels) < 20);
}

TEST_CASE("a legend has an entry in its colour for each class") {
    for (const auto& [width, height] : {std::pair(1920u, 1080u), std::pair(320u, 240u)}) {
        LegendFacts facts{700, 0.01, 0.06, Style::disks, true};
        facts.classes = {{100, 0.06}, {200, 0.04}, {400, 0.01}};
        Pixels pixels = blank(width, height);
        Legend(facts, width, height).draw(pixels, kWhite, 0, 0, {.pixels_per_unit = 900});
        const auto pixels_of = [&](std::size_t number) {
            const glm::vec3 color = picture::class_color(number);
            std::size_t count = 0;
            for (std::size_t at = 0; at < pixels.rgba.size(); at += 4) {
                bool is_same = true;
                for (int k = 0; k < 3; ++k) {
                    const float own = pixels.rgba[at + static_cast<std::size_t>(k)];
                    is_same = is_same && std::abs(own - 255 * color[k]) < 1.5f;
                }
                count += is_same;
            }
            return count;
        };
        for (std::size_t number = 0; number < 3; ++number) {
            CHECK(pixels_of(number) > 20);
        }
        CHECK(pixels_of(3) == 0);
    }
}

} // namespace geodisk::tools
