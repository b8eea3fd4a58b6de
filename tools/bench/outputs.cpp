#include "bench/outputs.hpp"

#include <list>
#include <string>
#include <vector>

#include "bench/report.hpp"
#include "files/output/files_in_use.hpp"
#include "files/output/output_file.hpp"
#include "program/failure.hpp"

namespace geodisk::bench {
namespace {

std::vector<std::string> all_paths(const Options& options) {
    std::vector<std::string> paths;
    for (const std::string& path : {options.json, options.csv}) {
        if (!path.empty()) {
            paths.push_back(path);
        }
    }
    return paths;
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
    for (tools::AtomicFile& file : files) {
        file.commit();
    }
}

} // namespace geodisk::bench
