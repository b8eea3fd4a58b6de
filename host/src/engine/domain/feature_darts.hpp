// The candidates on features, for the list of a domain.
#pragma once

#include <vector>

#include <geodisk/features.hpp>

#include "engine/domain/listed.hpp"

namespace geodisk {

/// Returns the corners, then the darts along curves in their random order: a function of the seed
/// and the keys of faces. Points are in faces that take samples.
GEODISK_API std::vector<ListedCandidate>
feature_darts(const PreparedMesh& mesh, const SampleParams& params, const Features& features);

} // namespace geodisk
