// The samples that a job keeps and the points that it avoids, read and put on its mesh.
#pragma once

#include <cstddef>
#include <vector>

#include <geodisk/sample.hpp>

#include "geodisk/inputs/line_input.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/sample_options.hpp"
#include "geodisk/outputs/progress.hpp"

namespace geodisk::tools {

/// The samples of --existing and the points of --avoid, and what is odd about them.
struct ExistingInput {
    std::vector<Sample> samples;
    std::vector<std::uint8_t> classes;       ///< Classes of the samples, if there are several.
    std::vector<KeepOut> avoided;            ///< All but disks on parts that another one covers.
    std::vector<std::uint8_t> avoid_classes; ///< SampleParams::avoid_classes.
    std::size_t points_to_avoid = 0;         ///< With those.
    double lines_to_avoid = 0;               ///< Length of the lines.
    std::vector<MeshWarning> warnings;       ///< Not printed.
};

/// Reads the points and lines of --avoid, if there are any, and adds warnings without printing
/// them. Throws UserError for a file without points, for those that are not on the mesh, and for a
/// radius that is not positive.
Avoided load_avoided(const ConstraintOptions& options, const MeshOptions& of_mesh,
                     const MeshInput& mesh, std::vector<MeshWarning>& warnings,
                     ProgressLine& progress);

/// Reads the samples of --existing, if there are any, and the points of --avoid. Throws UserError
/// for a file without samples, for those that are not on the mesh, for no fewer than --count asks
/// for, and where points to avoid leave no room and no sample is kept.
ExistingInput load_existing(const SampleJob& job, const MeshInput& mesh, ProgressLine& progress);

} // namespace geodisk::tools
