#include "support/cap_meshes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace geodisk::test {
namespace {

constexpr std::uint32_t kMaxFaces = 30;

double coordinate(const Choose& choose) {
    return static_cast<double>(choose(9)) / 4 - 1;
}

/// 0, or 1e-3 to 1e-18.
double height(const Choose& choose) {
    const std::uint32_t digits = choose(20);
    return digits < 3 ? 0 : (1 + choose(9)) * std::pow(10.0, -static_cast<double>(digits));
}

/// Returns the place where an edge is cut.
double part(const Choose& choose) {
    constexpr std::array<double, 8> kParts{0.5, 0.25, 0.75, 1 / 3.0, 0.1, 0.6, 0.9, 0.4};
    if (choose(8) == 0) {
        const double near_end = std::max(height(choose), 1e-12);
        return choose(2) == 0 ? near_end : 1 - near_end;
    }
    return kParts[choose(kParts.size())];
}

void add_fan(TestMesh& mesh, const Choose& choose) {
    const std::uint32_t spokes = 3 + choose(6);
    const bool is_closed = choose(3) != 0;
    const std::uint32_t center = mesh.add_vertex({0, 0, 0});
    for (std::uint32_t i = 0; i < spokes; ++i) {
        const double angle = 2 * std::numbers::pi * i / spokes;
        mesh.add_vertex({std::cos(angle), std::sin(angle), coordinate(choose)});
    }
    for (std::uint32_t i = 0; i + (is_closed ? 0 : 1) < spokes; ++i) {
        mesh.add_triangle(center, center + 1 + i, center + 1 + (i + 1) % spokes);
    }
}

void add_sheet(TestMesh& mesh, const Choose& choose) {
    const std::uint32_t columns = 1 + choose(2), rows = 1 + choose(2);
    const bool is_bent = choose(4) != 0;
    for (std::uint32_t j = 0; j <= rows; ++j) {
        for (std::uint32_t i = 0; i <= columns; ++i) {
            mesh.add_vertex(
                {static_cast<double>(i), static_cast<double>(j), is_bent ? coordinate(choose) : 0});
        }
    }
    for (std::uint32_t j = 0; j < rows; ++j) {
        for (std::uint32_t i = 0; i < columns; ++i) {
            const std::uint32_t v = j * (columns + 1) + i, w = v + columns + 1;
            mesh.add_triangle(v, v + 1, w + 1);
            mesh.add_triangle(v, w + 1, w);
        }
    }
}

void add_tetrahedron(TestMesh& mesh, const Choose& choose) {
    for (int i = 0; i < 4; ++i) {
        const double x = coordinate(choose), y = coordinate(choose);
        mesh.add_vertex({x, y, coordinate(choose)});
    }
    mesh.add_triangle(0, 1, 2);
    mesh.add_triangle(0, 3, 1);
    mesh.add_triangle(1, 3, 2);
    mesh.add_triangle(2, 3, 0);
}

void add_any_triangles(TestMesh& mesh, const Choose& choose) {
    const std::uint32_t vertices = 4 + choose(5), faces = 3 + choose(6);
    for (std::uint32_t v = 0; v < vertices; ++v) {
        const double x = coordinate(choose), y = coordinate(choose);
        mesh.add_vertex({x, y, coordinate(choose)});
    }
    for (std::uint32_t f = 0; f < faces; ++f) {
        const std::uint32_t a = choose(vertices), b = choose(vertices), c = choose(vertices);
        if (a != b && b != c && c != a) {
            mesh.add_triangle(a, b, c);
        }
    }
}

/// Cuts an edge of a face at a new vertex, which is a little off it, and mostly fills the gap.
void cut_edge(TestMesh& mesh, std::uint32_t face, std::uint32_t k, const Choose& choose) {
    std::uint32_t* const corners = &mesh.triangles[std::size_t{3} * face];
    const std::uint32_t a = corners[k], b = corners[(k + 1) % 3], d = corners[(k + 2) % 3];
    const double t = part(choose), off = height(choose);
    Vec3 place = (1 - t) * mesh.vertex(a) + t * mesh.vertex(b);
    const std::uint32_t axis = choose(3);
    (axis == 0 ? place.x : axis == 1 ? place.y : place.z) += choose(2) == 0 ? off : -off;
    const std::uint32_t c = mesh.add_vertex(place);
    corners[(k + 1) % 3] = c;
    mesh.add_triangle(c, b, d);
    if (choose(8) != 0) {
        mesh.add_triangle(c, a, b);
    }
}

/// Returns true if corners of a face are at one place.
bool has_two_corners(const TestMesh& mesh, std::uint32_t face) {
    const auto is_short = [&](std::uint32_t k) {
        return mesh.corner(face, k) == mesh.corner(face, (k + 1) % 3);
    };
    return is_short(0) || is_short(1) || is_short(2);
}

void turn(TestMesh& mesh, double angle) {
    const double cosine = std::cos(angle), sine = std::sin(angle);
    for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
        double* const p = &mesh.positions[i];
        const double x = cosine * p[0] - sine * p[1], y = sine * p[0] + cosine * p[1];
        p[0] = cosine * x - sine * p[2];
        p[1] = y;
        p[2] = sine * x + cosine * p[2];
    }
}

} // namespace

TestMesh cap_mesh(const Choose& choose) {
    TestMesh mesh;
    const std::uint32_t kind = choose(8);
    (kind < 3   ? add_fan
     : kind < 6 ? add_sheet
     : kind < 7 ? add_tetrahedron
                : add_any_triangles)(mesh, choose);
    if (mesh.triangles.empty()) {
        mesh.add_triangle(0, 1, 2);
    }
    const std::uint32_t cuts = 1 + choose(7);
    for (std::uint32_t i = 0; i < cuts && mesh.face_count() + 2 <= kMaxFaces; ++i) {
        // Often one of the last, for chains.
        const std::uint32_t faces = mesh.face_count();
        const std::uint32_t face =
            choose(2) == 0 ? choose(faces) : faces - 1 - choose(std::min(faces, 3u));
        const std::uint32_t k = choose(3);
        if (choose(10) == 0) {
            const double x = coordinate(choose), y = coordinate(choose);
            const std::uint32_t c = mesh.add_vertex({x, y, coordinate(choose)});
            const std::uint32_t* const corners = &mesh.triangles[std::size_t{3} * face];
            mesh.add_triangle(corners[k], corners[(k + 1) % 3], c);
        } else {
            cut_edge(mesh, face, k, choose);
        }
    }
    if (choose(4) == 0) {
        turn(mesh, choose(256) / 40.0);
    }
    return mesh;
}

Point point_of(const TestMesh& mesh, const Choose& choose) {
    std::uint32_t face = choose(mesh.face_count());
    for (std::uint32_t i = 0; i < mesh.face_count() && has_two_corners(mesh, face); ++i) {
        face = (face + 1) % mesh.face_count();
    }
    if (choose(3) == 0) {
        const double a = choose(9) / 8.0, b = choose(9) / 8.0;
        return face_point(face, a + b > 1 ? 1 - a : a, a + b > 1 ? 1 - b : b);
    }
    const double a = (choose(256) + choose(256) / 256.0) / 256;
    const double b = (choose(256) + choose(256) / 256.0) / 256;
    return face_point(face, a + b > 1 ? 1 - a : a, a + b > 1 ? 1 - b : b);
}

} // namespace geodisk::test
