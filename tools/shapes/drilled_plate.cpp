// A plate with holes as CAD programs cut it into triangles: flat sides of long slivers between the
// holes.
#include <cmath>
#include <cstddef>
#include <vector>

#include "geometry/edge_edits.hpp"
#include "geometry/polygon_triangulation.hpp"
#include "shapes/shape_makers.hpp"

namespace geodisk::tools {
namespace {

constexpr double kHalfThickness = 0.005;
// Radius of a hole, as a part of the distance between holes.
constexpr double kRadius = 0.05;
constexpr std::uint32_t kHoleSides = 32;
// By how much slivers are longer than triangles of equal sides would be.
constexpr double kStretch = 1000;

/// The border of one hole, clockwise: its vertices on the upper side.
using Ring = std::vector<std::uint32_t>;

/// Adds the holes in a chain that goes back and forth, so that neighbours follow each other.
/// Neither sizes nor places are equal, so that few triangles are alike.
std::vector<Ring> add_holes(MeshFile& mesh, std::uint32_t columns, std::uint32_t rows) {
    std::vector<Ring> holes;
    const double pitch = 1.0 / columns;
    const auto part = [](double k, double step) { return std::fmod(k * step, 1); };
    for (std::uint32_t k = 0; k < columns * rows; ++k) {
        const std::uint32_t row = k / columns;
        const std::uint32_t column = row % 2 == 0 ? k % columns : columns - 1 - k % columns;
        const double radius = pitch * kRadius * (1 + part(k, 0.6180339887));
        const double x = pitch * (column + 0.4 + 0.2 * part(k, 0.7548776662));
        const double y = pitch * (row + 0.4 + 0.2 * part(k, 0.5698402910));
        Ring& ring = holes.emplace_back();
        for (std::uint32_t i = 0; i < kHoleSides; ++i) {
            const double turn = -angle(i, kHoleSides);
            ring.push_back(add_vertex(
                mesh, {x + radius * std::cos(turn), y + radius * std::sin(turn), kHalfThickness}));
        }
    }
    return holes;
}

/// Returns the place in a ring of the vertex that is nearest to another.
std::size_t nearest(const MeshFile& mesh, const Ring& ring, std::uint32_t other) {
    const auto square = [&](std::uint32_t vertex) {
        const Vec3 way = point_at(mesh.positions, vertex) - point_at(mesh.positions, other);
        return dot(way, way);
    };
    std::size_t best = 0;
    for (std::size_t i = 1; i < ring.size(); ++i) {
        best = square(ring[i]) < square(ring[best]) ? i : best;
    }
    return best;
}

/// Returns the polygon of the upper side: the outline, and a way from its first vertex through all
/// holes and back, along the same bridges.
std::vector<std::uint32_t> joined_polygon(const MeshFile& mesh, const Ring& outline,
                                          const std::vector<Ring>& holes) {
    std::vector<std::uint32_t> forth = outline;
    forth.push_back(outline[0]);
    std::vector<std::uint32_t> back; // In the opposite order.
    std::uint32_t from = outline[0];
    for (std::size_t h = 0; h < holes.size(); ++h) {
        const Ring& ring = holes[h];
        const std::size_t entry = nearest(mesh, ring, from);
        std::size_t exit = h + 1 < holes.size() ? nearest(mesh, ring, holes[h + 1][0]) : entry;
        exit = exit == entry ? (entry + 1) % ring.size() : exit;
        for (std::size_t i = entry; i != exit; i = (i + 1) % ring.size()) {
            forth.push_back(ring[i]);
        }
        for (std::size_t i = entry; i != exit; i = (i + ring.size() - 1) % ring.size()) {
            back.push_back(ring[i]);
        }
        forth.push_back(ring[exit]);
        from = ring[exit];
        if (h + 1 < holes.size()) {
            back.push_back(from);
        }
    }
    forth.insert(forth.end(), back.rbegin(), back.rend());
    return forth;
}

/// Returns the cotangent of the angle at `apex`, from `from` to `to`, of a plate that is kStretch
/// times as long.
double cotangent(const MeshFile& mesh, std::uint32_t apex, std::uint32_t from, std::uint32_t to) {
    const Vec3 p = point_at(mesh.positions, apex);
    const Vec3 u = point_at(mesh.positions, from) - p;
    const Vec3 v = point_at(mesh.positions, to) - p;
    return (u.x * v.x / kStretch + u.y * v.y * kStretch) / (u.x * v.y - u.y * v.x);
}

} // namespace

MeshFile make_drilled_plate(int resolution) {
    MeshFile mesh;
    const auto columns = static_cast<std::uint32_t>(resolution);
    const std::uint32_t rows = (3 * columns + 3) / 4;
    const double height = static_cast<double>(rows) / columns;
    std::vector<Ring> rings{{add_vertex(mesh, {0, 0, kHalfThickness}),
                             add_vertex(mesh, {1, 0, kHalfThickness}),
                             add_vertex(mesh, {1, height, kHalfThickness}),
                             add_vertex(mesh, {0, height, kHalfThickness})}};
    const std::vector<Ring> holes = add_holes(mesh, columns, rows);
    triangulate_polygon(mesh.positions, joined_polygon(mesh, rings[0], holes), mesh.triangles);
    // Lawson's flips (1977), to the Delaunay triangles of the stretched plate.
    EdgeEdits(mesh).flip_all(
        [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
            return cotangent(mesh, c, a, b) + cotangent(mesh, d, b, a) < -1e-9;
        });
    rings.insert(rings.end(), holes.begin(), holes.end());
    close_below(mesh, rings, -kHalfThickness);
    return mesh;
}

void close_below(MeshFile& mesh, const std::vector<std::vector<std::uint32_t>>& rings, double z) {
    const auto upper = static_cast<std::uint32_t>(mesh.positions.size() / 3);
    for (std::uint32_t v = 0; v < upper; ++v) {
        const Vec3 p = point_at(mesh.positions, v);
        add_vertex(mesh, {p.x, p.y, z});
    }
    const std::size_t count = mesh.triangles.size();
    for (std::size_t i = 0; i < count; i += 3) {
        add_triangle(mesh, mesh.triangles[i] + upper, mesh.triangles[i + 2] + upper,
                     mesh.triangles[i + 1] + upper);
    }
    for (const Ring& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const std::uint32_t a = ring[i];
            const std::uint32_t b = ring[(i + 1) % ring.size()];
            add_quad(mesh, a, a + upper, b + upper, b);
        }
    }
}

} // namespace geodisk::tools
