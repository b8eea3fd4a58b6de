// Line plots with logarithmic axes, or a linear one upwards, as SVG.
#pragma once

#include <string>
#include <vector>

#include "bench/statistics.hpp"

namespace geodisk::bench {

struct LogPlot {
    struct Line {
        std::string label;
        /// Lines of one group share a colour and, where colours run out, differ from other groups
        /// by their markers.
        std::size_t group = 0;
        bool is_dashed = false;
        std::vector<Point> points; ///< Those that an axis cannot show are left out.
    };

    std::string title;
    std::string x_label, y_label;
    std::string x_unit, y_unit; ///< Follow each tick's number, like "s"; may be empty.
    bool is_linear_y = false;   ///< For values that differ by less than a factor of two or so.
    std::vector<Line> lines;
};

/// A document of its own. Colours follow the reader's preference for light or dark.
std::string svg_text(const LogPlot& plot);

/// A number with at most three digits and a prefix from n to T: "300", "1k", or with the unit "s"
/// "3 ms"; without a unit "0.05" rather than "50m".
std::string tick_text(double value, const std::string& unit);

/// A number in full, with as many decimals as a tick of this distance to the next one needs:
/// "0.72", "80 %".
std::string linear_tick_text(double value, double step, const std::string& unit);

} // namespace geodisk::bench
