#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <unordered_map>

#include "geometry/mesh.hpp"
#include "shapes/shape_makers.hpp"

namespace geodisk::tools {
namespace {

constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

/// A place in a grid of integer corners or cells.
using Cell = glm::ivec3;

/// The vertices on the corners of an integer grid, made when first asked for.
class GridVertices {
  public:
    explicit GridVertices(Cell cells) : cells_(cells) {}

    template <typename Position>
    std::uint32_t get(MeshFile& mesh, const Cell& corner, const Position& position) {
        std::int64_t key = 0;
        for (int axis = 0; axis < 3; ++axis) {
            key = key * (cells_[axis] + 1) + corner[axis];
        }
        const auto [entry, is_new] = vertices_.try_emplace(key, kNoVertex);
        if (is_new) {
            entry->second = add_vertex(mesh, position(corner));
        }
        return entry->second;
    }

  private:
    Cell cells_;
    std::unordered_map<std::int64_t, std::uint32_t> vertices_;
};

/// The four corners of the face of `cell` towards +-`axis`, counter-clockwise from outside.
std::array<Cell, 4> face_corners(const Cell& cell, int axis, bool positive) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    std::array<Cell, 4> corners{cell, cell, cell, cell};
    corners[positive ? 1 : 3][u] += 1;
    corners[2][u] += 1;
    corners[2][v] += 1;
    corners[positive ? 3 : 1][v] += 1;
    for (Cell& corner : corners) {
        corner[axis] += positive ? 1 : 0;
    }
    return corners;
}

/// A box around the origin whose sides are split into `cells` parts.
MeshFile make_box(Vec3 size, Cell cells) {
    const auto position = [&](const Cell& corner) {
        return size * (Vec3(corner) / Vec3(cells) - 0.5);
    };
    MeshFile mesh;
    GridVertices vertices(cells);
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        for (const bool positive : {false, true}) {
            Cell cell;
            cell[axis] = positive ? cells[axis] - 1 : 0;
            for (cell[u] = 0; cell[u] < cells[u]; ++cell[u]) {
                for (cell[v] = 0; cell[v] < cells[v]; ++cell[v]) {
                    const std::array<Cell, 4> corners = face_corners(cell, axis, positive);
                    std::array<std::uint32_t, 4> quad;
                    for (std::size_t i = 0; i < 4; ++i) {
                        quad[i] = vertices.get(mesh, corners[i], position);
                    }
                    add_quad(mesh, quad[0], quad[1], quad[2], quad[3]);
                }
            }
        }
    }
    return mesh;
}

MeshFile make_icosahedron() {
    const double golden = (1 + std::sqrt(5.0)) / 2;
    MeshFile mesh;
    for (const Vec3& p :
         {Vec3{-1, golden, 0}, Vec3{1, golden, 0}, Vec3{-1, -golden, 0}, Vec3{1, -golden, 0},
          Vec3{0, -1, golden}, Vec3{0, 1, golden}, Vec3{0, -1, -golden}, Vec3{0, 1, -golden},
          Vec3{golden, 0, -1}, Vec3{golden, 0, 1}, Vec3{-golden, 0, -1}, Vec3{-golden, 0, 1}}) {
        add_vertex(mesh, normalize(p));
    }
    mesh.triangles = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                      4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                      6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
    return mesh;
}

using Quad = std::array<std::uint32_t, 4>;

/// Moves every vertex by `factor` of the way to the mean of its neighbours along quad edges.
void relax(std::vector<Vec3>& points, const std::vector<Quad>& quads, double factor) {
    std::vector<Vec3> sums(points.size());
    std::vector<int> counts(points.size(), 0);
    for (const Quad& quad : quads) {
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint32_t from = quad[i];
            const std::uint32_t to = quad[(i + 1) % 4];
            sums[from] += points[to];
            ++counts[from];
        }
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i] = (1 - factor) * points[i] + (factor / counts[i]) * sums[i];
    }
}

/// A frame of `kFrameCells` cubed cubical cells made of square bars, as the faces of unit cells.
constexpr int kFrameCells = 3;
constexpr int kGapPerBar = 2; // The gap between bars in bar widths.
constexpr int kFrameBars = kFrameCells * (1 + kGapPerBar) + 1; // Side length in bar widths.

class Frame {
  public:
    explicit Frame(int bar_width) : bar_width_(bar_width), side_(kFrameBars * bar_width) {}

    int side() const { return side_; }

    bool is_solid(const Cell& cell) const {
        int inside_bars = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const int c = cell[axis];
            if (c < 0 || c >= side_) {
                return false;
            }
            inside_bars += c % ((1 + kGapPerBar) * bar_width_) < bar_width_ ? 1 : 0;
        }
        return inside_bars >= 2;
    }

    std::vector<Quad> surface(MeshFile& mesh) const {
        std::vector<Quad> quads;
        GridVertices vertices(Cell{side_});
        const auto position = [](const Cell& corner) { return Vec3(corner); };
        Cell cell;
        for (cell[0] = 0; cell[0] < side_; ++cell[0]) {
            for (cell[1] = 0; cell[1] < side_; ++cell[1]) {
                for (cell[2] = 0; cell[2] < side_; ++cell[2]) {
                    if (is_solid(cell)) {
                        add_open_faces(mesh, vertices, position, cell, quads);
                    }
                }
            }
        }
        return quads;
    }

  private:
    template <typename Position>
    void add_open_faces(MeshFile& mesh, GridVertices& vertices, const Position& position,
                        const Cell& cell, std::vector<Quad>& quads) const {
        for (int axis = 0; axis < 3; ++axis) {
            for (const bool positive : {false, true}) {
                Cell neighbour = cell;
                neighbour[axis] += positive ? 1 : -1;
                if (is_solid(neighbour)) {
                    continue;
                }
                const std::array<Cell, 4> corners = face_corners(cell, axis, positive);
                Quad& quad = quads.emplace_back();
                for (std::size_t i = 0; i < 4; ++i) {
                    quad[i] = vertices.get(mesh, corners[i], position);
                }
            }
        }
    }

    int bar_width_;
    int side_;
};

} // namespace

MeshFile make_cube(int resolution) {
    return make_box(Vec3(1), Cell(resolution));
}

MeshFile make_plate(int resolution) {
    return make_box({1, 1, 0.01}, {resolution, resolution, 1});
}

MeshFile make_icosphere(int resolution) {
    MeshFile mesh = make_icosahedron();
    for (int step = 0; step < resolution; ++step) {
        std::unordered_map<std::uint64_t, std::uint32_t> midpoints;
        const auto midpoint = [&](std::uint32_t a, std::uint32_t b) {
            const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
            const auto [entry, is_new] = midpoints.try_emplace(key, kNoVertex);
            if (is_new) {
                entry->second = add_vertex(
                    mesh, normalize(point_at(mesh.positions, a) + point_at(mesh.positions, b)));
            }
            return entry->second;
        };
        const std::vector<std::uint32_t> coarse = std::move(mesh.triangles);
        mesh.triangles.clear();
        for (std::size_t i = 0; i < coarse.size(); i += 3) {
            const std::uint32_t a = coarse[i], b = coarse[i + 1], c = coarse[i + 2];
            const std::uint32_t ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
            add_triangle(mesh, a, ab, ca);
            add_triangle(mesh, b, bc, ab);
            add_triangle(mesh, c, ca, bc);
            add_triangle(mesh, ab, bc, ca);
        }
    }
    return mesh;
}

MeshFile make_lattice(int resolution) {
    const Frame frame(resolution);
    MeshFile mesh;
    const std::vector<Quad> quads = frame.surface(mesh);
    std::vector<Vec3> points;
    for (std::uint32_t i = 0; i < mesh.positions.size() / 3; ++i) {
        points.push_back(point_at(mesh.positions, i));
    }
    // Smoothing forth and back (after Taubin 1995) rounds the bars without thinning them. Its reach
    // in cells grows with the square root of the steps.
    const int steps = 2 + 6 * resolution * resolution;
    for (int step = 0; step < steps; ++step) {
        relax(points, quads, 0.5);
        relax(points, quads, -0.5);
    }
    mesh.positions.clear();
    const double half = 0.5 * frame.side();
    for (const Vec3& p : points) {
        add_vertex(mesh, (1.0 / frame.side()) * (p - half));
    }
    for (const Quad& q : quads) {
        const auto diagonal = [&](std::size_t a, std::size_t b) {
            return length(points[q[b]] - points[q[a]]);
        };
        if (diagonal(0, 2) <= diagonal(1, 3)) {
            add_quad(mesh, q[0], q[1], q[2], q[3]);
        } else {
            add_quad(mesh, q[1], q[2], q[3], q[0]);
        }
    }
    return mesh;
}

} // namespace geodisk::tools
