// From the faces of a file to triangles that keep their numbers.
#pragma once

#include <cstddef>
#include <cstdint>

#include "files/meshes/polygon_mesh.hpp"
#include "geometry/mesh.hpp"

namespace geodisk::tools {

struct SplitCounts {
    Found small_faces;          ///< Faces of fewer than 3 corners, which make no triangle.
    Found bent_faces;           ///< Faces of more than 3 corners that are far from flat.
    std::uint64_t polygons = 0; ///< Faces of more than 3 corners.
    Found repeating_faces;      ///< Faces that lost some triangles as they repeat a vertex.
};

/// Returns how many triangles all faces make.
std::uint64_t triangles_of(const PolygonMesh& polygons);

/// Fills `mesh.triangles` and `mesh.polygons`, and may take `polygons.corners` for it: a face of k
/// >= 3 corners makes k - 2 triangles. One that repeats a vertex is split without the repetition;
/// what it lacks of its triangles follows as some that take no part.
SplitCounts split_faces(PolygonMesh& polygons, MeshFile& mesh);

/// Drops every triangle whose three vertices an earlier one has, whichever way round: it takes no
/// part then. Returns the dropped ones. Time is that of sorting.
Found drop_copies(MeshFile& mesh);

} // namespace geodisk::tools
