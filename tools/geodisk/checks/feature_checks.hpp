// Marks of samples on features: each must be where its mark says.
#pragma once

#include <cstdint>
#include <vector>

#include "files/samples/sample_file.hpp"
#include "geodisk/inputs/mesh_input.hpp"

namespace geodisk::tools {

/// Returns the rows whose column `feature` is wrong for the angle in the header: marked samples
/// that are not on such a feature of the mesh, and samples without a mark on a corner or before
/// marked ones. Returns none without that column, and without an angle in the header. Throws
/// UserError(bad_input) for an angle out of range.
std::vector<std::uint32_t> wrong_features(const SampleFile& samples, const MeshInput& mesh);

} // namespace geodisk::tools
