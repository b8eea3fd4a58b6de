// Examines a mesh of which each process has a range.
#pragma once

#include <cstdint>
#include <vector>

#include <geodisk/mesh.hpp>
#include <geodisk/mesh_range.hpp>

#include "parts/ranges/talk.hpp"
#include "parts/ranges/vertex_numbers.hpp"

namespace geodisk {

/// The faces of a range with all their vertices.
struct RangeFaces {
    VertexNumbers numbers;         ///< Vertices of the faces.
    std::vector<double> positions; ///< Three coordinates per vertex.
    std::vector<double> areas;     ///< Area of each face.
};

/// Findings about all ranges together. Components are not known yet.
struct RangeFindings {
    MeshStatistics statistics;      ///< As PreparedMesh::prepare() has them, to the bit.
    double low[3], high[3];         ///< Bounding box of the used vertices.
    std::uint64_t turned_edges = 0; ///< Edges of two faces that are turned over against each other.
    std::uint64_t digest = 0;       ///< Sum of face_digest() over all faces.
};

/// Fetches the vertices of the faces of a range. Throws Stopped(mesh_rejected) for an index out of
/// range, and for coordinates that are not finite.
RangeFaces faces_of(Talk& talk, const MeshRange& range);

/// Examines all ranges. All processes call it, and get the same. Throws Stopped(mesh_rejected) for
/// a mesh that only a process with all of it prepares as it should be: one without area, or with
/// border edges that lie on others or copies of faces.
RangeFindings examine(Talk& talk, const MeshRange& range, RangeFaces& faces);

} // namespace geodisk
