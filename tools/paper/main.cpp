// The command `geodisk_paper`: tables and figures of the paper measured anew, beside the values it
// gives.
#include <CLI/CLI.hpp>

#include <geodisk/version.hpp>

#include "paper/commands.hpp"
#include "program/program.hpp"

namespace {

constexpr const char* kFooter =
    R"(The paper is Ying, Xin, Sun and He, "An Intrinsic Algorithm for Parallel Poisson Disk Sampling
on Arbitrary Surfaces", IEEE TVCG 19(9), 2013. Each subcommand prints a table and writes it as CSV,
with plots as SVG, into the folder --out. fig4, fig5, fig8 and boxes run on a Vulkan device, table1 on
one and on the host; the others are sequential, in double precision, on one core.

Examples:
  geodisk_paper table1 gargoyle.obj
  geodisk_paper fig14 --out results

The exit status is that of geodisk_bench. Whenever it is not 0, no file is written or replaced.)";

void set_up(CLI::App& app) {
    app.set_version_flag("--version", "geodisk_paper " GEODISK_VERSION_STRING);
    app.footer(kFooter);
    app.require_subcommand(1);
    geodisk::paper::add_table1(app);
    geodisk::paper::add_fig4(app);
    geodisk::paper::add_fig5(app);
    geodisk::paper::add_fig7(app);
    geodisk::paper::add_fig8(app);
    geodisk::paper::add_fig9(app);
    geodisk::paper::add_fig13(app);
    geodisk::paper::add_fig14(app);
    geodisk::paper::add_boxes(app);
}

} // namespace

int main(int argc, char** argv) {
    return geodisk::tools::run_program(
        "geodisk_paper", "Measures what the paper's tables and figures show", set_up, argc, argv);
}
