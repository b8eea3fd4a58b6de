// Distances on meshes with flat triangles, compared with those of unfolding alone.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "support/meshes.hpp"

namespace geodisk::test {

/// Distances from each point to each.
using DistanceTable = std::vector<std::vector<double>>;

/// Returns all distances between the points by unfolding, of those up to a little more than
/// `reach`.
DistanceTable unfolded_distances(const TestMesh& mesh, const std::vector<Point>& points,
                                 double reach);

/// A distance that is not the true one.
struct WrongDistance {
    const char* kind; ///< Method by which it was computed.
    std::size_t from, to;
    double found, truth;

    std::string text() const;
};

/// Computes the distances between points by the reference in double precision and in float, with
/// and without trimming, and by a group. Returns those that are not the true ones: below the reach
/// none may be missed or too long, and none may be too short. Does not look for points on faces
/// whose edges are all shorter than 2^-30 of the reach, which are below the resolution of disks.
/// `surface` is prepared from `mesh`.
std::vector<WrongDistance> wrong_distances(const TestMesh& mesh, const PreparedMesh& surface,
                                           const std::vector<Point>& points, double reach);

} // namespace geodisk::test
