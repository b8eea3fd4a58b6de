// Surfaces of a job that draw their candidates by the same seed, and so draw many alike.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/domain/placed_surface.hpp"

namespace geodisk {

/// All surfaces of a job with the same seed. Faces with equal keys have the same priorities, and
/// about as many candidates as their means allow.
struct AlikeSurfaces {
    std::vector<std::size_t> surfaces; ///< In the order of the job.
    double expected = 0;               ///< Candidates that their first stages expect together.
    double deviation = 0;              ///< Bound on the standard deviation of that number.
};

/// Returns the surfaces by their seeds.
std::vector<AlikeSurfaces> alike_surfaces(PlacedSurfaces surfaces);

/// Sets the lags of the surfaces: where many are alike, their equal orders are spread over those of
/// a few candidates. Otherwise hundreds of candidates would be due at once, and none for long
/// after.
void set_lags(std::span<PlacedSurface> surfaces);

} // namespace geodisk
