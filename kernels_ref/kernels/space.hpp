// Twin of shaders/kernels/space_candidates.comp and space_fill.comp: candidates on a surface,
// placed in its bounding box for straight-line distances.
#pragma once

#include <vector>

#include "geodisk/mesh.hpp"
#include "geodisk/params.hpp"
#include "kernels/grid.hpp"

namespace geodisk::ref {

struct SpacePoints {
    BoxParams box;                             ///< The bounding box of the mesh, as a job.
    std::vector<BoxPoint> by_rank;             ///< In dart order, on BoxLattice::finest().
    std::vector<std::array<float, 3>> normals; ///< Likewise, of unit length or zero.
    double guard;                              ///< Conflicts are tested against 1 + guard.
};

/// `mesh` was prepared from `view`, of three coordinates per vertex.
SpacePoints draw_in_space(const MeshView& view, const PreparedMesh& mesh,
                          const SampleParams& params);

/// The points in cells. Distances are straight, or those of curves.
template <class Real>
BoxPool<Real> space_pool(const SpacePoints& points, bool is_curved);

} // namespace geodisk::ref
