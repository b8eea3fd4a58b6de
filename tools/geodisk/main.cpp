// The command `geodisk`: picks the subcommand.
#include <geodisk/version.hpp>

#include "geodisk/commands/commands.hpp"
#include "program/program.hpp"

namespace {

constexpr const char* kFooter = R"(Examples:
  geodisk bunny.obj
  geodisk sample builtin:showpiece -o points.ply --count 10000
  geodisk sample bunny.obj -o points.csv --min-distance 1%
  geodisk sample bunny.obj -o points.ply --min-distance 1% --method pdts --count 500
  geodisk batch meshes -o samples --count 10000
  geodisk verify bunny.obj points.csv
  geodisk analyze bunny.obj points.csv
  geodisk render bunny.obj points.ply -o picture.png
  geodisk report bunny.obj -o bunny.html --count 10000
  geodisk sample bunny.obj -o points.ply --count 10000 --lift normals:0.05
  geodisk transfer points.csv standing.obj sitting.obj -o sitting.csv
  geodisk sample bunny.obj -o points.ply --count 10000 --density-curvature
  geodisk box -o points.csv --dim 4 --count 1e5 --periodic

Exit status:
  0    success
  1    verify found samples too close, off the mesh or of another radius; meshes of batch failed
  2    wrong usage: an unknown option, no or several distances, a value out of range
  3    an input file is missing, unreadable or malformed
  4    an output cannot be written
  5    no Vulkan device that can run geodisk
  6    the work does not fit into the memory of the host or the device
  7    the device was lost, or an error or crash inside geodisk or the driver
  130  interrupted (SIGINT)
  143  terminated (SIGTERM), or 128 + signal for SIGHUP and SIGQUIT
Whenever the status is 2 or more, no output file is written or replaced, but for the meshes of
batch that are done.)";

void set_up(geodisk::tools::Command app) {
    app.has_version("geodisk " GEODISK_VERSION_STRING);
    app.needs_command();
    app.has_footer(kFooter);
    geodisk::tools::add_sample_command(app);
    geodisk::tools::add_batch_command(app);
    geodisk::tools::add_verify_command(app);
    geodisk::tools::add_analyze_command(app);
    geodisk::tools::add_spectrum_command(app);
    geodisk::tools::add_render_command(app);
    geodisk::tools::add_report_command(app);
    geodisk::tools::add_transfer_command(app);
    geodisk::tools::add_box_command(app);
    geodisk::tools::add_shapes_command(app);
    geodisk::tools::add_info_command(app);
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
