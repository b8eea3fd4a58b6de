// A surface of a job and its place among the others.
#pragma once

#include <cstdint>
#include <span>

#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>

namespace geodisk {

/// Faces, vertices and corners of fans follow those of the surfaces before.
struct PlacedSurface {
    const PreparedMesh* mesh;
    SampleParams params; ///< The distance in units of the mesh.
    double unit;         ///< In which the device measures: working_distance().
    std::uint32_t first_face, first_vertex, first_corner;
};

/// All surfaces of a job, at least one.
using PlacedSurfaces = std::span<const PlacedSurface>;

/// Of all of them.
inline std::uint32_t face_count(PlacedSurfaces surfaces) {
    return surfaces.back().first_face + surfaces.back().mesh->face_count();
}
inline std::uint32_t vertex_count(PlacedSurfaces surfaces) {
    return surfaces.back().first_vertex + surfaces.back().mesh->vertex_count();
}
inline bool has_radii(PlacedSurfaces surfaces) {
    return surfaces.front().params.radii != nullptr;
}

} // namespace geodisk
