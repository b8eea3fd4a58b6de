// Surroundings of some faces of a surface, within a distance along it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/export.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/mesh.hpp>

namespace geodisk {

/// Returns for each vertex a lower bound on its geodesic distance from the faces that are marked,
/// at most 5/4 of `reach`. Linear in faces, the values are lower bounds everywhere.
GEODISK_API std::vector<double>
distances_from(const PreparedMesh& mesh, std::span<const std::uint8_t> is_marked, double reach);

/// Least value at a corner of a face, of distances_from().
GEODISK_API double nearest_corner(const PreparedMesh& mesh, std::span<const double> distances,
                                  std::uint32_t face);
/// Largest value at a corner of a face.
double farthest_corner(const PreparedMesh& mesh, std::span<const double> distances,
                       std::uint32_t face);

/// Returns by which part of a distance that jobs test a halo has to be wider than it.
double halo_margin(const JobFrame& frame);

} // namespace geodisk
