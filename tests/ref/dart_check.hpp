// Runs of the reference's dart throwing, and what a Poisson disk sample must satisfy.
#pragma once

#include <cstdint>
#include <vector>

#include "geodisk/params.hpp"
#include "lib/frame.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {

/// A pool and what dart throwing accepted of it.
struct Darts {
    double min_distance;
    ref::Tolerances tolerances;
    double largest_error;             ///< Error of the distances along the longest chain.
    std::vector<Point> pool;          ///< In rank order.
    std::vector<std::uint32_t> ranks; ///< Accepted, ascending.

    std::vector<Point> samples() const;
};

/// ref::throw_darts with the tolerances of a run.
template <class Real>
Darts thrown(const PreparedMesh& mesh, const SampleParams& params);

/// The minimum distance that should give about `count` samples, as parameters of a run.
SampleParams params_for(const PreparedMesh& mesh, double count, std::uint64_t seed = 1);

/// No two samples are closer than the distance, by CGAL on the faces around each sample. Only for
/// meshes CGAL can take.
void check_spacing(const TestMesh& mesh, const std::vector<Point>& samples, double min_distance);

/// Every rejected candidate lies within the limit of an accepted one of lower rank, up to the
/// guard; by CGAL, one patch per sample.
void check_covered(const TestMesh& mesh, const Darts& darts);

/// Every rejected candidate lies within the limit of an accepted one of lower rank, and no accepted
/// one does, up to the guard; in double precision.
void check_maximal(const PreparedMesh& mesh, const Darts& darts);

} // namespace geodisk::test
