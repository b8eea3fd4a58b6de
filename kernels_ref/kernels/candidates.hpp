// Twin of shaders/kernels/candidates.comp: the pool of candidates (paper sections 3.3 and 4.2).
#pragma once

#include <cstdint>
#include <vector>

#include "lib/surface.hpp"

namespace geodisk::ref {

/// Candidate `rank` of the stream of `seed`: an area-proportional face and the square-root
/// barycentric map. Weights are multiples of 2^-24, so they are the same numbers in float and
/// double.
template <class Real>
FacePoint<Real> draw_candidate(std::span<const AliasColumn> alias, std::uint64_t seed,
                               std::uint32_t rank);

/// Candidates `first` to `first + count - 1`.
template <class Real>
std::vector<FacePoint<Real>> draw_candidates(std::span<const AliasColumn> alias, std::uint64_t seed,
                                             std::uint32_t count, std::uint32_t first = 0);

} // namespace geodisk::ref
