#include "bench/outputs.hpp"

#include <list>
#include <string>

#include "bench/plots.hpp"
#include "bench/report.hpp"
#include "files/output_file.hpp"
#include "program/failure.hpp"

namespace geodisk::bench {
namespace {

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

} // namespace

void check_outputs(const Options& options) {
    const std::vector<std::string> paths = all_paths(options);
    for (std::size_t i = 0; i < paths.size(); ++i) {
        std::vector<std::string> others = options.meshes;
        others.insert(others.end(), paths.begin(), paths.begin() + static_cast<std::ptrdiff_t>(i));
        for (const std::string& other : others) {
            if (tools::is_same_file(paths[i], other)) {
                tools::fail_usage(paths[i] + ": the output would replace " + other);
            }
        }
        tools::check_writable(paths[i]);
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
