#include "geodisk/options/spectrum_options.hpp"

#include "program/command.hpp"

namespace geodisk::tools {

void add_spectrum_options(Command command, SpectrumOptions& options,
                          std::vector<std::string>& files) {
    command
        .add_option("MESH SAMPLES", files, "",
                    help_of_input("A mesh and samples on it",
                                  "; or samples of boxes without a mesh. "
                                  "Several files of samples give their mean"))
        .required();
    command.add_option("-o,--output", options.out.output, "OUT",
                       "File to write: *.csv with radial mean and anisotropy; or, for\n"
                       "boxes of 2 dimensions, a picture *.png with 0 in the middle");
    command.add_option("--harmonics", options.harmonics, "K",
                       "Number of waves of the surface, longest first (default 1000)");
    command.add_option("--reach", options.reach, "F",
                       "Maximum frequency in boxes, in waves per minimum distance\n"
                       "(default 4)");
    add_distance_options(command, options.distance);
    add_tolerance_option(command, options.tolerance);
    add_mesh_options(command, options.mesh);
    add_json_option(command, options.out);
    add_quiet_option(command, options.out, "No progress and no result");
}

} // namespace geodisk::tools
