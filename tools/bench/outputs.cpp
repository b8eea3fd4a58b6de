#include "bench/outputs.hpp"

#include <initializer_list>
#include <list>
#include <string>

#include "bench/line_plot.hpp"
#include "bench/report.hpp"
#include "files/files_in_use.hpp"
#include "files/output_file.hpp"
#include "program/failure.hpp"

namespace geodisk::bench {
namespace {

/// What follows the prefix in the names of the plots' files.
constexpr const char* kPlotEndings[] = {"-time-n.svg", "-time-faces.svg", "-memory-n.svg"};

std::vector<std::string> plot_paths(const Options& options) {
    std::vector<std::string> paths;
    if (!options.plot.empty()) {
        for (const char* const ending : kPlotEndings) {
            paths.push_back(options.plot + ending);
        }
    }
    return paths;
}

std::vector<std::string> all_paths(const Options& options) {
    std::vector<std::string> paths = plot_paths(options);
    for (const std::string& path : {options.json, options.csv}) {
        if (!path.empty()) {
            paths.push_back(path);
        }
    }
    return paths;
}

struct Quantity {
    double (*value)(const Measurement&);
    const char* name; ///< Follows the mesh's in the legend.
    bool is_dashed;
};

/// Adds a line per mesh and quantity, those of one mesh side by side.
void add_lines(LinePlot& plot, const std::vector<Series>& series, Sweep sweep,
               std::initializer_list<Quantity> quantities) {
    std::size_t group = 0;
    for (const Series& one : series) {
        if (one.sweep != sweep) {
            continue;
        }
        for (const Quantity& quantity : quantities) {
            LinePlot::Line line{one.mesh + quantity.name, group, quantity.is_dashed, {}};
            for (const Measurement& row : one.rows) {
                line.points.push_back({swept_value(sweep, row), quantity.value(row)});
            }
            plot.lines.push_back(std::move(line));
        }
        ++group;
    }
}

/// The texts of the plots, in the order of kPlotEndings.
std::vector<std::string> plot_texts(const Circumstances& circumstances,
                                    const std::vector<Series>& series) {
    const std::string& device = circumstances.device;
    const char* const time = "time from candidates to set";
    LinePlot time_n{.title = "Time by samples, " + device,
                    .x_label = "samples",
                    .y_label = time,
                    .y_unit = "s"};
    LinePlot time_faces{.title = "Time by triangles of the same surface, " + device,
                        .x_label = "triangles",
                        .y_label = time,
                        .y_unit = "s"};
    LinePlot memory_n{.title = "Device memory by samples, " + device,
                      .x_label = "samples",
                      .y_label = "device memory",
                      .y_unit = "B"};
    const auto both = {
        Quantity{[](const Measurement& row) { return row.seconds.device; }, ", device", false},
        Quantity{[](const Measurement& row) { return row.seconds.reference; }, ", reference",
                 true}};
    const auto bytes = [](const Measurement& row) {
        return static_cast<double>(row.run.device_bytes);
    };
    add_lines(time_n, series, Sweep::samples, both);
    add_lines(time_faces, series, Sweep::triangles, both);
    add_lines(memory_n, series, Sweep::samples, {{bytes, "", false}});
    return {svg_text(time_n), svg_text(time_faces), svg_text(memory_n)};
}

} // namespace

void check_outputs(const Options& options) {
    tools::FilesInUse files;
    for (const std::string& mesh : options.meshes) {
        files.add_read({mesh, mesh});
    }
    for (const std::string& path : all_paths(options)) {
        files.add_written({"the output", path});
        tools::check_writable(path);
    }
    if (!options.plot.empty()) {
        check_gnuplot();
    }
}

void write_outputs(const Options& options, const Circumstances& circumstances,
                   const std::vector<Series>& series) {
    std::list<tools::AtomicFile> files;
    const auto add = [&](const std::string& path, const std::string& text) {
        files.emplace_back(path).write(text);
        files.back().sync();
    };
    if (!options.json.empty()) {
        add(options.json, json_text(circumstances, series));
    }
    if (!options.csv.empty()) {
        add(options.csv, csv_text(circumstances, series));
    }
    if (!options.plot.empty()) {
        const std::vector<std::string> paths = plot_paths(options);
        const std::vector<std::string> texts = plot_texts(circumstances, series);
        for (std::size_t i = 0; i < paths.size(); ++i) {
            add(paths[i], texts[i]);
        }
    }
    for (tools::AtomicFile& file : files) {
        file.commit();
    }
}

} // namespace geodisk::bench
