#include "geodisk/options/spectrum_options.hpp"

#include "program/command.hpp"

namespace geodisk::tools {

void add_spectrum_options(Command command, SpectrumOptions& options,
                          std::vector<std::string>& files) {
    command
        .add_option("MESH SAMPLES", files, "",
                    "Samples of one mesh, *.ply, *.csv or *.pcd, or points of another\n"
                    "program, and before them the mesh; or samples of boxes. Of\n"
                    "several the mean is taken")
        .required();
    command.add_option("-o,--output", options.out.output, "OUT",
                       "Spectrum to write: *.csv, radial mean and anisotropy, or of\n"
                       "boxes of 2 dimensions *.png, a picture with 0 in the middle");
    command.add_option("--harmonics", options.harmonics, "K",
                       "Waves of the surface, from the longest on (1000)");
    command.add_option("--reach", options.reach, "F",
                       "Highest frequency in boxes, in waves per minimum distance (4)");
    add_distance_options(command, options.distance);
    add_tolerance_option(command, options.tolerance);
    add_mesh_options(command, options.mesh);
    add_json_option(command, options.out);
    add_quiet_option(command, options.out, "No progress and no result");
}

} // namespace geodisk::tools
