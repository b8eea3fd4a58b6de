// The shape of the triangles of a mesh, and warnings about it: slivers, and coordinates that leave
// few digits for it.
#pragma once

#include <cstdint>
#include <span>

#include "geometry/mesh.hpp"
#include "geometry/mesh_warning.hpp"

namespace geodisk::tools {

/// Distance of a polygon's corners from its mean plane, as a part of its size; 0 for a triangle,
/// and where there are not three coordinates per vertex.
double unevenness(std::span<const double> positions, std::uint32_t dimension,
                  std::span<const std::uint32_t> corners);

/// Counts and bounds of the triangles of a mesh that name three vertices.
struct TriangleShapes {
    Found with_area, without_area; ///< Without area up to rounding, at any scale.
    Found slivers;                 ///< With an angle below a thousandth of a radian.
    double farthest = 0;           ///< Largest coordinate, whatever its sign.
    double diagonal = 0;           ///< Of their bounding box.
};

/// Looks at all triangles of a mesh with positions.
TriangleShapes shapes_of(const MeshFile& mesh);

/// Adds a warning where more than 1 % of the triangles are slivers, and where coordinates are so
/// far from the origin that floats lose the shape.
void warn_of_shapes(const TriangleShapes& shapes, MeshFile& mesh);

} // namespace geodisk::tools
