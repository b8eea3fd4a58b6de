// The prepared mesh in units of the working distance, in the precision of the twin.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geodisk/mesh.hpp"
#include "geodisk/params.hpp"

namespace geodisk::ref {

template <class Real>
struct Edge {
    Real length, apex_x, apex_y, cosine, sine;
    std::uint32_t origin, around, fan_angles;
};

/// Owns the scaled half-edges; borrows fans, corners and alias table from the PreparedMesh.
template <class Real>
struct Surface {
    double unit; ///< In which lengths are measured: working_distance() of the minimum distance.
    std::vector<Edge<Real>> edges;
    std::span<const VertexFan> fans;
    std::span<const std::uint32_t> corners;
    std::span<const AliasColumn> alias;
    /// No edge has three faces. Only then a vertex lies between any two ways into an edge, and the
    /// order of their rays tells which window serves which side ("one angle, one split").
    bool splits_once;

    Surface(const PreparedMesh& mesh, double min_distance);

    std::uint32_t face_count() const { return static_cast<std::uint32_t>(edges.size() / 3); }
};

/// A point of a face by the weights of its second and third corner.
template <class Real>
struct FacePoint {
    std::uint32_t face;
    Real weight1, weight2;
};

} // namespace geodisk::ref
