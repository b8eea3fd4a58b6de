// Distances that samples must keep, as the options of `geodisk verify` and a sample file say.
#pragma once

#include <cstddef>
#include <vector>

#include "files/samples/sample_file.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/class_options.hpp"
#include "geodisk/options/verify_options.hpp"

namespace geodisk::tools {

/// Distances that samples must keep.
struct WantedSpacing {
    bool is_known = true; ///< Else nothing says how far, and nothing follows.
    ClassTable classes;
    double min_distance = 0; ///< For all pairs, or two with the largest radius; 0 if not known.
    bool radii_vary = false;
    std::vector<double> radii; ///< By row.
    std::size_t wrong = 0;     ///< Rows whose own radius is another.
};

/// With density options the radii are computed again; without, those of the file count, unless a
/// distance is given. A file with neither radii nor a distance in its header leaves it unknown.
/// Throws UserError if density options or classes need that distance, or the file lacks classes.
WantedSpacing wanted_spacing(const VerifyOptions& options, const SampleFile& samples,
                             const MeshInput& mesh);

} // namespace geodisk::tools
