// Line plots with logarithmic or linear axes, drawn by gnuplot as SVG.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/statistics.hpp"

namespace geodisk::paper {

struct LinePlot {
    struct Line {
        std::string label;
        /// Lines of one group share a colour and, where colours run out, differ from other groups
        /// by their markers.
        std::size_t group = 0;
        bool is_dashed = false;
        std::vector<bench::Point> points; ///< Those that an axis cannot show are left out.
        bool has_markers = true;          ///< For points that are not too many.
    };

    std::string title;
    std::string x_label, y_label;
    std::string y_unit = {};  ///< Follows each tick's number, like "s"; may be empty.
    bool is_linear_y = false; ///< For values that differ by less than a factor of two or so.
    std::vector<Line> lines = {};
    bool is_linear_x = false;
};

/// Throws UserError(bad_output) if gnuplot is not installed.
void check_gnuplot();

/// An SVG document. Throws UserError(bad_output) as check_gnuplot(), or if gnuplot fails.
std::string svg_text(const LinePlot& plot);

} // namespace geodisk::paper
