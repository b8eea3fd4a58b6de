// Frames of samples: rotations that turn z to the normal, and by a random angle about it.
#pragma once

#include <array>
#include <cstdint>

#include "geometry/vec.hpp"

namespace geodisk::tools {

/// Returns a quaternion x y z w with w >= 0 that turns by `angle` about z, and then z to the unit
/// vector `normal`; zero counts as z.
std::array<double, 4> frame_of(const Vec3& normal, double angle);

/// Returns a random angle below 2 pi that follows from the seed, the triangle and the weights of a
/// sample alone, so that other samples do not change it.
double frame_angle(std::uint64_t seed, std::uint32_t face, const float (&weights)[3]);

} // namespace geodisk::tools
