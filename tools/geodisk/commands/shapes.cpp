
#include <algorithm>
#include <iostream>
#include <memory>
#include <string>

#include "files/meshes/mesh_file.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "shapes/builtin_shapes.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kShapesExamples[] = {
    "geodisk shapes",
    "geodisk shapes torus-knot:64 -o knot.ply",
};

struct ShapesOptions {
    std::string shape, output;
};

void list_shapes() {
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
    std::cout << "\nTo change the resolution, append it to the name, as in builtin:icosphere:6\n";
    std::cout.flush();
    if (!std::cout) {
        fail_output("the list of shapes cannot be written");
    }
}

/// The prefix of names elsewhere may be left out.
void write_shape(const ShapesOptions& options) {
    const std::string prefix = "builtin:";
    const bool has_prefix = options.shape.starts_with(prefix);
    const std::string name = has_prefix ? options.shape : prefix + options.shape;
    write_mesh(options.output, read_mesh(name));
}

void run_shapes(const ShapesOptions& options) {
    if (options.shape.empty() != options.output.empty()) {
        fail_usage(options.output.empty() ? "no file given to write the shape to; give --output"
                                          : "no shape given to write");
    }
    if (options.shape.empty()) {
        list_shapes();
    } else {
        write_shape(options);
    }
}

} // namespace

void add_shapes_command(Command app) {
    const Command command = app.add_command(
        "shapes", "List the built-in surfaces, which need no mesh file, or write one");
    const auto options = std::make_shared<ShapesOptions>();
    command.add_option("SHAPE", options->shape, "", "Surface to write: NAME or NAME:RESOLUTION");
    command.add_option("-o,--output", options->output, "OUT", "File to write: *.ply");
    command.has_footer(help_footer(kShapesExamples));
    command.calls([options] { run_shapes(*options); });
}

} // namespace geodisk::tools
