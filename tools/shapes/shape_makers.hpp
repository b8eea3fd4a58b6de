// The generators behind builtin_shapes.cpp. `resolution` is already checked.
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include "geometry/mesh.hpp"
#include "geometry/vec.hpp"

namespace geodisk::tools {

inline constexpr double kPi = std::numbers::pi;

/// The angle of step `i` of `count` around the full circle.
inline double angle(std::uint32_t i, std::uint32_t count) {
    return 2 * kPi * i / count;
}

inline std::uint32_t add_vertex(MeshFile& mesh, Vec3 p) {
    const std::size_t index = mesh.positions.size() / 3;
    mesh.positions.insert(mesh.positions.end(), {p.x, p.y, p.z});
    return static_cast<std::uint32_t>(index);
}

inline void add_triangle(MeshFile& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.insert(mesh.triangles.end(), {a, b, c});
}

/// Split along the diagonal a c.
inline void add_quad(MeshFile& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                     std::uint32_t d) {
    add_triangle(mesh, a, b, c);
    add_triangle(mesh, a, c, d);
}

/// The quads of a grid whose vertex (i, j) is `vertex(i, j)`, i in [0, columns], j in [0, rows].
template <typename Vertex>
void add_grid(MeshFile& mesh, std::uint32_t columns, std::uint32_t rows, const Vertex& vertex) {
    for (std::uint32_t i = 0; i < columns; ++i) {
        for (std::uint32_t j = 0; j < rows; ++j) {
            add_quad(mesh, vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
        }
    }
}

// solids.cpp: closed surfaces
MeshFile make_cube(int resolution);
MeshFile make_plate(int resolution);
MeshFile make_icosphere(int resolution);
MeshFile make_lattice(int resolution);

// drilled_plate.cpp
MeshFile make_drilled_plate(int resolution);
/// Makes an upper side a solid: adds it once more, turned over and with all vertices at height `z`,
/// and walls along its borders, which `rings` lead around with the surface to their left.
void close_below(MeshFile& mesh, const std::vector<std::vector<std::uint32_t>>& rings, double z);

// sweeps.cpp: surfaces swept by a moving curve
MeshFile make_torus_knot(int resolution);
MeshFile make_moebius(int resolution);
MeshFile make_showpiece(int resolution);

// sheets.cpp: open sheets
MeshFile make_folded_sheet(int resolution);
MeshFile make_unfolded_sheet(int resolution);
MeshFile make_swiss_roll(int resolution);
MeshFile make_unrolled_sheet(int resolution);
MeshFile make_crossed_sheet(int resolution);
MeshFile make_uncrossed_sheet(int resolution);
MeshFile make_terrain(int resolution);

// thin.cpp: surfaces that shortest paths could wind around many times
MeshFile make_tube(int resolution);
MeshFile make_spike(int resolution);
MeshFile make_cone(int resolution);

// r4.cpp: closed surfaces with four coordinates
MeshFile make_clifford_torus(int resolution);
MeshFile make_klein_bottle(int resolution);
MeshFile make_veronese(int resolution);

} // namespace geodisk::tools
