// Samples as a page carries them.
#pragma once

#include <span>
#include <vector>

#include "analysis/surface_statistics.hpp"
#include "geometry/surface_disk.hpp"
#include "report/page_array.hpp"

namespace geodisk::tools::report {

/// In the order of the darts:
///   sample_faces
///   sample_weights    two each, of the face's second and third corner
///   sample_radii      in mesh units, or one for all where they are the same
///   sample_kinds      1 + class, or one 0 for all without classes
///   sample_neighbors  the nearest other sample; the sample itself where there is none in reach
///   sample_distances  its geodesic distance in mesh units; 0 where there is none
/// `neighbors` are those of the samples, in distances that they must keep.
std::vector<PageArray> sample_arrays(const SampleDisks& samples,
                                     std::span<const analysis::Neighbor> neighbors);

} // namespace geodisk::tools::report
