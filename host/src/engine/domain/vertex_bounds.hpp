// Upper bounds on distances of vertices, from distances of points.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <geodisk/mesh.hpp>
#include <geodisk/sample.hpp>

namespace geodisk {

/// Returns how far the corners of its face are from a point on the mesh, in a straight line.
std::array<double, 3> corner_distances(const PreparedMesh& mesh, const Sample& point);

/// Returns for each vertex a distance that is at least its own: the least sum of a point's distance
/// and a path straight to a corner of its face, then along edges. Infinite where none leads. Points
/// must be on the mesh.
std::vector<double> vertex_bounds(const PreparedMesh& mesh, std::span<const Sample> points,
                                  std::span<const float> distances);

} // namespace geodisk
