#include "picture/legend.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include <glm/common.hpp>

#include "picture/lettering.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools::picture {
namespace {

using glm::vec3;

/// Pixels of an em in a picture of 1920 x 1080, and the fewest that can be read.
constexpr double kEm = 24, kSmallestEm = 11;
constexpr double kUsualSide = 1440;
/// Maximum height of the strip, and that of one without words, as parts of the picture's height.
constexpr double kMaxHeight = 0.25, kMaxShortHeight = 0.5;
/// All in ems.
constexpr double kLegendMargin = 1, kGap = 2, kAbove = 0.2, kBarHeight = 0.7, kBelowBar = 0.15;
constexpr double kRow = 2.8, kTextRow = 1.6; // Of rows with bars, and with text alone.
constexpr double kLineHeight = 0.14;
/// End of the scale of distances, and start of that of places with room for a sample, in radii.
constexpr double kEndOfDistances = 2.5, kRoomFor = 2;
/// As kOverlap in colors.glsl.
constexpr vec3 kRoomColor{0.835, 0.369, 0};

/// A value as short as it can be read.
std::string short_number(double value) {
    const bool is_whole = value == std::floor(value) && value >= 1000 && value < 1e7;
    return is_whole ? grouped(static_cast<std::uint64_t>(value)) : rounded(value, 4);
}

std::string distance_text(const LegendFacts& facts, bool is_short) {
    const std::string low = rounded(facts.smallest_distance, 4);
    const std::string high = rounded(facts.largest_distance, 4);
    return (is_short ? "D = " : "minimum distance D = ") +
           (low == high ? low : low + " to " + high);
}

std::string class_text(const LegendClass& one, std::size_t number, bool is_short) {
    const std::string distance = "D = " + rounded(one.min_distance, 4);
    return is_short ? std::to_string(number) + ": " + distance
                    : "class " + std::to_string(number) + ": " +
                          counted(one.samples, "sample", "samples") + ", " + distance;
}

/// Returns true if the samples of a class have its colour.
bool shows_classes(Style style) {
    return style != Style::distance && style != Style::density;
}

std::string length_text(double length, bool is_short) {
    const std::string number = short_number(length);
    return is_short ? number : number + (length == 1 ? " unit" : " units");
}

/// Text that stands out from the background; from one that is not known yet, on white and black.
vec3 ink_on(const Background& background) {
    if (background.alpha == 0) {
        return vec3(0.463f);
    }
    const int light = 2 * background.red + 5 * background.green + background.blue;
    return light > 8 * 127 ? vec3(0.12f) : vec3(0.92f);
}

/// A value below a bar, and where on it, from 0 to 1.
using Tick = std::pair<double, std::string>;

std::vector<Tick> density_ticks(double densest) {
    // Colours are by the root of the density.
    const double high = round_below(densest);
    const double at = std::sqrt(high / densest);
    return {{0, "0"}, {at, short_number(high)}, {at / 2, short_number(high / 4)}};
}

} // namespace

double round_below(double limit) {
    const double power = std::pow(10, std::floor(std::log10(limit)));
    for (const double step : {10.0, 5.0, 2.0}) {
        if (step * power <= limit * (1 + 1e-9)) {
            return step * power;
        }
    }
    return power;
}

vec3 class_color(std::size_t number) {
    constexpr vec3 kColors[] = {
#include "class_colors.h"
    };
    return kColors[number % std::size(kColors)];
}

vec3 scale_color(double part) {
    constexpr vec3 kKnots[] = {
#include "scale_knots.h"
    };
    constexpr double kSteps = std::size(kKnots) - 1;
    const double at = std::clamp(part, 0.0, 1.0) * kSteps;
    const double knot = std::min(std::floor(at), kSteps - 1);
    const auto i = static_cast<std::size_t>(knot);
    return glm::mix(kKnots[i], kKnots[i + 1], static_cast<float>(at - knot));
}

/// Strip that a legend is drawn in.
struct Legend::Strip {
    Pixels& pixels;
    double left, top;
    vec3 ink;
    double em;

    double bar_top(const Item& item) const { return top + item.y; }
    /// Centred about x, below a bar, but not left of `least`.
    void label(const Item& item, double x, const std::string& text, double least) const {
        const double y = bar_top(item) + (kBarHeight + kBelowBar) * em + ascent(em);
        draw_text(pixels, std::max(least, x - text_width(text, em) / 2), y, text, em, ink);
    }
};

Legend::Legend(const LegendFacts& facts, std::uint32_t width, std::uint32_t height) {
    const double side = std::sqrt(static_cast<double>(width) * height);
    const double em = std::max(kSmallestEm, kEm * side / kUsualSide);
    if (!lay_out(facts, em, false, width, kMaxHeight * height) &&
        !lay_out(facts, em, true, width, kMaxHeight * height) &&
        !lay_out(facts, kSmallestEm, true, width, kMaxShortHeight * height)) {
        fail_usage("--legend does not fit into a view of " + std::to_string(width) + " x " +
                   std::to_string(height) + " pixels; raise --size or leave out --legend");
    }
}

double Legend::bar_width(Kind kind) const {
    if (kind == Kind::class_entry) {
        return kBarHeight * em_;
    }
    return (kind == Kind::length ? (is_short_ ? 4 : 9) : is_short_ ? 6 : 14) * em_;
}

bool Legend::lay_out(const LegendFacts& facts, double em, bool is_short, std::uint32_t width,
                     double most) {
    em_ = em;
    is_short_ = is_short;
    items_.clear();
    const auto add = [&](Kind kind, std::string text) {
        const double words = text_width(text, em);
        const double bar = kind == Kind::text ? 0 : bar_width(kind);
        const double space = bar == 0 || words == 0 ? 0 : kind == Kind::class_entry ? em / 2 : em;
        items_.push_back({kind, std::move(text), bar + space + words});
    };
    add(Kind::text, counted(facts.samples, "sample", "samples"));
    for (std::size_t number = 0; number < facts.classes.size(); ++number) {
        add(shows_classes(facts.style) ? Kind::class_entry : Kind::text,
            class_text(facts.classes[number], number, is_short));
        items_.back().number = number;
    }
    if (facts.classes.empty()) {
        add(Kind::text, distance_text(facts, is_short));
    }
    if (facts.has_lengths) {
        add(Kind::length, "");
    }
    if (facts.style == Style::distance) {
        add(Kind::distance, is_short                ? ""
                            : facts.classes.empty() ? "to the nearest sample; orange: room for one"
                                                    : "to the nearest sample, D of its class");
    } else if (facts.style == Style::density) {
        add(Kind::density, is_short ? "" : "samples per unit of area");
    }
    const double margin = kLegendMargin * em, right = width - margin;
    double y = kAbove * em;
    bool fits = true;
    for (auto first = items_.begin(); first != items_.end();) {
        double x = margin;
        auto end = first;
        bool has_bar = false;
        do {
            end->x = x;
            x += end->width;
            fits = fits && x <= right;
            x += kGap * em;
            has_bar = has_bar || end->kind != Kind::text;
            ++end;
        } while (end != items_.end() && x + end->width <= right);
        for (; first != end; ++first) {
            first->y = has_bar ? y : y - (kBarHeight + kBelowBar) * em;
        }
        y += (has_bar ? kRow : kTextRow) * em;
    }
    height_ = static_cast<std::uint32_t>(std::ceil(y));
    return fits && y <= most;
}

void Legend::draw_class(Strip& strip, const Item& item) const {
    const double left = std::round(strip.left + item.x), size = std::round(bar_width(item.kind));
    // The square stands on the line of the text.
    const double line = strip.bar_top(item) + (kBarHeight + kBelowBar) * em_ + ascent(em_);
    fill(strip.pixels, left, std::round(line - size), left + size, std::round(line),
         class_color(item.number));
    draw_text(strip.pixels, left + size + em_ / 2, line, item.text, em_, strip.ink);
}

void Legend::draw_length(Strip& strip, const Item& item, double pixels_per_unit) const {
    const double length = round_below(bar_width(Kind::length) / pixels_per_unit);
    const double left = strip.left + item.x, right = left + length * pixels_per_unit;
    const double top = strip.bar_top(item), bottom = top + kBarHeight * em_;
    const double line = std::max(1.0, std::round(kLineHeight * em_));
    const double middle = std::round((top + bottom - line) / 2);
    fill(strip.pixels, left, middle, right, middle + line, strip.ink);
    fill(strip.pixels, left, top, left + line, bottom, strip.ink);
    fill(strip.pixels, right - line, top, right, bottom, strip.ink);
    strip.label(item, (left + right) / 2, length_text(length, is_short_), left);
}

void Legend::draw_colors(Strip& strip, const Item& item, double densest) const {
    const bool is_density = item.kind == Kind::density;
    const double width = bar_width(item.kind);
    const double left = std::round(strip.left + item.x), top = strip.bar_top(item);
    const double bottom = top + kBarHeight * em_;
    for (double at = 0; at < width; ++at) {
        const double part = (at + 0.5) / width, radii = part * kEndOfDistances;
        const vec3 color = is_density          ? scale_color(part)
                           : radii >= kRoomFor ? kRoomColor
                                               : scale_color(1 - radii / kRoomFor);
        fill(strip.pixels, left + at, top, left + std::min(at + 1, width), bottom, color);
    }
    const std::vector<Tick> ticks =
        is_density ? density_ticks(densest)
                   : std::vector<Tick>{
                         {0, "0"}, {1 / kEndOfDistances, "D/2"}, {kRoomFor / kEndOfDistances, "D"}};
    std::vector<std::pair<double, double>> taken; // Labels that would overlap others are left out.
    for (const auto& [part, text] : ticks) {
        const double x = left + part * width, half = text_width(text, em_) / 2 + em_ / 4;
        if (std::ranges::all_of(taken, [&](const auto& other) {
                return x + half < other.first || x - half > other.second;
            })) {
            fill(strip.pixels, x, bottom, x + std::max(1.0, em_ / 16), bottom + em_ / 5, strip.ink);
            strip.label(item, x, text, strip.left);
            taken.emplace_back(x - half, x + half);
        }
    }
    draw_text(strip.pixels, left + width + em_, bottom, item.text, em_, strip.ink);
}

void Legend::draw(Pixels& pixels, const Background& background, std::uint32_t x, std::uint32_t y,
                  const Scale& scale) const {
    Strip strip{pixels, static_cast<double>(x), static_cast<double>(y), ink_on(background), em_};
    for (const Item& item : items_) {
        switch (item.kind) {
        case Kind::text:
            strip.label(item, 0, item.text, strip.left + item.x);
            break;
        case Kind::class_entry:
            draw_class(strip, item);
            break;
        case Kind::length:
            draw_length(strip, item, scale.pixels_per_unit);
            break;
        default:
            draw_colors(strip, item, scale.densest);
        }
    }
}

} // namespace geodisk::tools::picture
