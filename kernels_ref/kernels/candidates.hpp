// Twin of shaders/kernels/candidates.comp: the pool of candidates (paper sections 3.3, 4.2
// and 5.8).
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

/// The same on the surface of a run: where radii vary, as dense as 1 / r^2.
template <class Real>
FacePoint<Real> draw_candidate(const Surface<Real>& surface, std::uint64_t seed,
                               std::uint32_t rank);

/// Candidates `first` to `first + count - 1`.
template <class Real>
std::vector<FacePoint<Real>> draw_candidates(std::span<const AliasColumn> alias, std::uint64_t seed,
                                             std::uint32_t count, std::uint32_t first = 0);
template <class Real>
std::vector<FacePoint<Real>> draw_candidates(const Surface<Real>& surface, std::uint64_t seed,
                                             std::uint32_t count, std::uint32_t first = 0);

} // namespace geodisk::ref
