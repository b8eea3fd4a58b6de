// Flat convex meshes: every distance is the straight line.
#include <cmath>

#include <doctest/doctest.h>

#include "ref/distance_check.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

/// On vertices, on edges, on borders and inside, near and far from them.
std::vector<Point> delicate_points(const TestMesh& mesh, std::uint32_t face_step) {
    std::vector<Point> points;
    for (std::uint32_t f = 0; f < mesh.face_count(); f += face_step) {
        for (const double w : {0.0, 1.0}) {
            points.push_back(face_point(f, w, 0));
        }
        points.push_back(face_point(f, 0, 1));
        points.push_back(face_point(f, 0.5, 0));
        points.push_back(face_point(f, 0.25, 0.75));
        points.push_back(face_point(f, 0, 0.125));
        points.push_back(face_point(f, 0.375, 0.25));
    }
    return points;
}

/// At 1e-3 to 6e-8 of an edge's length from a corner, and from the middle of an edge.
std::vector<Point> near_points(std::uint32_t face) {
    std::vector<Point> points;
    for (const double t : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 0x1p-24}) {
        points.push_back(face_point(face, t, t));
        points.push_back(face_point(face, t, 0));
        points.push_back(face_point(face, 1 - 2 * t, t));
        points.push_back(face_point(face, t, 1 - t));
        points.push_back(face_point(face, 0.5, t));
        points.push_back(face_point(face, t, 0.5));
        points.push_back(face_point(face, 0.5 - t, 0.5));
    }
    return points;
}

/// All pairs of delicate points, and from them to random points, at two reaches.
void check_flat(const std::string& name, const TestMesh& mesh, std::uint32_t face_step) {
    const PreparedMesh surface = prepared(mesh);
    std::vector<Point> targets = delicate_points(mesh, face_step);
    const std::vector<Point> sources = targets;
    const std::vector<Point> random = random_points(surface, 11, 400);
    targets.insert(targets.end(), random.begin(), random.end());
    const double diagonal = surface.statistics().diagonal;
    check_straight({name + ", whole", mesh, 1.01 * diagonal, sources, targets});
    check_straight({name + ", disk", mesh, 0.3 * diagonal, sources, targets});
    std::vector<Point> near;
    for (std::uint32_t f = 0; f < mesh.face_count(); f += 1 + mesh.face_count() / 6) {
        const std::vector<Point> some = near_points(f);
        near.insert(near.end(), some.begin(), some.end());
    }
    check_straight({name + ", near vertices and edges", mesh, 1.01 * diagonal, near, targets});
    check_straight({name + ", among near points", mesh, 0.3 * diagonal, near, near});
}

std::vector<double> even(int parts) {
    std::vector<double> lines;
    for (int i = 0; i <= parts; ++i) {
        lines.push_back(static_cast<double>(i) / parts);
    }
    return lines;
}

} // namespace

TEST_CASE("flat: regular grid") {
    check_flat("grid", flat_grid(9, 7, 1, 0.8), 5);
}

TEST_CASE("flat: irregular triangles") {
    check_flat("irregular", flat_irregular(10, 3), 9);
}

TEST_CASE("flat: obtuse fans where one window is cut by both children") {
    check_flat("obtuse fan", flat_obtuse_fan(6), 1);
    check_flat("coarse obtuse fan", flat_obtuse_fan(1), 1);
    check_flat("fine obtuse fan", flat_obtuse_fan(60), 13);
}

TEST_CASE("flat: needles of 1e-7") {
    check_flat("one band", flat_lines(even(6), {0, 0.4, 0.4 + 1e-7, 1}), 1);
    check_flat("crossing bands",
               flat_lines({0, 0.3, 0.3 + 1e-7, 0.8, 1}, {0, 0.4, 0.4 + 1e-7, 0.4 + 2e-7, 1}), 1);
    check_flat("along a border", flat_lines({0, 1e-7, 0.5, 1}, {0, 0.5, 1 - 1e-7, 1}), 1);
    TestMesh needle{{0, 0, 0, 1, 0, 0, 0.3, 1e-7, 0}, {0, 1, 2}};
    check_flat("one needle", needle, 1);
    check_flat("cut needle", subdivided(needle, 3), 3);
}

TEST_CASE("flat: large triangles, disks much smaller than them") {
    const TestMesh mesh = flat_grid(1, 1, 1, 1);
    const std::vector<Point> targets = random_points(prepared(mesh), 5, 20000);
    const std::vector<Point> sources(targets.begin(), targets.begin() + 60);
    check_straight({"square", mesh, 0.02, sources, targets});
    const TestMesh stretched = flat_grid(1, 1, 1, 0.001);
    const std::vector<Point> along = random_points(prepared(stretched), 5, 5000);
    check_straight({"strip", stretched, 0.01, {along.begin(), along.begin() + 40}, along});
}

TEST_CASE("flat: source and target on one edge") {
    for (const TestMesh& mesh : {flat_grid(4, 4, 1, 1), flat_irregular(5, 8), flat_obtuse_fan(3)}) {
        std::vector<Point> points;
        for (std::uint32_t f = 0; f < mesh.face_count(); f += 3) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                for (const double t : {0.0, 1e-7, 0.25, 0.5, 0.75, 1 - 1e-6, 1.0}) {
                    const double w[3] = {1 - t, t, 0};
                    points.push_back(face_point(f, w[(k + 1) % 3], w[(k + 2) % 3]));
                }
            }
        }
        check_straight({"on edges", mesh, 1.5, points, points});
    }
}

TEST_CASE("flat: source exactly on a vertex, on an edge, on a border") {
    const TestMesh mesh = flat_irregular(6, 21);
    const std::vector<Point> targets = random_points(prepared(mesh), 2, 1000);
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        check_straight({"vertex", mesh, 1.5, points_at_vertex(mesh, v), targets});
    }
}

TEST_CASE("flat: zero-length windows, rays that pass exactly through vertices") {
    const TestMesh mesh = flat_grid(8, 8, 8, 8);
    std::vector<Point> points;
    for (int i = 0; i <= 16; ++i) {
        for (int j = 0; j <= 16; ++j) {
            points.push_back(point_at(mesh, 0.5 * i, 0.5 * j));
        }
    }
    check_straight({"lattice", mesh, 12, points, points});
    check_straight({"lattice, disk", mesh, 2.75, points, points});
}
