#include "bench/log_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>

#include "program/human_text.hpp"

namespace geodisk::bench {
namespace {

// In pixels, of which there are kWidth times some height; the legend is below the plot.
constexpr double kWidth = 760;
constexpr double kPlotHeight = 380;
constexpr double kLeft = 84;
constexpr double kRight = 24;
constexpr double kTop = 48;
constexpr double kBelow = 62; ///< Ticks and label of the x axis.
constexpr double kLegendRow = 20;
constexpr double kLegendColumn = 330;

/// Both hues of a pair are of like contrast to their background; neighbours differ for the colour
/// blind as well (after Okabe and Ito 2008).
constexpr std::array<std::pair<const char*, const char*>, 6> kColours{{{"#0068a8", "#5cb3f0"},
                                                                       {"#c24a00", "#f5945c"},
                                                                       {"#007a58", "#35c79c"},
                                                                       {"#a8407c", "#e79cc8"},
                                                                       {"#7a6400", "#d9bf45"},
                                                                       {"#5a5f66", "#b4bac2"}}};

std::string number(double value) {
    return tools::fixed(value, 1);
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char character : text) {
        switch (character) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        default:
            // Control characters are not allowed in XML at all.
            result += static_cast<unsigned char>(character) < 0x20 ? '?' : character;
        }
    }
    return result;
}

bool is_drawable(const Point& point, bool is_linear_y) {
    return point.x > 0 && (point.y > 0 || (is_linear_y && point.y == 0)) &&
           std::isfinite(point.x) && std::isfinite(point.y);
}

/// An axis from `low` to `high`, at pixels `start` to `end`.
struct Axis {
    double low, high;
    double start, end;
    std::vector<double> ticks;
    double step = 0; ///< From tick to tick of a linear axis; 0 where it is logarithmic.

    double place(double value) const {
        const double part =
            step > 0 ? (value - low) / (high - low) : std::log(value / low) / std::log(high / low);
        return start + (end - start) * part;
    }
    std::string text(double tick, const std::string& unit) const {
        return step > 0 ? linear_tick_text(tick, step, unit) : tick_text(tick, unit);
    }
};

/// The least of 1, 2, 5 times a power of ten that is not below `value`, or with `up` unset the
/// greatest that is not above it.
double round_to_step(double value, bool up) {
    constexpr double kSame = 1e-9; // Powers of ten are not exact.
    const double decade = std::pow(10, std::floor(std::log10(value) + kSame));
    constexpr double kSteps[] = {1, 2, 5, 10};
    double best = kSteps[0];
    for (const double step : kSteps) {
        if (up ? step * decade >= value * (1 - kSame) : step * decade <= value * (1 + kSame)) {
            best = step;
            if (up) {
                break;
            }
        }
    }
    return best * decade;
}

Axis make_linear_axis(double least, double most, double start, double end) {
    constexpr double kTicks = 6;
    const double extent = most > least ? most - least : most > 0 ? 0.2 * most : 1;
    const double step = round_to_step(extent / kTicks, true);
    Axis axis{step * std::floor(least / step), step * std::ceil(most / step), start, end, {}, step};
    if (!(axis.low < axis.high)) {
        axis.high += step;
    }
    const double count = std::round((axis.high - axis.low) / step);
    for (double i = 0; i <= count; ++i) {
        axis.ticks.push_back(axis.low + i * step);
    }
    return axis;
}

Axis make_log_axis(double least, double most, double start, double end) {
    Axis axis{round_to_step(least, false), round_to_step(most, true), start, end, {}, 0};
    if (!(axis.low < axis.high)) {
        axis.low /= 10;
        axis.high *= 10;
    }
    // Three ticks a decade where there is room for them, else one.
    const bool is_dense = std::log10(axis.high / axis.low) < 3.5;
    for (double decade = std::pow(10, std::floor(std::log10(axis.low))); decade <= axis.high * 1.01;
         decade *= 10) {
        for (const double step : {1.0, 2.0, 5.0}) {
            const double tick = step * decade;
            if ((step == 1 || is_dense) && tick >= axis.low * 0.99 && tick <= axis.high * 1.01) {
                axis.ticks.push_back(tick);
            }
        }
    }
    return axis;
}

class Drawing {
  public:
    explicit Drawing(const LogPlot& plot) : plot_(plot) {
        double low_x = std::numeric_limits<double>::infinity();
        double high_x = 0;
        double low_y = low_x;
        double high_y = 0;
        for (const LogPlot::Line& line : plot.lines) {
            for (const Point& point : line.points) {
                if (is_drawable(point, plot.is_linear_y)) {
                    low_x = std::min(low_x, point.x);
                    high_x = std::max(high_x, point.x);
                    low_y = std::min(low_y, point.y);
                    high_y = std::max(high_y, point.y);
                }
            }
        }
        if (high_x == 0) { // Nothing to draw: axes alone.
            low_x = low_y = 1;
            high_x = high_y = 10;
        }
        x_ = make_log_axis(low_x, high_x, kLeft, kWidth - kRight);
        y_ = (plot.is_linear_y ? make_linear_axis : make_log_axis)(low_y, high_y,
                                                                   kTop + kPlotHeight, kTop);
    }

    std::string run() && {
        begin();
        draw_axes();
        for (std::size_t i = 0; i < plot_.lines.size(); ++i) {
            draw_line(plot_.lines[i]);
            draw_legend(plot_.lines[i], i);
        }
        return std::move(svg_) + "</svg>\n";
    }

  private:
    void begin() {
        const auto rows = static_cast<double>((plot_.lines.size() + 1) / 2);
        const std::string height = number(kTop + kPlotHeight + kBelow + rows * kLegendRow + 12);
        svg_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(kWidth) +
               "\" height=\"" + height + "\" viewBox=\"0 0 " + number(kWidth) + ' ' + height +
               "\" role=\"img\">\n<title>" + escaped(plot_.title) + "</title>\n<style>\n" +
               "text { font: 13px sans-serif; fill: #1f2328 }\n"
               ".title { font-size: 15px; font-weight: bold }\n"
               ".paper { fill: #ffffff }\n.grid { stroke: #d8dde3 }\n"
               ".frame { stroke: #6a737d; fill: none }\n" +
               colour_rules(false) +
               "@media (prefers-color-scheme: dark) {\ntext { fill: #e6edf3 }\n"
               ".paper { fill: #0d1117 }\n.grid { stroke: #30363d }\n.frame { stroke: #8b949e }\n" +
               colour_rules(true) + "}\n</style>\n" +
               "<rect class=\"paper\" width=\"100%\" height=\"100%\"/>\n";
    }

    static std::string colour_rules(bool is_dark) {
        std::string rules;
        for (std::size_t i = 0; i < kColours.size(); ++i) {
            const char* const colour = is_dark ? kColours[i].second : kColours[i].first;
            rules +=
                ".c" + std::to_string(i) + " { stroke: " + colour + "; fill: " + colour + " }\n";
        }
        rules += is_dark ? ".hollow { fill: #0d1117 }\n" : ".hollow { fill: #ffffff }\n";
        return rules;
    }

    void add_text(double x, double y, const char* attributes, const std::string& text) {
        svg_ += "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" " + attributes + ">" +
                escaped(text) + "</text>\n";
    }

    void add_rule(double x1, double y1, double x2, double y2) {
        svg_ += "<line class=\"grid\" x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" +
                number(x2) + "\" y2=\"" + number(y2) + "\"/>\n";
    }

    void draw_axes() {
        const double bottom = kTop + kPlotHeight;
        for (const double tick : x_.ticks) {
            add_rule(x_.place(tick), kTop, x_.place(tick), bottom);
            add_text(x_.place(tick), bottom + 20, "text-anchor=\"middle\"",
                     x_.text(tick, plot_.x_unit));
        }
        for (const double tick : y_.ticks) {
            add_rule(kLeft, y_.place(tick), kWidth - kRight, y_.place(tick));
            add_text(kLeft - 8, y_.place(tick) + 4, "text-anchor=\"end\"",
                     y_.text(tick, plot_.y_unit));
        }
        svg_ += "<rect class=\"frame\" x=\"" + number(kLeft) + "\" y=\"" + number(kTop) +
                "\" width=\"" + number(kWidth - kLeft - kRight) + "\" height=\"" +
                number(kPlotHeight) + "\"/>\n";
        add_text(kLeft, 26, "class=\"title\"", plot_.title);
        add_text((kLeft + kWidth - kRight) / 2, bottom + 44, "text-anchor=\"middle\"",
                 plot_.x_label);
        const std::string middle = number(kTop + kPlotHeight / 2);
        svg_ += "<text transform=\"translate(20 " + middle +
                ") rotate(-90)\" text-anchor=\"middle\">" + escaped(plot_.y_label) + "</text>\n";
    }

    static std::string colour_class(const LogPlot::Line& line) {
        std::string name = "c";
        name += std::to_string(line.group % kColours.size());
        return name;
    }

    /// A disk, square, diamond or triangle; hollow on dashed lines.
    void add_marker(const LogPlot::Line& line, double x, double y) {
        constexpr double kSize = 4;
        static constexpr Point kSquare[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
        static constexpr Point kDiamond[] = {{0, -1.3}, {1.3, 0}, {0, 1.3}, {-1.3, 0}};
        static constexpr Point kTriangle[] = {{0, -1.2}, {1.2, 1}, {-1.2, 1}};
        const std::string look =
            "class=\"" + colour_class(line) + (line.is_dashed ? " hollow\"" : "\"");
        const std::size_t kind = line.group / kColours.size() % 4;
        if (kind == 0) {
            svg_ += "<circle " + look + " cx=\"" + number(x) + "\" cy=\"" + number(y) + "\" r=\"" +
                    number(kSize) + "\"/>\n";
            return;
        }
        const std::span<const Point> shape = kind == 1   ? std::span<const Point>(kSquare)
                                             : kind == 2 ? std::span<const Point>(kDiamond)
                                                         : std::span<const Point>(kTriangle);
        svg_ += "<polygon " + look + " points=\"";
        for (const Point& corner : shape) {
            svg_ += number(x + kSize * corner.x) + ',' + number(y + kSize * corner.y) + ' ';
        }
        svg_ += "\"/>\n";
    }

    void add_path(const LogPlot::Line& line, const std::string& points) {
        svg_ += "<polyline class=\"" + colour_class(line) + "\" style=\"fill: none" +
                (line.is_dashed ? "; stroke-dasharray: 7 5" : "") +
                "\" stroke-width=\"2\" points=\"" + points + "\"/>\n";
    }

    void draw_line(const LogPlot::Line& line) {
        std::string points;
        for (const Point& point : line.points) {
            if (is_drawable(point, plot_.is_linear_y)) {
                points += number(x_.place(point.x)) + ',' + number(y_.place(point.y)) + ' ';
            }
        }
        add_path(line, points);
        for (const Point& point : line.points) {
            if (is_drawable(point, plot_.is_linear_y)) {
                add_marker(line, x_.place(point.x), y_.place(point.y));
            }
        }
    }

    void draw_legend(const LogPlot::Line& line, std::size_t index) {
        const double x = kLeft + kLegendColumn * static_cast<double>(index % 2);
        const double y =
            kTop + kPlotHeight + kBelow + kLegendRow * static_cast<double>(index / 2) + 6;
        add_path(line, number(x) + ',' + number(y) + ' ' + number(x + 34) + ',' + number(y));
        add_marker(line, x + 17, y);
        add_text(x + 44, y + 4, "", line.label);
    }

    const LogPlot& plot_;
    Axis x_{}, y_{};
    std::string svg_;
};

} // namespace

std::string svg_text(const LogPlot& plot) {
    return Drawing(plot).run();
}

std::string tick_text(double value, const std::string& unit) {
    struct Prefix {
        double factor;
        const char* name;
    };
    constexpr Prefix kPrefixes[] = {{1e12, "T"}, {1e9, "G"},  {1e6, "M"},         {1e3, "k"},
                                    {1, ""},     {1e-3, "m"}, {1e-6, "\xC2\xB5"}, {1e-9, "n"}};
    // A thousandth of no unit would read "50m".
    if (unit.empty() && value < 1 && value >= 0.0009) {
        return tools::rounded(value, 3);
    }
    const Prefix* prefix = kPrefixes;
    while (prefix + 1 != std::end(kPrefixes) && value < prefix->factor * 0.9999) {
        ++prefix;
    }
    return tools::rounded(value / prefix->factor, 3) + (unit.empty() ? "" : " ") + prefix->name +
           unit;
}

std::string linear_tick_text(double value, double step, const std::string& unit) {
    constexpr double kSame = 1e-9; // Powers of ten are not exact.
    const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - kSame)));
    return tools::fixed(value, decimals) + (unit.empty() ? "" : " ") + unit;
}

} // namespace geodisk::bench
