#include "paper/line_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>

#ifndef _WIN32
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;
#endif

#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::paper {
namespace {

/// Neighbours differ for the colour blind as well (after Okabe and Ito 2008).
constexpr std::array<const char*, 6> kColours{"#0068a8", "#c24a00", "#007a58",
                                              "#a8407c", "#7a6400", "#5a5f66"};
/// Disk, square, diamond and triangle: gnuplot's numbers of the filled ones. Those before are
/// hollow.
constexpr std::array<int, 4> kMarkers{7, 5, 13, 9};

/// As gnuplot reads it: nothing in it but quotes has a meaning.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char character : tools::one_line(text)) {
        result += character;
        result += character == '\'' ? "'" : "";
    }
    return result + "'";
}

/// Range that an axis has to show.
struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;

    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

std::string range_text(char axis, double low, double high) {
    return std::string("set ") + axis + "range [" + tools::exact_text(low) + ':' +
           tools::exact_text(high) + "]\n";
}

/// From below the least to above the greatest value; sideways lines may begin and end at the frame.
std::string linear_axis(char axis, const Range& range, const std::string& unit) {
    const double margin = axis == 'x' ? 0 : 0.1;
    const double extent = range.high > range.low ? range.high - range.low
                          : range.high != 0      ? std::abs(range.high)
                                                 : 1;
    return range_text(axis, range.low - margin * extent, range.high + margin * extent) +
           "set format " + axis + ' ' + quoted("%g" + (unit.empty() ? "" : ' ' + unit)) + '\n';
}

/// Ticks at powers of ten and, where there is room for them, at some or all multiples in between,
/// with prefixes from n to T; but 0.05 rather than 50m.
std::string log_axis(char axis, const Range& range, const std::string& unit) {
    const bool is_plain = unit.empty() && range.low < 1 && range.low >= 0.0009;
    const double extent = range.high / range.low;
    const char* const digits = extent < 10 ? "1 2 3 4 5 6 7 8 9" : extent < 3000 ? "1 2 5" : "1";
    const std::string format =
        is_plain ? "%g" : "%.0s" + std::string(unit.empty() ? "" : " ") + "%c" + unit;
    const std::string tics = std::string(1, axis) + "tics";
    return range_text(axis, range.low / 1.2, range.high * 1.2) + "set logscale " + axis + "\nset " +
           tics + " ()\nset for [i=-12:12] for [k in " + quoted(digits) + "] " + tics +
           " add (gprintf(" + quoted(format) + ", k * 10.0**i) k * 10.0**i)\n";
}

bool is_drawable(double value, bool is_linear) {
    return std::isfinite(value) && (is_linear || value > 0);
}

std::string script_of(const LinePlot& plot) {
    Range x, y;
    std::string data, lines;
    for (std::size_t i = 0; i < plot.lines.size(); ++i) {
        const LinePlot::Line& line = plot.lines[i];
        const std::string name = "$line" + std::to_string(i);
        std::string points;
        for (const bench::Point& point : line.points) {
            if (is_drawable(point.x, plot.is_linear_x) && is_drawable(point.y, plot.is_linear_y)) {
                x.add(point.x);
                y.add(point.y);
                points += tools::exact_text(point.x) + ' ' + tools::exact_text(point.y) + '\n';
            }
        }
        // A line without points is in the legend as well.
        data += name + " << END\n" + (points.empty() ? "NaN NaN\n" : points) + "END\n";
        const int marker = kMarkers[line.group / kColours.size() % kMarkers.size()];
        lines += ", " + name + " with " + (line.has_markers ? "linespoints" : "lines") +
                 " linewidth 2 dashtype " + (line.is_dashed ? "2" : "1") + " pointtype " +
                 std::to_string(line.is_dashed ? marker - 1 : marker) + " linecolor rgb '" +
                 kColours[line.group % kColours.size()] + "' title " + quoted(line.label);
    }
    if (x.high < x.low) { // Nothing to draw: axes alone.
        x = y = {1, 10};
    }
    const std::string unit = plot.y_unit == "%" ? "%%" : plot.y_unit; // As formats want it.
    const auto rows = static_cast<int>((plot.lines.size() + 1) / 2);
    return "set encoding utf8\nset terminal svg noenhanced size 760," +
           std::to_string(500 + 20 * rows) + " font 'sans-serif,13' background 'white'\n" +
           "set title " + quoted(plot.title) + "\nset xlabel " + quoted(plot.x_label) +
           "\nset ylabel " + quoted(plot.y_label) +
           "\nset grid\nset key below height 1 maxcols 2 Left reverse\n" +
           (plot.is_linear_x ? linear_axis : log_axis)('x', x, "") +
           (plot.is_linear_y ? linear_axis : log_axis)('y', y, unit) + data + "plot NaN notitle" +
           lines + '\n';
}

/// Returns what gnuplot draws, run without a shell; nothing if it cannot be run or fails.
std::optional<std::string> drawn([[maybe_unused]] const std::string& script) {
#ifndef _WIN32
    // Files rather than pipes: neither side ever waits for the other.
    using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
    const File in(std::tmpfile(), std::fclose), out(std::tmpfile(), std::fclose);
    if (!in || !out || std::fputs(script.c_str(), in.get()) == EOF || std::fflush(in.get()) != 0) {
        return std::nullopt;
    }
    std::rewind(in.get());
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, fileno(in.get()), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, fileno(out.get()), STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    char program[] = "gnuplot", no_user_settings[] = "--default-settings";
    char* const arguments[] = {program, no_user_settings, nullptr};
    pid_t child = 0;
    const int error = posix_spawnp(&child, program, &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    int status = 0;
    if (error == 0 && waitpid(child, &status, 0) == child && status == 0) {
        std::string bytes;
        std::rewind(out.get());
        for (int byte = 0; (byte = std::fgetc(out.get())) != EOF;) {
            bytes += static_cast<char>(byte);
        }
        return bytes;
    }
#endif
    return std::nullopt;
}

} // namespace

void check_gnuplot() {
    if (!drawn("")) {
        tools::fail_output(
            "plots need the program gnuplot, which cannot be run (on Debian, install "
            "the package gnuplot-nox)");
    }
}

std::string svg_text(const LinePlot& plot) {
    const std::optional<std::string> svg = drawn(script_of(plot));
    if (!svg) {
        tools::fail_output("gnuplot cannot draw the plot " + tools::in_quotes(plot.title));
    }
    return *svg;
}

} // namespace geodisk::paper
