// Comparing the reference's distances with known ones, in double and in float.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "support/geodesic_query.hpp"

namespace geodisk::test {

/// The true distance from a source to target i, kUnreachable where there is no path.
using Truth = std::function<double(const Point& source, std::size_t target)>;

struct DistanceCase {
    std::string name;
    const TestMesh& mesh;
    double reach; ///< In mesh units; targets beyond it must not be hit.
    std::vector<Point> sources;
    std::vector<Point> targets;
    double exactness = 1e-9; ///< Error allowed in double with tight tolerances, of the reach.
};

/// Checks every pair three times: in double with tight tolerances against `exactness`, and in
/// double and in float with the documented tolerances against the guard they promise. A group
/// computes them as well, tight and in float, and the library in double.
void check_distances(const DistanceCase& c, const Truth& truth);

/// All distances against the straight line in space: for flat convex meshes.
void check_straight(const DistanceCase& c);

} // namespace geodisk::test
