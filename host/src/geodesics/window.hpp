// Window: a part of an edge that straight paths reach, and how two windows of one edge compare.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace geodisk::geodesics {

/// Part of a distance by which rounding may tell two equal ones apart.
inline constexpr double kTie = 1e-13;

inline double square(double v) {
    return v * v;
}

/// Part of an edge that straight paths from one root reach, after unfolding the faces they cross.
/// In the frame of the half-edge of the face that they enter, the root is at (x, -y).
struct Window {
    double x, y; ///< y >= 0.
    double begin, end;
    double sigma;            ///< Length of the shortest path to the root.
    std::uint32_t root;      ///< A vertex, or a source: see Wavefront.
    std::uint32_t trail;     ///< How it came here, where that is recorded.
    std::uint32_t chain = 0; ///< Edges that its paths have crossed.
    /// A face that they have crossed, of a long chain. Shortest paths do not return to it.
    std::uint32_t remembered = ~std::uint32_t{0};

    bool is_empty() const { return !(begin < end); }

    /// Returns the squared distance of a point of the edge from the root.
    double square_to(double at) const { return square(at - x) + square(y); }

    /// Returns the length of the path to a point of the edge.
    double distance_to(double at) const { return sigma + std::sqrt(square_to(at)); }

    /// Returns the length of its shortest path.
    double nearest() const { return distance_to(std::clamp(x, begin, end)); }

    /// Returns where the straight line from the root to a point of the face crosses the edge.
    double crossing_to(double to_x, double to_y) const { return x + (to_x - x) * (y / (to_y + y)); }
};

/// Returns the window as seen from the other end of the edge.
inline Window turned(Window window, double length) {
    window.x = length - window.x;
    const double end = length - window.begin;
    window.begin = length - window.end;
    window.end = end;
    return window;
}

/// Takes from each of two windows what the other one reaches by shorter paths, as far as one
/// interval is left of each. What both reach equally far stays with `first`.
void trim(Window& first, Window& second);

} // namespace geodisk::geodesics
