// Twin of shaders/kernels/space_candidates.comp and space_fill.comp: candidates on a surface,
// placed in its bounding box for straight-line distances.
#pragma once

#include <vector>

#include "geodisk/mesh.hpp"
#include "geodisk/params.hpp"
#include "kernels/grid.hpp"

namespace geodisk::ref {

struct SpacePoints {
    BoxParams box;                             ///< Bounding box of the mesh, as a job.
    std::vector<BoxPoint> by_rank;             ///< Points in dart order, on BoxLattice::finest().
    std::vector<std::array<float, 3>> normals; ///< Normals in dart order, of unit length or zero.
    double guard;                              ///< Conflicts are tested against 1 + guard.
};

/// Draws candidates on `mesh`, prepared from `view`, with three coordinates per vertex.
SpacePoints draw_in_space(const MeshView& view, const PreparedMesh& mesh,
                          const SampleParams& params);

/// Sorts the points into cells. Distances are straight, or those of curves.
template <class Real>
BoxPool<Real> space_pool(const SpacePoints& points, bool is_curved);

} // namespace geodisk::ref
