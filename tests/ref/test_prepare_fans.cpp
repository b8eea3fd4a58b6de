// PreparedMesh: the corners around vertices, their order and their angles.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "constants.h"
#include "support/cone_meshes.hpp"
#include "support/meshes.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

constexpr double kStraightAngle = std::numbers::pi;
/// Angles are kept in units of 2^-13 radian.
constexpr double kUnits = 0x1p13;

std::span<const std::uint32_t> corners_of(const PreparedMesh& mesh, std::uint32_t v) {
    return mesh.corners().subspan(mesh.fans()[v].first_corner, mesh.fans()[v].corner_count);
}

bool is_regular(const VertexFan& fan) {
    return (fan.flags & gpu::kFanIrregular) == 0;
}
bool is_open(const VertexFan& fan) {
    return (fan.flags & gpu::kFanOpen) != 0;
}
bool bends(const VertexFan& fan) {
    return (fan.flags & gpu::kFanBends) != 0;
}

/// The two vertices beside a corner's own.
std::pair<std::uint32_t, std::uint32_t> sides(const PreparedMesh& mesh, std::uint32_t corner) {
    return {mesh.half_edges()[next_in_face(corner)].origin,
            mesh.half_edges()[previous_in_face(corner)].origin};
}

/// The half-edge of the corner's face that joins its vertex and `other`.
std::uint32_t side_to(const PreparedMesh& mesh, std::uint32_t corner, std::uint32_t other) {
    return sides(mesh, corner).first == other ? corner : previous_in_face(corner);
}

/// Returns true if the corners follow each other around the vertex: each is entered by the side
/// through which the one before was left.
bool in_rotational_order(const PreparedMesh& mesh, std::span<const std::uint32_t> corners,
                         bool open) {
    const auto follow = [&](std::uint32_t entered) {
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto [a, b] = sides(mesh, corners[i]);
            if (entered != a && entered != b) {
                return false;
            }
            const std::uint32_t left = entered == a ? b : a;
            const std::uint32_t h = side_to(mesh, corners[i], left);
            const std::uint32_t across = around_half_edge(mesh.half_edges()[h].around);
            const bool last = i + 1 == corners.size();
            if (open && last) {
                return across == h;
            }
            if (across / 3 != corners[last ? 0 : i + 1] / 3) {
                return false;
            }
            entered = left;
        }
        return true;
    };
    const auto [a, b] = sides(mesh, corners[0]);
    return follow(a) || follow(b);
}

double angle_of(const HalfEdge& edge) {
    return std::atan2(edge.angle().sine, edge.angle().cosine) * kUnits;
}

/// Starts and sizes of the corners cover their angles, rounded outwards by at most a unit.
void check_angles(const PreparedMesh& mesh, std::uint32_t v) {
    double start = 0;
    for (const std::uint32_t corner : corners_of(mesh, v)) {
        const HalfEdge& edge = mesh.half_edges()[corner];
        const double low = edge.fan_angles & 0xffffu;
        const double high = low + ((edge.fan_angles & ~gpu::kCornerTurned) >> 16);
        // Each corner counts in units of 2^-20.
        const double rounding = 0.01 * mesh.fans()[v].corner_count;
        REQUIRE(low <= start + rounding);
        REQUIRE(low >= start - 1 - rounding);
        start += angle_of(edge);
        REQUIRE(high >= start - rounding);
        REQUIRE(high <= start + 1 + rounding);
    }
    REQUIRE(std::abs(mesh.fans()[v].total_angle - start) <= 2);
}

struct FanCounts {
    std::uint32_t closed = 0, open = 0, irregular = 0;
    bool operator==(const FanCounts&) const = default;
};

/// Every corner is in its vertex's fan once; regular fans are in order and have their angles.
FanCounts check_fans(const TestMesh& mesh) {
    const PreparedMesh surface = prepared(mesh);
    FanCounts counts;
    std::set<std::uint32_t> seen;
    for (std::uint32_t v = 0; v < surface.vertex_count(); ++v) {
        const VertexFan& fan = surface.fans()[v];
        for (const std::uint32_t corner : corners_of(surface, v)) {
            REQUIRE(surface.half_edges()[corner].origin == v);
            REQUIRE(seen.insert(corner).second);
        }
        if (fan.corner_count == 0) {
            continue;
        }
        if (!is_regular(fan)) {
            ++counts.irregular;
            REQUIRE(fan.flags == (gpu::kFanIrregular | gpu::kFanBends));
            continue;
        }
        ++(is_open(fan) ? counts.open : counts.closed);
        REQUIRE(in_rotational_order(surface, corners_of(surface, v), is_open(fan)));
        check_angles(surface, v);
        const double needed = (is_open(fan) ? 1 : 2) * kStraightAngle * kUnits;
        REQUIRE((bends(fan) || fan.total_angle < needed));
        REQUIRE((!bends(fan) || fan.total_angle > needed - 10));
    }
    CHECK(seen.size() ==
          surface.half_edges().size() - 3 * surface.statistics().repeated_index_faces);
    return counts;
}

TestMesh with_flipped_faces(TestMesh mesh) {
    for (std::uint32_t f = 0; f < mesh.face_count(); f += 3) {
        std::swap(mesh.triangles[3 * f + 1], mesh.triangles[3 * f + 2]);
    }
    return mesh;
}

} // namespace

TEST_CASE("fans: closed, open and irregular ones, whatever the orientation") {
    const TestMesh strip = builtin("moebius", 4);
    const std::uint32_t rim = 2 * (strip.vertex_count() / 5);
    const std::pair<TestMesh, FanCounts> cases[] = {
        {builtin("icosphere", 2), {162, 0, 0}},
        {builtin("cube", 3), {56, 0, 0}},
        {two_sided_square(), {4, 0, 0}},
        {flat_grid(4, 3, 1, 1), {6, 14, 0}},
        {strip, {strip.vertex_count() - rim, rim, 0}},
        {{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}}, {0, 3, 0}}};
    for (const auto& [mesh, expected] : cases) {
        CHECK(check_fans(mesh) == expected);
        CHECK(check_fans(with_flipped_faces(mesh)) == expected);
    }
}

TEST_CASE("fans: shared meshes") {
    const std::map<std::string, FanCounts> expected = {
        {"meshes/bunny_1k4.obj", {702, 0, 0}},
        // Twelve vertices deep in folds have more than 8 radians around them.
        {"meshes/human_neutral_21k.obj", {10431, 32, 12}},
        {"coarse scan", {742, 0, 0}},
        {"holed scan", {3461, 105, 22}}, // As many are crumpled.
        {"assembly", {3252, 0, 68}},     // At edges of four faces.
        // Each pinched vertex is on the border twice, which has 416 edges.
        {"vessel", {2484, 416 - 2 * 37, 37}},
        {"bad/warn_bowtie_vertex.obj", {0, 4, 1}},
        {"bad/warn_bowtie_closed.obj", {6, 0, 1}},
        {"bad/warn_nonmanifold_edge.obj", {0, 3, 2}},
        {"bad/warn_unwelded.obj", {0, 240, 0}},
        {"bad/warn_repeated_index.obj", {42, 0, 0}}};
    std::vector<std::string> names{"meshes/teapot_6k.obj", "meshes/cycloidal_43k.ply"};
    for (const auto& [name, counts] : expected) {
        if (name.find('/') != std::string::npos) {
            names.push_back(name);
        }
    }
    for (const NamedMesh& one : meshes_like(names)) {
        CAPTURE(one.name);
        const FanCounts found = check_fans(one.mesh);
        if (const auto known = expected.find(one.name); known != expected.end()) {
            CHECK(found.closed == known->second.closed);
            CHECK(found.open == known->second.open);
            CHECK(found.irregular == known->second.irregular);
        }
        CHECK(check_fans(with_flipped_faces(one.mesh)) == found);
    }
}

TEST_CASE("fans: angles known by hand") {
    const PreparedMesh cube = prepared(builtin("cube", 1));
    for (const VertexFan& fan : cube.fans()) {
        CHECK(std::abs(fan.total_angle - 1.5 * kStraightAngle * kUnits) <= 1);
        CHECK_FALSE(bends(fan));
        CHECK_FALSE(is_open(fan));
    }
    const PreparedMesh grid = prepared(flat_grid(2, 2, 1, 1));
    for (std::uint32_t v = 0; v < 9; ++v) {
        const VertexFan& fan = grid.fans()[v];
        const double right_angles = v == 4 ? 4 : (v % 2 == 0 ? 1 : 2);
        CHECK(std::abs(fan.total_angle - right_angles * kStraightAngle / 2 * kUnits) <= 1);
        CHECK(is_open(fan) == (v != 4));
        CHECK(bends(fan) == (v % 2 == 1 || v == 4));
    }
    // Two triangles at one vertex: no order, and paths pass through.
    if (const auto tie = shared_mesh("bad/warn_bowtie_vertex.obj")) {
        const PreparedMesh surface = prepared(*tie);
        std::uint32_t irregular = 0;
        for (const VertexFan& fan : surface.fans()) {
            irregular += is_regular(fan) ? 0u : 1u;
            CHECK((is_regular(fan) || (fan.corner_count == 2 && bends(fan))));
        }
        CHECK(irregular == 1);
    }
}

TEST_CASE("fans: cones of any angle") {
    for (const double angle : {0.3, 3.0, 6.0, 2 * kStraightAngle, 6.3, 7.9}) {
        const Cone cone(16, angle, angle < 1 ? 0 : 0.05, 1);
        check_fans(cone.mesh());
        const PreparedMesh surface = prepared(cone.mesh());
        const VertexFan& apex = surface.fans()[0];
        CHECK(is_regular(apex));
        CHECK(std::abs(apex.total_angle - angle * kUnits) <= 2);
        CHECK(bends(apex) == (angle >= 2 * kStraightAngle - 1e-9));
    }
    // More than fits 16 bits.
    const VertexFan wide = prepared(Cone(24, 8.1, 0.05, 1).mesh()).fans()[0];
    CHECK_FALSE(is_regular(wide));
    CHECK(bends(wide));
}

TEST_CASE("fans: around a corner almost on the opposite side there is no order") {
    for (const double height : {0x1p-14, 0x1p-16, 1e-9, 0.0}) {
        TestMesh mesh;
        for (const Vec3& p : {Vec3{-1, 0, 0}, Vec3{1, 0, 0}, Vec3{0, height, 0}, Vec3{0, 1, 0}}) {
            mesh.add_vertex(p);
        }
        mesh.triangles = {0, 1, 2, 2, 1, 3, 2, 3, 0};
        const PreparedMesh surface = prepared(mesh);
        CHECK(is_regular(surface.fans()[2]) == (height > 0x1p-15));
        for (const std::uint32_t v : {0u, 1u, 3u}) {
            CHECK(is_regular(surface.fans()[v]));
        }
    }
}

TEST_CASE("fans: next to a side of almost no length there is no order") {
    for (const double gap : {0x1p-15, 0x1p-16, 1e-9}) {
        const TestMesh mesh = flat_lines({0, gap, 1}, {0, 1});
        const PreparedMesh surface = prepared(mesh);
        const bool too_short = gap <= 0x1p-16;
        for (std::uint32_t v = 0; v < 6; ++v) {
            const bool beside = v % 3 != 2;
            CHECK(is_regular(surface.fans()[v]) == !(too_short && beside));
        }
        check_fans(mesh);
    }
    // Two vertices in one place.
    const TestMesh split{{0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 2, 3, 0, 1, 2}};
    const PreparedMesh surface = prepared(split);
    CHECK_FALSE(is_regular(surface.fans()[0]));
    CHECK_FALSE(is_regular(surface.fans()[1]));
    CHECK(is_regular(surface.fans()[3]));
    CHECK(surface.statistics().zero_area_faces == 1);
}
