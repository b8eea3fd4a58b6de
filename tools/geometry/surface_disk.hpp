// Disks around points of a surface.
#pragma once

#include <cstdint>
#include <span>

namespace geodisk::tools {

/// A geodesic disk: its centre and its radius in mesh units.
struct SurfaceDisk {
    std::uint32_t face;
    double weight1, weight2; ///< Of the face's second and third corner.
    double radius;
};

/// The radius in the middle by size; of an even number, the larger of the two there. `disks` are
/// not empty.
double median_radius(std::span<const SurfaceDisk> disks);

} // namespace geodisk::tools
