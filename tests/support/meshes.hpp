// Meshes for tests: files, built-in shapes and tiny ones made by hand.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geodisk/mesh.hpp"
#include "geometry/vec.hpp"
#include "lib/surface.hpp"

namespace geodisk::test {

using Point = ref::FacePoint<double>;
using tools::Vec3;

/// A triangle mesh that owns its arrays; what takes or returns a Vec3 is for meshes in space.
struct TestMesh {
    std::vector<double> positions;
    std::vector<std::uint32_t> triangles;
    std::uint32_t dimension = 3;
    bool keep_seams = true; ///< Tests build what is connected and what is not.

    MeshView view() const { return {positions, triangles, dimension, keep_seams}; }
    std::uint32_t face_count() const { return static_cast<std::uint32_t>(triangles.size() / 3); }
    std::uint32_t vertex_count() const {
        return static_cast<std::uint32_t>(positions.size() / dimension);
    }
    Vec3 vertex(std::uint32_t v) const;
    Vec3 corner(std::uint32_t face, std::uint32_t k) const {
        return vertex(triangles[std::size_t{3} * face + k]);
    }
    Vec3 position(const Point& point) const;

    std::uint32_t add_vertex(Vec3 p);
    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
};

/// The mesh with vertices of its own for each face, at the same places. Its view joins seams.
TestMesh soup_of(const TestMesh& mesh);

/// PreparedMesh::prepare; throws std::runtime_error with the message when the mesh is rejected.
PreparedMesh prepared(const TestMesh& mesh);

/// The mesh in data_file(name), "meshes/bunny_1k4.obj" or "bad/warn_unwelded.obj", where there is
/// one.
std::optional<TestMesh> shared_mesh(const std::string& name);

/// The surface of stand_in_meshes.hpp of that name, or that stands for that file.
TestMesh stand_in_mesh(std::string_view name);

struct NamedMesh {
    std::string name;
    TestMesh mesh;
};

/// The meshes to test in place of those of `names`, each once: of "meshes/bunny_1k4.obj" the
/// surface that stands for it, always, and the real mesh where there is one; of others the mesh
/// itself.
std::vector<NamedMesh> meshes_like(const std::vector<std::string>& names);

/// A built-in shape of the tools.
TestMesh builtin(std::string_view name, int resolution);

/// The point of `face` with about these weights of its second and third corner, rounded to the
/// multiples of 2^-24 that candidates have, so that it is the same point in float and in double.
Point face_point(std::uint32_t face, double weight1, double weight2);

/// The point of the mesh's plane z = 0 at (x, y), in the first face that holds it.
Point point_at(const TestMesh& mesh, double x, double y);

/// The place of vertex v, once in every face that uses it.
std::vector<Point> points_at_vertex(const TestMesh& mesh, std::uint32_t v);

/// Points distributed uniformly by area: darts of the seed.
std::vector<Point> random_points(const PreparedMesh& mesh, std::uint64_t seed, std::uint32_t count);

/// Every triangle cut in four along its edge midpoints, `times` times. The children of face f are
/// faces 4f to 4f + 3; the surface stays the same.
TestMesh subdivided(const TestMesh& mesh, int times);

/// A mask of the faces whose center has a coordinate above the middle of the bounding box.
std::vector<std::uint8_t> mask_above(const TestMesh& mesh, std::size_t axis);

// Flat rectangles [0, width] x [0, height] at z = 0, on which straight lines are shortest.

/// Cells cut along the same diagonal.
TestMesh flat_grid(std::uint32_t columns, std::uint32_t rows, double width, double height);
/// Grid lines at the given ascending coordinates, diagonals alternating.
TestMesh flat_lines(const std::vector<double>& xs, const std::vector<double>& ys);
/// A grid with vertices moved at random and diagonals chosen by the empty circle.
TestMesh flat_irregular(std::uint32_t parts, std::uint64_t seed);
/// The unit square as one fan around (0.5, 0.001), nearly straight angles at the lower border.
TestMesh flat_obtuse_fan(std::uint32_t parts_per_side);

/// The unit square twice, glued along its border: a closed surface without volume. Faces 0 and 1
/// are the front, 2 and 3 the back, cut along the other diagonal.
TestMesh two_sided_square();

/// Side walls of a regular prism with `sides` faces of width `side`, open at both ends.
TestMesh prism_tube(std::uint32_t sides, double side, double height, std::uint32_t rows);

/// All faces of a cube of parts^3 unit cells, each cut into six tetrahedra around the same diagonal
/// (Kuhn): inner edges have four or six faces. Every vertex is moved at random, by up to `shift`
/// along each axis.
TestMesh tetrahedra(std::uint32_t parts, double shift);

/// The same, and of its first edge on a rough sheet of cells^2 squares, so that disks on that meet
/// the tetrahedra late.
TestMesh tetrahedra_beyond_sheet(std::uint32_t parts, double shift, std::uint32_t cells);

/// A flat disk of needles around its center, with a path over nearly half of them all.
TestMesh needle_disk(std::uint32_t needles);

/// A flat strip of width 1, of needles across.
TestMesh needle_strip(std::uint32_t needles, double length);

/// Sheets of needles upon each other, found by a fuzzer: windows that wind around their tips are
/// narrower than rounding and hardly ever cover one another.
TestMesh needle_sheets();

/// All triangles between some random points of the unit cube, so that each edge has two faces fewer
/// than there are points. From 22 points on, windows in large disks are too many to wait for.
TestMesh all_triangles(std::uint32_t points);

/// The orientable double cover of builtin:moebius: face f of the strip lies under faces f and
/// f + face_count of the cover, the latter with its second and third corner exchanged.
TestMesh moebius_double_cover(int resolution);

} // namespace geodisk::test
