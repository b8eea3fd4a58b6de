// A surface of a job and its place among the others.
#pragma once

#include <cstdint>
#include <span>

#include <geodisk/job_frame.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>

namespace geodisk {

/// A surface of a job. Faces, vertices and corners are numbered through all surfaces.
struct PlacedSurface {
    const PreparedMesh* mesh;
    SampleParams params; ///< Distance in units of the mesh.
    JobFrame frame;      ///< Frame of the mesh, or of one that it is a part of.
    Stages stages;       ///< Stages of the surface in its frame.
    std::uint32_t first_face, first_vertex, first_corner;
    double scale = 1;        ///< Length in the instance of a unit of the mesh.
    bool may_divide = false; ///< See Domain::Impl::whole.
    std::uint32_t lag = 0;   ///< Offset added to the orders of its candidates.
};

/// Places a surface that is sampled alone.
PlacedSurface placed(const PreparedMesh& mesh, const SampleParams& params, const JobFrame& frame);

/// All surfaces of a job, at least one.
using PlacedSurfaces = std::span<const PlacedSurface>;

/// Returns the number of faces of all surfaces.
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
