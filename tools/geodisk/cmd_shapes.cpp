#include "geodisk/cmd_shapes.hpp"

#include <algorithm>
#include <iostream>
#include <string>

#include <CLI/CLI.hpp>

#include "common/builtin_shapes.hpp"
#include "common/user_error.hpp"

namespace geodisk::tools {
namespace {

std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(text.size(), width), ' ');
    return text;
}

void run_shapes() {
    std::size_t name_width = 0;
    for (const BuiltinShape& shape : builtin_shapes()) {
        name_width = std::max(name_width, shape.name.size());
    }
    const std::string prefix = "builtin:";
    name_width += prefix.size() + 2;
    std::cout << padded("MESH", name_width) << padded("resolution", 20) << "surface; resolution\n";
    for (const BuiltinShape& shape : builtin_shapes()) {
        const std::string range = std::to_string(shape.default_resolution) + " (" +
                                  std::to_string(shape.min_resolution) + " to " +
                                  std::to_string(shape.max_resolution) + ")";
        std::cout << padded(prefix + std::string(shape.name), name_width) << padded(range, 20)
                  << shape.summary << '\n';
    }
    std::cout << "\nAnother resolution goes behind the name, as in builtin:icosphere:6\n";
    std::cout.flush();
    if (!std::cout) {
        throw UserError(ExitCode::bad_output, "the list of shapes cannot be written");
    }
}

} // namespace

void add_shapes_command(CLI::App& app) {
    app.add_subcommand("shapes", "List the built-in surfaces, which need no mesh file")
        ->callback(run_shapes);
}

} // namespace geodisk::tools
