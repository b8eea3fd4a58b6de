#include "paper/line_plot.hpp"

#include <doctest/doctest.h>

#include <string>

#include "test_files.hpp"

using geodisk::paper::LinePlot;
using geodisk::paper::svg_text;
using geodisk::tools::contains;

TEST_CASE("a plot draws every line and escapes its texts") {
    LinePlot plot{"a < b & c, 'd' \"e\" `f` \\n", "samples", "time", "s", false, {}};
    plot.lines.push_back({"solid", 0, false, {{100, 0.1}, {1000, 0.2}}});
    plot.lines.push_back({"dashed", 7, true, {{100, 0.3}, {0, 5}}}); // One cannot be drawn.
    plot.lines.push_back({"empty", 2, false, {}});
    const std::string svg = svg_text(plot);
    CHECK(contains(svg, "<svg "));
    CHECK(contains(svg, "</svg>"));
    CHECK(contains(svg, ">a &lt; b &amp; c, 'd' \"e\" `f` \\n<"));
    for (const char* const text : {">samples<", ">time<", ">solid<", ">dashed<", ">empty<", ">100<",
                                   ">1k<", ">100 ms<", ">200 ms<"}) {
        INFO(text);
        CHECK(contains(svg, text));
    }
    CHECK_FALSE(contains(svg, ">5 s<"));
    CHECK(contains(svg_text(LinePlot{}), "</svg>"));
}

TEST_CASE("small numbers without a unit are in full") {
    LinePlot plot;
    plot.lines.push_back({"", 0, false, {{0.05, 1e5}, {0.2, 2e6}}});
    const std::string svg = svg_text(plot);
    for (const char* const text : {">0.05<", ">0.1<", ">100k<", ">2M<"}) {
        INFO(text);
        CHECK(contains(svg, text));
    }
}

TEST_CASE("a linear axis reaches from the least to the greatest value") {
    LinePlot plot{"", "", "", "%", true, {}};
    plot.lines.push_back({"rho", 0, false, {{10, 0.701}, {100, 0.778}}});
    const std::string svg = svg_text(plot);
    for (const char* const text : {">0.7 %<", ">0.74 %<", ">0.78 %<"}) {
        INFO(text);
        CHECK(contains(svg, text));
    }
    plot.lines[0].points = {{10, 0.5}};
    CHECK_FALSE(contains(svg_text(plot), "nan"));
    plot.lines[0].points = {{10, 0}, {20, 0}}; // Zero is a value there.
    const std::string zeros = svg_text(plot);
    CHECK_FALSE(contains(zeros, "nan"));
    CHECK(contains(zeros, ">0 %<"));
}
