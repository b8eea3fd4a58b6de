// How far conflicts may be from the faces of a part, where radii vary.
//
// Samples p and q conflict if their distance d is below r(p) + r(q). Let R be a function that is
// nowhere below r and changes by at most s over a distance of 1, and x a point of the path between
// them. Then d < R(p) + R(q) <= 2 R(x) + s d, so d < 2 R(x) / (1 - s).
#pragma once

#include <algorithm>
#include <vector>

#include <geodisk/mesh.hpp>
#include <geodisk/radius_field.hpp>

namespace geodisk {

/// A small one bounds well where radii change slowly, a large one where they do not.
constexpr double kReachSlope = 0.125;

/// Returns the bound, at most 1, by R, in minimum distances.
inline double reach_of(double raised) {
    return std::min(1.0, 2 / (1 - kReachSlope) * raised);
}

/// Widths around a part, in minimum distances.
struct HaloWidths {
    double near; ///< Of the faces whose samples it must know, and a few more, so that it guesses
                 ///< most of them.
    double all;  ///< Of the faces that disks of those cross.
};

/// Returns the widths where conflicts reach so far.
inline HaloWidths widths_for(double reach) {
    constexpr double kGuessed = 1.5;
    const double near = std::min(1.0, kGuessed * reach);
    return {near, near + reach};
}

/// Returns the bounds at the vertices of a mesh, in minimum distances. Inside a face the bound is
/// at most the largest at its corners.
std::vector<double> reaches(const PreparedMesh& mesh, const RadiusField& radii,
                            double min_distance);

} // namespace geodisk
