// Number of candidates of a face, by the Poisson law: shaders/lib/poisson.glsl on the host.
#pragma once

#include <cstdint>

namespace geodisk {

/// Returns a Poisson number of a mean up to kMaxPerFace, from two random words. It is the one that
/// kernels compute, to the bit.
std::uint32_t poisson(float mean, std::uint32_t first, std::uint32_t second);

} // namespace geodisk
