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

/// The name for a try, from 1, without extension.
std::string numbered(const std::string& base, int number) {
    return number == 1 ? base : base + '-' + std::to_string(number);
}

/// The first number from `number` on whose names no file has yet.
int free_number(const std::string& base, int number) {
    while (exists(numbered(base, number) + ".ply") || exists(numbered(base, number) + ".png")) {
        ++number;
    }
    return number;
}

/// Returns false if another program was faster, and then takes no name.
bool claim_names(const std::vector<AtomicFile*>& files, const std::string& name) {
    const char* const extensions[] = {".ply", ".png"};
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (!files[i]->claim(name + extensions[i])) {
            std::ranges::for_each(files, &AtomicFile::release);
            return false;
        }
    }
    return true;
}

void name_outputs(const std::string& base, const std::vector<AtomicFile*>& files,
                  std::string& output, std::string& picture) {
    int number = free_number(base, 1);
    while (!claim_names(files, numbered(base, number))) {
        number = free_number(base, number + 1);
    }
    output = numbered(base, number) + ".ply";
    picture = picture.empty() ? "" : numbered(base, number) + ".png";
}

/// A device that cannot draw may still sample.
void sample_and_draw(SampleOptions options) {
    const std::string base = base_name(options.mesh.mesh);
    const auto name = [&base](const auto& files, std::string& output, std::string& picture) {
        name_outputs(base, files, output, picture);
    };
    const std::string first = numbered(base, free_number(base, 1));
    options.out.output = first + ".ply";
    options.picture = first + ".png";
    try {
        sample_to_files(options, name);
        return;
    } catch (const UserError& error) {
        if (error.code() != ExitCode::no_device) {
            throw;
        }
        options.picture.clear();
    }
    sample_to_files(options, name);
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
