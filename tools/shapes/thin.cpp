#include <cstddef>
#include <span>
#include <vector>

#include "geometry/angles.hpp"
#include "geometry/mesh.hpp"
#include "shapes/shape_makers.hpp"

namespace geodisk::tools {
namespace {

/// A circle around the axis; a point where the radius is 0, as the first and the last may be.
struct PlateRing {
    double radius, height;
};

/// The surface between rings one above the other, of `around` points each.
MeshFile make_turned(std::span<const PlateRing> rings, std::uint32_t around) {
    MeshFile mesh;
    std::vector<std::uint32_t> first; // vertex of each ring
    for (const PlateRing& ring : rings) {
        const std::uint32_t points = ring.radius == 0 ? 1 : around;
        for (std::uint32_t i = 0; i < points; ++i) {
            const double turn = angle(i, around);
            const std::uint32_t vertex = add_vertex(
                mesh, {ring.radius * cosine(turn), ring.radius * sine(turn), ring.height});
            if (i == 0) {
                first.push_back(vertex);
            }
        }
    }
    for (std::size_t r = 1; r < rings.size(); ++r) {
        const std::uint32_t below = first[r - 1], above = first[r];
        for (std::uint32_t i = 0; i < around; ++i) {
            const std::uint32_t j = (i + 1) % around;
            if (rings[r - 1].radius == 0) {
                add_triangle(mesh, below, above + j, above + i);
            } else if (rings[r].radius == 0) {
                add_triangle(mesh, below + i, below + j, above);
            } else {
                add_quad(mesh, below + i, below + j, above + j, above + i);
            }
        }
    }
    return mesh;
}

} // namespace

MeshFile make_tube(int resolution) {
    constexpr double kTubeRadius = 1e-4;
    std::vector<PlateRing> rings{{0, 0}};
    for (const double height : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        rings.push_back({kTubeRadius, height});
    }
    rings.push_back({0, 1});
    return make_turned(rings, static_cast<std::uint32_t>(resolution));
}

MeshFile make_spike(int resolution) {
    std::vector<PlateRing> rings;
    double height = 0;
    for (const double radius : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
        rings.push_back({radius, height / 7});
        ++height;
    }
    rings.push_back({0, 1});
    return make_turned(rings, static_cast<std::uint32_t>(resolution));
}

MeshFile make_cone(int resolution) {
    constexpr double kSlope = 1e-3;
    std::vector<PlateRing> rings{{0, 0}};
    for (const double height : {0.001, 0.01, 0.1, 0.4, 0.7, 1.0}) {
        rings.push_back({kSlope * height, height});
    }
    return make_turned(rings, static_cast<std::uint32_t>(resolution));
}

} // namespace geodisk::tools
