// The command `geodisk`: picks the subcommand.
#include <geodisk/version.hpp>

#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "program/program.hpp"

namespace {

constexpr const char* kExamples[] = {
    "geodisk bunny.obj",
    "geodisk bunny.obj --count 500",
    "geodisk sample bunny.obj -o points.csv --min-distance 1%",
    "geodisk verify bunny.obj points.csv",
};

constexpr const char* kEnvironment = R"(

Environment:
  GEODISK_DEVICE   device for commands without --device: name, index or UUID (geodisk info)
  GEODISK_CACHE    off: keep no compiled pipelines in the user's cache folder
  NO_COLOR         no colours on a terminal, if set

Each command has its own options and examples: geodisk COMMAND --help.)";

void set_up(geodisk::tools::Command app) {
    app.has_version("geodisk " GEODISK_VERSION_STRING);
    app.needs_command();
    app.has_footer(geodisk::tools::help_footer(kExamples) + kEnvironment);
    geodisk::tools::add_sample_command(app);
    geodisk::tools::add_batch_command(app);
    geodisk::tools::add_verify_command(app);
    geodisk::tools::add_analyze_command(app);
    geodisk::tools::add_spectrum_command(app);
    geodisk::tools::add_render_command(app);
    geodisk::tools::add_report_command(app);
    geodisk::tools::add_neighbours_command(app);
    geodisk::tools::add_distances_command(app);
    geodisk::tools::add_cells_command(app);
    geodisk::tools::add_bake_command(app);
    geodisk::tools::add_transfer_command(app);
    geodisk::tools::add_box_command(app);
    geodisk::tools::add_shapes_command(app);
    geodisk::tools::add_info_command(app);
    geodisk::tools::add_conformance_command(app);
    geodisk::tools::add_quick_command(app);
    geodisk::tools::add_completion_command(app);
    geodisk::tools::add_manual_command(app);
}

} // namespace

int main(int argc, char** argv) {
    return geodisk::tools::run_program(
        "geodisk",
        "Random points on a triangle mesh, no two closer than a minimum distance along the "
        "surface",
        set_up, argc, argv, geodisk::tools::choose_command);
}
