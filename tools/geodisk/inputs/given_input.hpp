// The samples that a job keeps, read and put on its mesh.
#pragma once

#include <vector>

#include <geodisk/sample.hpp>

#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/sample_options.hpp"
#include "geodisk/outputs/progress.hpp"

namespace geodisk::tools {

/// The samples of --existing, and what is odd about them.
struct GivenInput {
    std::vector<Sample> samples;
    std::vector<MeshWarning> warnings; ///< Not printed.
};

/// Reads the samples of --existing, if there are any. Throws UserError for a file without samples,
/// for those that are not on the mesh, and for no fewer than --count asks for.
GivenInput load_given(const SampleJob& job, const MeshInput& mesh, ProgressLine& progress);

} // namespace geodisk::tools
