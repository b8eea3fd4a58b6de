// Twin of the shaders that draw candidates face by face: how many each face has, and which (paper
// sections 3.3, 4.2 and 5.8).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geodisk/params.hpp"
#include "lib/surface.hpp"

namespace geodisk::ref {

/// Returns how many candidates each face has in a stage of a job on the surface.
template <class Real>
std::vector<std::uint32_t> count_candidates(const Surface<Real>& surface,
                                            const SampleParams& params, std::uint32_t stage);

/// Draws candidates 0, 1, ... of a face in a stage, and their priorities of 28 bits: uniform by the
/// square-root barycentric map, or if radii vary as dense as 1 / r^2. Weights are multiples of
/// 2^-24, so they are the same numbers in float and double. The priority of a candidate that is no
/// dart, by SampleParams::class_shares, has the bit gpu::kNoDart.
template <class Real>
void draw_candidates(const Surface<Real>& surface, const SampleParams& params, std::uint32_t face,
                     std::uint32_t stage, std::span<FacePoint<Real>> points,
                     std::span<std::uint32_t> priorities);

} // namespace geodisk::ref
