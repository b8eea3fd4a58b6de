#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <system_error>

#include "files/mesh_file.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/options/sample_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

bool exists(const Path& path) {
    std::error_code error;
    return std::filesystem::exists(std::filesystem::symlink_status(path, error));
}

/// "bunny-samples" of "meshes/bunny.obj".
std::string base_name(const std::string& mesh) {
    std::string name = mesh;
    if (is_builtin(mesh)) {
        name.erase(0, mesh.find(':') + 1);
        std::replace(name.begin(), name.end(), ':', '-');
    } else {
        const std::u8string stem = Path(mesh).stem().u8string();
        name.assign(stem.begin(), stem.end());
    }
    return name + "-samples";
}

/// Names samples and picture as no file is named yet.
void choose_names(SampleOptions& options) {
    const std::string base = base_name(options.mesh.mesh);
    std::string name = base;
    for (int number = 2; exists(name + ".ply") || exists(name + ".png"); ++number) {
        name = base + '-' + std::to_string(number);
    }
    options.out.output = name + ".ply";
    options.picture = name + ".png";
}

/// A device that cannot draw may still sample.
void sample_and_draw(SampleOptions options) {
    choose_names(options);
    try {
        sample_to_files(options);
        return;
    } catch (const UserError& error) {
        if (error.code() != ExitCode::no_device) {
            throw;
        }
        options.picture.clear();
    }
    sample_to_files(options);
    if (options.out.has_summary()) {
        std::cout << "picture       none, the device cannot draw\n";
        flush_or_fail("the summary");
    }
}

} // namespace

void add_quick_command(Command app) {
    const Command command = app.add_command(
        "quick", "What geodisk MESH does: about 10,000 samples into NAME-samples.ply\n"
                 "and a picture beside it, replacing nothing");
    const auto options = std::make_shared<SampleOptions>();
    options->count = "10000";
    add_mesh_argument(command, options->mesh, "Mesh to sample");
    add_device_options(command, options->run.device);
    add_quiet_option(command, options->out);
    add_verbose_option(command, options->run.device);
    command.calls([options] { sample_and_draw(*options); });
}

void choose_command(Command app, std::vector<std::string>& arguments) {
    if (arguments.empty()) {
        arguments.emplace_back("--help");
        return;
    }
    const std::string& first = arguments.front();
    if (first.starts_with('-') || app.has_command(first)) {
        return;
    }
    if (!is_builtin(first) && !exists(first)) {
        fail_usage(in_quotes(first) + ": no such command or mesh file");
    }
    arguments.insert(arguments.begin(), "quick");
}

} // namespace geodisk::tools
