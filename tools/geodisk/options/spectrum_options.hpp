// The options of `geodisk spectrum`.
#pragma once

#include <string>
#include <vector>

#include "geodisk/options/distance_options.hpp"
#include "geodisk/options/mesh_options.hpp"
#include "geodisk/options/run_options.hpp"

namespace geodisk::tools {

/// As given on the command line.
struct SpectrumOptions {
    MeshOptions mesh; ///< Its file is "" for samples in boxes.
    std::vector<std::string> samples;
    DistanceOptions distance;
    std::string tolerance;
    std::string reach, harmonics; ///< Reach for boxes, harmonics for surfaces; or "".
    OutputOptions out;            ///< A picture or a table.
};

/// Adds all options of the command; `files` are the mesh, if there is one, and the samples.
void add_spectrum_options(Command command, SpectrumOptions& options,
                          std::vector<std::string>& files);

} // namespace geodisk::tools
