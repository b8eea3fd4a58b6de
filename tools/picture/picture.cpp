#include "picture/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "picture/legend.hpp"
#include "picture/srgb.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/suggestion.hpp"

namespace geodisk::tools::picture {
namespace {

/// Along each side of a pixel, drawn one by one and averaged.
constexpr std::uint32_t kOversampling = 3;
constexpr std::uint32_t kTile = Renderer::kMaxPixels / kOversampling;
/// Pixels of each side of the drawings that views are judged by.
constexpr std::uint32_t kTrial = 96;
/// Points are no smaller than this, in pixels, if their disks are not.
constexpr double kPointRadius = 1.4;
constexpr double kPointPart = 0.3;
/// Disks of fewer pixels merge into a pattern, so that points show more.
constexpr double kLegibleRadius = 7;
/// Part that disks cover that are thrown until hardly one fits.
constexpr double kCoverage = 0.53;
/// The end of the scale of densities, in those of disks that few samples have smaller.
constexpr double kDensest = 1.5;
constexpr std::size_t kFew = 8; // One of so many.

using NamedStyle = std::pair<std::string_view, Style>;
constexpr NamedStyle kStyles[] = {{"auto", Style::automatic},    {"disks", Style::disks},
                                  {"points", Style::points},     {"voronoi", Style::voronoi},
                                  {"distance", Style::distance}, {"density", Style::density}};

/// Mean of a square of drawn pixels, in front of the background.
void average(std::span<const std::uint8_t> drawn, std::size_t width, std::size_t x, std::size_t y,
             const Background& background, std::uint8_t* to) {
    const std::array<float, 256>& light = light_of_srgb();
    float sum[3] = {0, 0, 0};
    std::uint32_t covered = 0;
    for (std::size_t row = 0; row < kOversampling; ++row) {
        const std::uint8_t* from =
            &drawn[4 * ((y * kOversampling + row) * width + x * kOversampling)];
        for (std::size_t column = 0; column < kOversampling; ++column, from += 4) {
            if (from[3] != 0) {
                ++covered;
                for (std::size_t k = 0; k < 3; ++k) {
                    sum[k] += light[from[k]];
                }
            }
        }
    }
    constexpr float kAll = kOversampling * kOversampling;
    const float part = static_cast<float>(covered) / kAll;
    const float behind = (1 - part) * static_cast<float>(background.alpha) / 255;
    const float alpha = part + behind;
    const std::uint8_t back[3] = {background.red, background.green, background.blue};
    for (std::size_t k = 0; k < 3; ++k) {
        const float mixed = sum[k] / kAll + behind * light[back[k]];
        to[k] = alpha > 0 ? to_srgb(mixed / alpha) : 0;
    }
    to[3] = static_cast<std::uint8_t>(std::lround(alpha * 255));
}

/// A part of the picture.
struct Pane {
    std::uint32_t x, y, width, height;
};

/// Side by side, as near to squares as it goes.
std::vector<Pane> lay_out(std::uint32_t width, std::uint32_t height, std::uint32_t count) {
    std::uint32_t best = 1;
    double best_size = 0;
    for (std::uint32_t columns = 1; columns <= count; ++columns) {
        const std::uint32_t rows = (count + columns - 1) / columns;
        const double size =
            std::min(static_cast<double>(width) / columns, static_cast<double>(height) / rows);
        if (size > best_size) {
            best = columns;
            best_size = size;
        }
    }
    const std::uint32_t rows = (count + best - 1) / best;
    std::vector<Pane> panes;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t column = i % best;
        const std::uint32_t row = i / best;
        const std::uint32_t x = column * width / best;
        const std::uint32_t y = row * height / rows;
        panes.push_back({x, y, (column + 1) * width / best - x, (row + 1) * height / rows - y});
    }
    return panes;
}

struct Trial {
    double seen = 0;    ///< Surface there is to see, in areas of the frame.
    double covered = 0; ///< Covered part of the frame.
};

Trial try_view(Renderer& renderer, const Scene& scene, View view, Up up) {
    const Camera camera = make_camera(scene, view, up, 1);
    const auto drawn = renderer.draw({kDrawArea}, camera, camera.to_clip, kTrial, kTrial);
    Trial trial;
    for (std::size_t at = 0; at < drawn.size(); at += 4) {
        if (drawn[at + 3] != 0) {
            trial.seen += static_cast<double>(light_of_srgb()[drawn[at]]) * kMaxTilt;
            trial.covered += 1;
        }
    }
    trial.seen /= kTrial * kTrial;
    trial.covered /= kTrial * kTrial;
    return trial;
}

/// The view in which most of the surface is seen, from where most things are looked at. What is
/// drawn fills its frame, so that what is seen counts as it is in the picture.
View choose_view(Renderer& renderer, const Scene& scene, Up up) {
    View best;
    double most = -1;
    for (const View view : views_to_try()) {
        const double seen = try_view(renderer, scene, view, up).seen;
        if (seen > most) {
            most = seen;
            best = view;
        }
    }
    return best;
}

std::uint32_t kind_of(Style style) {
    switch (style) {
    case Style::points:
        return kDrawPoints;
    case Style::voronoi:
        return kDrawVoronoi;
    case Style::distance:
        return kDrawDistance;
    case Style::density:
        return kDrawDensity;
    default:
        return kDrawDisks;
    }
}

/// Pixels that a disk is wide, halved, where `covered` of them show the surface: half the samples
/// are in sight.
double disk_radius(std::size_t samples, double covered) {
    const double disk = kCoverage * covered / (0.5 * static_cast<double>(samples));
    return std::sqrt(std::max(1.0, disk) / std::numbers::pi);
}

/// A few outliers would make the whole scale dark.
float small_radius(std::span<const SampleRec> samples) {
    std::vector<float> radii;
    for (const SampleRec& sample : samples) {
        radii.push_back(sample.radius);
    }
    const auto few = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / kFew);
    std::ranges::nth_element(radii, few);
    return *few;
}

/// `covered()` as above. Chooses a style where that is left open.
DrawKind kind_with_scale(Style& style, std::span<const SampleRec> samples,
                         const std::function<double()>& covered) {
    double radius = 0;
    if (style == Style::automatic || style == Style::points) {
        radius = disk_radius(samples.size(), covered());
    }
    if (style == Style::automatic) {
        style = radius < kLegibleRadius ? Style::points : Style::disks;
    }
    DrawKind what{kind_of(style)};
    if (style == Style::points) {
        what.high = static_cast<float>(std::clamp(kPointRadius / radius, kPointPart, 1.0));
    } else if (style == Style::density) {
        const float small = small_radius(samples);
        what.high = static_cast<float>(kDensest * kCoverage / std::numbers::pi) / (small * small);
    }
    return what;
}

void fill_background(const Background& color, Pixels& pixels) {
    const std::array<std::uint8_t, 4> one{color.red, color.green, color.blue, color.alpha};
    pixels.rgba.reserve(one.size() * pixels.width * pixels.height);
    for (std::size_t i = 0; i < std::size_t{pixels.width} * pixels.height; ++i) {
        pixels.rgba.insert(pixels.rgba.end(), one.begin(), one.end());
    }
}

LegendFacts legend_facts(const Content& content, Style style) {
    LegendFacts facts{content.samples.size() + content.balls.size(), content.ball_distance,
                      content.ball_distance, style, content.scene.scale > 0};
    if (!content.samples.empty()) {
        const auto [smallest, largest] =
            std::ranges::minmax(content.samples, {}, &SampleRec::radius);
        facts.smallest_distance = 2 * content.table.unit * static_cast<double>(smallest.radius);
        facts.largest_distance = 2 * content.table.unit * static_cast<double>(largest.radius);
    }
    for (const SampleRec& sample : content.samples) {
        if (sample.kind > 0) {
            facts.classes.resize(std::max<std::size_t>(facts.classes.size(), sample.kind));
            LegendClass& own = facts.classes[sample.kind - 1];
            ++own.samples;
            own.min_distance = 2 * content.table.unit * static_cast<double>(sample.radius);
        }
    }
    return facts;
}

/// Places of each view, and of the legend below it if there are any.
struct Layout {
    std::vector<Pane> panes;
    std::vector<Legend> legends;
};

Layout lay_out(const Content& content, const PictureParams& params) {
    Layout layout{
        lay_out(params.width, params.height, static_cast<std::uint32_t>(params.views.size())), {}};
    if (params.legend) {
        const LegendFacts facts = legend_facts(content, params.style);
        for (Pane& pane : layout.panes) {
            layout.legends.emplace_back(facts, pane.width, pane.height);
            pane.height -= layout.legends.back().height();
        }
    }
    return layout;
}

Legend::Scale legend_scale(const Content& content, const Camera& camera, const DrawKind& what,
                           const Pane& pane) {
    const glm::vec4 middle = camera.to_clip[3];
    const glm::vec3 right(camera.to_clip[0].x, camera.to_clip[1].x, camera.to_clip[2].x);
    const double in_scene = static_cast<double>(glm::length(right) / middle.w) * pane.width / 2;
    return {in_scene * content.scene.scale,
            static_cast<double>(what.high) / (content.table.unit * content.table.unit)};
}

/// Draws a view into its pane, part by part.
void draw_pane(Renderer& renderer, const Camera& camera, const DrawKind& what, const Pane& pane,
               const Background& background, Pixels& pixels, const std::function<void()>& tell) {
    for (std::uint32_t y = 0; y < pane.height; y += kTile) {
        for (std::uint32_t x = 0; x < pane.width; x += kTile) {
            const std::uint32_t width = std::min(kTile, pane.width - x);
            const std::uint32_t height = std::min(kTile, pane.height - y);
            const auto part = [](std::uint32_t a, std::uint32_t b) {
                return static_cast<double>(a) / b;
            };
            const glm::mat4 to_clip =
                crop(camera.to_clip, part(x, pane.width), part(y, pane.height),
                     part(width, pane.width), part(height, pane.height));
            const auto drawn =
                renderer.draw(what, camera, to_clip, width * kOversampling, height * kOversampling);
            for (std::uint32_t row = 0; row < height; ++row) {
                std::uint8_t* to =
                    &pixels.rgba[4 * ((std::size_t{pane.y} + y + row) * pixels.width + pane.x + x)];
                for (std::uint32_t column = 0; column < width; ++column, to += 4) {
                    average(drawn, std::size_t{width} * kOversampling, column, row, background, to);
                }
            }
            tell();
        }
    }
}

} // namespace

const char* to_string(Style style) {
    return std::ranges::find(kStyles, style, &NamedStyle::second)->first.data();
}

Style parse_style(const std::string& option, const std::string& text) {
    const auto* const found = std::ranges::find(kStyles, text, &NamedStyle::first);
    if (found == std::ranges::end(kStyles)) {
        std::vector<std::string> known;
        for (const auto& [name, style] : kStyles) {
            known.emplace_back(name);
        }
        fail_choice(option, text, known);
    }
    return found->second;
}

double reach_of(Style style) {
    switch (style) {
    case Style::voronoi:
    case Style::distance:
        return 3;
    case Style::density:
        return 5;
    default:
        return 1;
    }
}

Background parse_background(const std::string& option, const std::string& text) {
    if (text == "white") {
        return {};
    }
    if (text == "black") {
        return {0, 0, 0, 255};
    }
    if (text == "transparent") {
        return {0, 0, 0, 0};
    }
    const auto digit = [](char c) {
        return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
    };
    std::uint8_t bytes[3] = {};
    bool is_color = text.size() == 6;
    for (std::size_t i = 0; is_color && i < 6; ++i) {
        const int value =
            digit(text[i] >= 'A' && text[i] <= 'F' ? static_cast<char>(text[i] + 32) : text[i]);
        is_color = value >= 0;
        bytes[i / 2] = static_cast<std::uint8_t>(bytes[i / 2] * 16 + std::max(0, value));
    }
    if (!is_color) {
        fail_usage(option + " takes white, black, transparent or a colour RRGGBB, not " +
                   in_quotes(text));
    }
    return {bytes[0], bytes[1], bytes[2], 255};
}

Picture draw_picture(const Gpu& gpu, const Content& content, const PictureParams& params,
                     const PartDone& tell) {
    const Scene& scene = content.scene;
    Picture picture;
    picture.pixels = {params.width, params.height, {}};
    picture.up = params.up.value_or(likely_up(scene));
    const auto [panes, legends] = lay_out(content, params);
    fill_background(params.background, picture.pixels);
    Renderer renderer(gpu, content);

    const auto tiles = [](std::uint32_t pixels) { return (pixels + kTile - 1) / kTile; };
    std::uint32_t all = 0;
    for (const Pane& pane : panes) {
        all += tiles(pane.width) * tiles(pane.height);
    }
    std::uint32_t done = 0;
    const auto tell_tile = [&] {
        ++done;
        if (tell) {
            tell(static_cast<double>(done) / all);
        }
    };
    std::optional<View> chosen;
    for (std::size_t i = 0; i < panes.size(); ++i) {
        if (!params.views[i] && !chosen) {
            chosen = choose_view(renderer, scene, picture.up);
        }
        const View view = params.views[i].value_or(chosen.value_or(View{}));
        picture.views.push_back(view);
        const Pane& pane = panes[i];
        const double aspect = static_cast<double>(pane.width) / pane.height;
        const Camera camera = make_camera(scene, view, picture.up, aspect);
        const auto covered = [&] {
            const double side = std::min(pane.width, pane.height);
            return try_view(renderer, scene, view, picture.up).covered * side * side;
        };
        Style style = params.style;
        const DrawKind what =
            content.largest_value > 0 ? DrawKind{kDrawValues, content.largest_value}
            : content.balls.empty()   ? kind_with_scale(style, content.samples, covered)
                                      : DrawKind{kDrawFrame, 1, params.cuts};
        picture.style = i == 0 ? style : picture.style;
        draw_pane(renderer, camera, what, pane, params.background, picture.pixels, tell_tile);
        if (params.legend) {
            legends[i].draw(picture.pixels, params.background, pane.x, pane.y + pane.height,
                            legend_scale(content, camera, what, pane));
        }
    }
    return picture;
}

} // namespace geodisk::tools::picture
