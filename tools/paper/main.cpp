// The command `geodisk_paper`: tables and figures of the paper measured anew, beside the values it
// gives.
#include <geodisk/version.hpp>

#include "paper/commands.hpp"
#include "program/program.hpp"

namespace {

constexpr const char* kFooter =
    R"(The paper is Ying, Xin, Sun and He, "An Intrinsic Algorithm for Parallel Poisson Disk Sampling
on Arbitrary Surfaces", IEEE TVCG 19(9), 2013. Each subcommand prints a table and writes it as CSV,
with plots as SVG and pictures as PNG, into the folder --out. fig13 and fig14 are sequential,
in double precision, on one core; table1 runs on a Vulkan device and on the host, all others on a
device, which draws their pictures as well.

Examples:
  geodisk_paper table1 gargoyle.obj
  geodisk_paper fig14 --out results

The exit status is that of geodisk_bench. Whenever it is not 0, no file is written or replaced.)";

void set_up(geodisk::tools::Command app) {
    app.has_version("geodisk_paper " GEODISK_VERSION_STRING);
    app.has_footer(kFooter);
    geodisk::paper::add_commands(app);
    geodisk::paper::add_figures(app);
}

} // namespace

int main(int argc, char** argv) {
    return geodisk::tools::run_program("geodisk_paper",
                                       "Measure the results of the paper's tables and figures",
                                       set_up, argc, argv);
}
