#include "geodisk/options/report_options.hpp"

#include "geodisk/set_analysis.hpp"
#include "program/command.hpp"

namespace geodisk::tools {

std::vector<picture::View> ReportOptions::first_views() const {
    const auto given = picture::parse_view("--view", view);
    return given ? std::vector{*given} : picture::views_to_try();
}

void add_report_options(Command command, ReportOptions& options) {
    add_mesh_argument(command, options.sample.mesh, "Mesh to sample");
    add_output_argument(command, options.sample.out, "Page to write: *.html");
    command
        .add_option("--view", options.view, "VIEW",
                    "First direction of view: front, back, left, right, top,\n"
                    "bottom, AZIMUTH,ELEVATION in degrees, or auto for the one\n"
                    "that shows most")
        .offers(picture::named_views())
        .shows_default();
    add_up_option(command, options.up);
    add_probes_option(command, options.probes);
    command.add_option("--harmonics", options.harmonics, "K",
                       "Show the power spectrum from K waves of the surface (default\n"
                       "no spectrum); blue noise needs about five per sample");
    add_job_options(command, options.sample);
    add_json_option(command, options.sample.out);
    add_quiet_option(command, options.sample.out);
    add_verbose_option(command, options.sample.run.device);
}

} // namespace geodisk::tools
