#include "geometry/surface_disk.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace geodisk::tools {

double median_radius(std::span<const SurfaceDisk> disks) {
    std::vector<double> radii;
    radii.reserve(disks.size());
    for (const SurfaceDisk& disk : disks) {
        radii.push_back(disk.radius);
    }
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    return *middle;
}

} // namespace geodisk::tools
