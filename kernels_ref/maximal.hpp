// Maximal sets by sequential dart throwing: the samples of a pool, then those of darts that are
// thrown into the gaps, until no gap is left (host/docs/maximal.md).
#pragma once

#include <cstdint>
#include <vector>

#include "geodisk/mesh.hpp"
#include "geodisk/params.hpp"
#include "lib/surface.hpp"

namespace geodisk::ref {

struct MaximalSet {
    std::vector<FacePoint<double>> samples; ///< Existing ones first.
    std::uint32_t rounds = 0;               ///< Rounds in which darts hit a gap.
    bool is_complete = false;               ///< No gap is left.
};

/// Returns the set of a job with `params.maximal`, as decided in this precision. Every round starts
/// again from whole faces and all disks.
template <class Real>
MaximalSet maximal_set(const PreparedMesh& mesh, const SampleParams& params, double error_bound);

} // namespace geodisk::ref
