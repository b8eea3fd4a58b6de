// The mean curvature of a mesh at its vertices.
#pragma once

#include <vector>

#include "geometry/mesh.hpp"

namespace geodisk::tools {

/// The absolute mean curvature at each vertex, in 1 / mesh units: half the length of the cotangent
/// Laplacian of the position over the mixed area of Meyer et al. (2003). It is that of a surface in
/// any space, always finite, and 0 at unused vertices.
///
/// At the ends of the surface, the Laplacian would show how the border bends. Vertices of edges
/// that have other than two faces take the mean of their neighbours that have none, or 0. Faces
/// without area, to 1e-7 of their longest side squared, do not count. The mesh must have
/// coordinates.
std::vector<double> mean_curvatures(const MeshFile& mesh);

/// Radius factors from curvature: g = 1 / (1 + H / M), where H is the curvature at the vertex and M
/// its mean over the surface. So g is 1 where the surface is flat, and 1/2 where it is as curved as
/// it is on average. 1 everywhere on a surface that is flat but for rounding.
std::vector<double> curvature_factors(const MeshFile& mesh);

} // namespace geodisk::tools
