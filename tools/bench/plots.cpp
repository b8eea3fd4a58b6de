#include "bench/plots.hpp"

#include <initializer_list>

#include "bench/log_plot.hpp"

namespace geodisk::bench {
namespace {

double device_seconds(const Measurement& row) {
    return row.seconds.device;
}

double reference_seconds(const Measurement& row) {
    return row.seconds.reference;
}

double device_bytes(const Measurement& row) {
    return static_cast<double>(row.run.device_bytes);
}

struct Quantity {
    double (*value)(const Measurement&);
    const char* name; ///< Follows the mesh's in the legend.
    bool is_dashed;
};

/// Adds a line per mesh and quantity, those of one mesh side by side.
void add_lines(LogPlot& plot, const std::vector<Series>& series, Sweep sweep,
               std::initializer_list<Quantity> quantities) {
    std::size_t group = 0;
    for (const Series& one : series) {
        if (one.sweep != sweep) {
            continue;
        }
        for (const Quantity& quantity : quantities) {
            LogPlot::Line line{one.mesh + quantity.name, group, quantity.is_dashed, {}};
            for (const Measurement& row : one.rows) {
                line.points.push_back({swept_value(sweep, row), quantity.value(row)});
            }
            plot.lines.push_back(std::move(line));
        }
        ++group;
    }
}

LogPlot time_plot(const std::vector<Series>& series, Sweep sweep) {
    LogPlot plot;
    plot.y_label = "time from candidates to set";
    plot.y_unit = "s";
    add_lines(plot, series, sweep,
              {{device_seconds, ", device", false}, {reference_seconds, ", reference", true}});
    return plot;
}

} // namespace

std::vector<std::string> plot_texts(const Circumstances& circumstances,
                                    const std::vector<Series>& series) {
    const std::string& device = circumstances.device;

    LogPlot time_n = time_plot(series, Sweep::samples);
    time_n.title = "Time by samples, " + device;
    time_n.x_label = "samples";

    LogPlot time_faces = time_plot(series, Sweep::triangles);
    time_faces.title = "Time by triangles of the same surface, " + device;
    time_faces.x_label = "triangles";

    LogPlot memory_n;
    memory_n.title = "Device memory by samples, " + device;
    memory_n.x_label = "samples";
    memory_n.y_label = "device memory";
    memory_n.y_unit = "B";
    add_lines(memory_n, series, Sweep::samples, {{device_bytes, "", false}});

    return {svg_text(time_n), svg_text(time_faces), svg_text(memory_n)};
}

} // namespace geodisk::bench
