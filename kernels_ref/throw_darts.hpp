// Sequential dart throwing (paper section 4): the set that every parallel run must return, and the
// reference for speed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geodisk/params.hpp"
#include "kernels/detect.hpp"
#include "kernels/pool.hpp"

namespace geodisk::ref {

struct RunResult {
    std::vector<std::uint32_t> ranks; ///< Accepted candidates of the pool, ascending.
    std::uint64_t windows = 0;
    std::uint64_t tested = 0;
    std::uint32_t max_waiting = 0;
    std::uint32_t longest_chain = 0;
};

/// A point to avoid.
template <class Real>
struct AvoidedPoint {
    FacePoint<Real> center;
    Real radius;                           ///< In units of the frame.
    std::uint8_t only_class = kAllClasses; ///< The class that it keeps out.
};

/// Returns the power of two by which lengths are multiplied in the disk of a point to avoid.
template <class Real>
Real scale_of(Real radius) {
    Real scale = 1;
    while (radius > 1 && radius * scale >= 1) {
        scale /= 2;
    }
    return scale;
}

/// Returns the surface with all lengths multiplied by this. Radii are all the same.
template <class Real>
Surface<Real> scaled(Surface<Real> surface, Real scale) {
    for (Edge<Real>& edge : surface.edges) {
        edge.length *= scale;
        edge.apex_x *= scale;
        edge.apex_y *= scale;
    }
    surface.radii.clear();
    surface.classes = {};
    return surface;
}

/// Visits the ranks upwards and accepts each candidate that no point to avoid, no existing sample
/// and no accepted one rejected, until the pool is used up or there are `most` samples, existing
/// ones included. Existing samples have class 0 unless `existing_classes` has one for each.
template <class Real>
RunResult throw_darts(const Surface<Real>& surface, const Pool<Real>& pool,
                      const Tolerances& tolerances, std::uint32_t most = kMaxCandidates,
                      std::span<const FacePoint<Real>> given = {},
                      std::span<const AvoidedPoint<Real>> avoided = {},
                      std::span<const std::uint8_t> existing_classes = {});

} // namespace geodisk::ref
