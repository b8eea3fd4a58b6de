// Points in the frames of the half-edges of a face.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include <geodisk/mesh.hpp>

namespace geodisk::geodesics {

/// A point in the frame of a half-edge.
struct FlatPoint {
    double x, y;
};

inline double length_of(FlatPoint p) {
    return std::sqrt(p.x * p.x + p.y * p.y); // Not std::hypot, whose last bit differs.
}

/// Returns a point in the frame of the half-edge after h, by the angle between them. The
/// coordinates of h's apex would lose the direction of a needle's short side.
inline FlatPoint in_next_frame(std::span<const HalfEdge> edges, std::uint32_t h, FlatPoint p) {
    const double length = edges[h].length;
    const HalfEdge& next = edges[next_in_face(h)];
    if (!(length > 0)) {
        return p;
    }
    const double cosine = next.apex_x / length, sine = next.apex_y / length;
    const double back = length - p.x;
    return {back * cosine + p.y * sine, back * sine - p.y * cosine};
}

/// Returns a point of a face in the frame of one of its half-edges.
template <class Weight>
FlatPoint point_in(const HalfEdge& edge, std::uint32_t h, const Weight (&weights)[3]) {
    const double end = weights[next_in_face(h) % 3], apex = weights[previous_in_face(h) % 3];
    return {end * edge.length + apex * edge.apex_x, apex * edge.apex_y};
}

} // namespace geodisk::geodesics
