// Sample and KeepOut: points of a surface, and disks around them.
// Stable.
#pragma once

#include <cstdint>

namespace geodisk {

/// A point of a surface: an accepted candidate, or a sample that is given.
struct Sample {
    std::uint32_t face; ///< Index of its triangle in the caller's mesh.
    float weights[3];   ///< Weights of the triangle's corners in order; they sum to exactly 1.
};

/// A geodesic disk of a surface without samples.
struct KeepOut {
    Sample center;
    double radius; ///< In mesh units; for one of several surfaces in units of its instance.
};

} // namespace geodisk
