// Disks around points of a surface.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace geodisk::tools {

/// A geodesic disk: its centre and its radius in mesh units.
struct SurfaceDisk {
    std::uint32_t face;
    double weight1, weight2; ///< Weights of the face's second and third corner.
    double radius;
    std::uint32_t kind = 0; ///< 1 + class of the sample; 0 without classes.
};

/// Distances that samples of classes must keep.
struct ClassDistances {
    std::size_t count = 0; ///< Number of classes; 0 without.
    /// In mesh units, count * count, row by row; 0 for two classes that keep none.
    std::vector<double> distances;

    double of(std::size_t class_a, std::size_t class_b) const {
        return distances[count * class_a + class_b];
    }
    /// Returns the distance for two samples: the sum of their radii without classes.
    double of(const SurfaceDisk& a, const SurfaceDisk& b) const {
        return count == 0 ? a.radius + b.radius : of(a.kind - 1, b.kind - 1);
    }
    /// Returns the largest distance for a sample and any other one of a class.
    double reach(const SurfaceDisk& disk) const {
        const auto row = static_cast<std::ptrdiff_t>(count * (std::max(1u, disk.kind) - 1));
        return count == 0 ? 2 * disk.radius
                          : *std::max_element(distances.begin() + row,
                                              distances.begin() + row +
                                                  static_cast<std::ptrdiff_t>(count));
    }
};

/// The disk of each sample, and the distances of their classes.
struct SampleDisks {
    std::vector<SurfaceDisk> disks;
    ClassDistances classes;
};

/// The radius in the middle by size; of an even number, the larger of the two there. `disks` are
/// not empty.
double median_radius(std::span<const SurfaceDisk> disks);

} // namespace geodisk::tools
