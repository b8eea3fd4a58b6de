// Each generated surface has what the real meshes that it stands for have.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "mesh_facts.hpp"
#include "shapes/builtin_shapes.hpp"
#include "support/stand_in_meshes.hpp"

using namespace geodisk::tools;
using geodisk::test::KnownMesh;
using geodisk::test::stand_in;
using geodisk::test::stand_ins;
using geodisk::test::StandIn;

namespace {

constexpr double kDegree = 3.14159265358979 / 180;

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The triangles at each edge.
std::map<Edge, std::vector<std::size_t>> edges_of(const MeshFile& mesh) {
    std::map<Edge, std::vector<std::size_t>> edges;
    for (std::size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
        const std::uint32_t next = mesh.triangles[corner / 3 * 3 + (corner + 1) % 3];
        edges[std::minmax(mesh.triangles[corner], next)].push_back(corner / 3);
    }
    return edges;
}

Vec3 corner_of(const MeshFile& mesh, std::size_t triangle, std::size_t k) {
    return position_at(mesh, mesh.triangles[3 * triangle + k % 3]);
}

Vec3 normal_of(const MeshFile& mesh, std::size_t triangle) {
    const Vec3 a = corner_of(mesh, triangle, 0);
    return cross(corner_of(mesh, triangle, 1) - a, corner_of(mesh, triangle, 2) - a);
}

/// Properties that make a surface hard.
struct Hardness {
    std::size_t border_loops = 0;
    double slivers = 0;        ///< Share of triangles over 20 times as long as high.
    double uneven = 0;         ///< Longest edge by the shortest one.
    double irregular = 0;      ///< Share of vertices inside that have other than six neighbours.
    double bend = 0;           ///< Mean angle between neighbours, in degrees.
    double sharp = 0;          ///< Share of edges that bend by over 60 degrees.
    double flat = 0;           ///< Share of edges that bend by less than 0.001 degrees.
    double thickness = 0;      ///< Volume by half of the area, by the mean edge.
    std::size_t wide_fans = 0; ///< Vertices with more than 8 radians around them.
};

Hardness hardness_of(const MeshFile& mesh) {
    Hardness found;
    const auto edges = edges_of(mesh);
    const std::size_t vertices = mesh.positions.size() / 3;
    std::vector<std::size_t> neighbours(vertices);
    std::set<std::uint32_t> on_border;
    Groups loops(vertices);
    double shortest = std::numeric_limits<double>::max(), longest = 0, total = 0;
    std::size_t inner = 0;
    for (const auto& [ends, triangles] : edges) {
        const double edge = length(position_at(mesh, ends.first) - position_at(mesh, ends.second));
        shortest = std::min(shortest, edge);
        longest = std::max(longest, edge);
        total += edge;
        ++neighbours[ends.first];
        ++neighbours[ends.second];
        if (triangles.size() == 1) {
            on_border.insert({ends.first, ends.second});
            loops.join(ends.first, ends.second);
        }
        if (triangles.size() == 2) {
            const Vec3 a = normal_of(mesh, triangles[0]), b = normal_of(mesh, triangles[1]);
            const double bend = std::atan2(length(cross(a, b)), dot(a, b)) / kDegree;
            ++inner;
            found.bend += bend;
            found.sharp += bend > 60 ? 1 : 0;
            found.flat += bend < 1e-3 ? 1 : 0;
        }
    }
    found.bend /= static_cast<double>(inner);
    found.sharp /= static_cast<double>(inner);
    found.flat /= static_cast<double>(inner);
    found.uneven = longest / shortest;
    for (const std::uint32_t vertex : on_border) {
        found.border_loops += loops.find(vertex) == vertex ? 1u : 0u;
    }
    double volume = 0;
    std::vector<double> angles(vertices, 0.0);
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        found.slivers += flatness(mesh, t) < 1.0 / 40 ? 1 : 0;
        volume += dot(corner_of(mesh, t, 0), normal_of(mesh, t)) / 6;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 u = corner_of(mesh, t, k + 1) - corner_of(mesh, t, k);
            const Vec3 v = corner_of(mesh, t, k + 2) - corner_of(mesh, t, k);
            angles[mesh.triangles[3 * t + k]] += std::atan2(length(cross(u, v)), dot(u, v));
        }
    }
    found.slivers /= static_cast<double>(mesh.triangle_count());
    found.thickness = volume / (total_area(mesh) / 2) / (total / static_cast<double>(edges.size()));
    std::size_t inside = 0;
    for (std::uint32_t v = 0; v < vertices; ++v) {
        found.wide_fans += angles[v] > 8 ? 1u : 0u;
        if (neighbours[v] > 0 && !on_border.contains(v)) {
            ++inside;
            found.irregular += neighbours[v] != 6 ? 1 : 0;
        }
    }
    found.irregular /= static_cast<double>(inside);
    return found;
}

/// Returns true if an edge of one triangle passes through another one.
bool passes_through(const MeshFile& mesh, std::size_t one, std::size_t other) {
    const auto volume = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        return dot(cross(b - a, c - a), d - a);
    };
    const Vec3 a = corner_of(mesh, other, 0), b = corner_of(mesh, other, 1),
               c = corner_of(mesh, other, 2);
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 p = corner_of(mesh, one, k), q = corner_of(mesh, one, k + 1);
        const double sides[] = {volume(p, q, a, b), volume(p, q, b, c), volume(p, q, c, a)};
        const bool is_within = (sides[0] > 0 && sides[1] > 0 && sides[2] > 0) ||
                               (sides[0] < 0 && sides[1] < 0 && sides[2] < 0);
        if (is_within && volume(a, b, c, p) * volume(a, b, c, q) < 0) {
            return true;
        }
    }
    return false;
}

/// The parts that run through another one.
std::size_t crossing_parts(const MeshFile& mesh) {
    Groups parts(mesh.positions.size() / 3);
    for (std::size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
        parts.join(mesh.triangles[corner / 3 * 3], mesh.triangles[corner]);
    }
    std::set<std::size_t> crossing;
    for (std::size_t one = 0; one < mesh.triangle_count(); ++one) {
        const std::size_t part = parts.find(mesh.triangles[3 * one]);
        for (std::size_t other = 0; other < mesh.triangle_count() && !crossing.contains(part);
             ++other) {
            const std::size_t other_part = parts.find(mesh.triangles[3 * other]);
            if (other_part != part && passes_through(mesh, one, other)) {
                crossing.insert({part, other_part});
            }
        }
    }
    return crossing.size();
}

} // namespace

TEST_CASE("stand-ins: their table is right, and they are made alike each time") {
    for (const StandIn& one : stand_ins()) {
        CAPTURE(one.known.name);
        const MeshFile mesh = one.make();
        const KnownMesh& known = one.known;
        const MeshFacts facts = measure(mesh);
        CHECK(facts.vertices - facts.unused_vertices == known.vertices);
        CHECK(facts.triangles == known.triangles);
        CHECK(facts.border_edges == known.border_edges);
        CHECK(facts.components == known.components);
        CHECK(facts.crowded_edges == known.crowded_edges);
        CHECK(facts.flattest > 1e-6);
        CHECK(total_area(mesh) == doctest::Approx(known.area).epsilon(6e-5));
        CHECK(one.make().positions == mesh.positions);
    }
}

TEST_CASE("stand-ins: scans are noisy, uneven, irregular and of the genus they should have") {
    struct Scan {
        const char* name;
        std::ptrdiff_t euler_characteristic; ///< Euler characteristic of all parts.
        std::size_t border_loops;
    };
    for (const Scan& scan :
         {Scan{"coarse scan", 2, 0}, Scan{"scan", 2, 0}, Scan{"twisted scan", 2, 0},
          Scan{"holed scan", 2 - 5 + 2 * 2, 5}, Scan{"lattice scan", 2 - 2 * 81, 0},
          Scan{"terrain scan", 1, 1}, Scan{"thin shell", 2, 0}}) {
        CAPTURE(scan.name);
        const MeshFile mesh = stand_in(scan.name).make();
        const MeshFacts facts = measure(mesh);
        const Hardness hardness = hardness_of(mesh);
        CHECK(facts.euler_characteristic == scan.euler_characteristic);
        CHECK(hardness.border_loops == scan.border_loops);
        CHECK(facts.crowded_edges + facts.clashing_edges + facts.pinched_vertices == 0);
        CHECK(hardness.bend > 9);
        CHECK(hardness.uneven > 9);
        CHECK(hardness.irregular > 0.4);
    }
    // Without noise, a sphere of as many triangles bends by a third of that.
    CHECK(hardness_of(make_builtin("icosphere", 4)).bend < 4);
}

TEST_CASE("stand-ins: the holed scan has unused vertices, crumpled places and parts that cross") {
    const MeshFile mesh = stand_in("holed scan").make();
    CHECK(measure(mesh).unused_vertices > 50);
    CHECK(hardness_of(mesh).wide_fans >= 10);
    CHECK(crossing_parts(mesh) == 3);
}

TEST_CASE("stand-ins: the twisted scan is the scan in another pose") {
    const MeshFile rest = stand_in("scan").make();
    const MeshFile pose = stand_in("twisted scan").make();
    CHECK(pose.triangles == rest.triangles);
    double least = 1, most = 1;
    for (const auto& [ends, triangles] : edges_of(rest)) {
        const auto edge = [&, a = ends.first, b = ends.second](const MeshFile& mesh) {
            return length(position_at(mesh, a) - position_at(mesh, b));
        };
        const double stretch = edge(pose) / edge(rest);
        least = std::min(least, stretch);
        most = std::max(most, stretch);
    }
    CHECK(least < 0.7);
    CHECK(most > 1.7);
}

TEST_CASE("stand-ins: bars and shells are thinner than their edges are long") {
    CHECK(hardness_of(stand_in("lattice scan").make()).thickness < 0.7);
    CHECK(hardness_of(stand_in("thin shell").make()).thickness < 0.4);
    CHECK(hardness_of(stand_in("slivers").make()).thickness < 0.2);
}

TEST_CASE("stand-ins: parts as of CAD have flat sides, sharp creases and slivers") {
    struct Part {
        const char* name;
        std::ptrdiff_t euler_characteristic;
        double flat, sharp, slivers, uneven; ///< At least.
    };
    for (const Part& part : {Part{"bracket", 0, 0.9, 0.01, 0.005, 50},
                             Part{"slivers", 2 - 2 * 20, 0.5, 0.3, 0.4, 500}}) {
        CAPTURE(part.name);
        const MeshFile mesh = stand_in(part.name).make();
        const Hardness hardness = hardness_of(mesh);
        CHECK(measure(mesh).is_closed_manifold());
        CHECK(measure(mesh).euler_characteristic == part.euler_characteristic);
        CHECK(hardness.flat > part.flat);
        CHECK(hardness.sharp > part.sharp);
        CHECK(hardness.slivers > part.slivers);
        CHECK(hardness.uneven > part.uneven);
    }
}

TEST_CASE("stand-ins: many parts run through each other, touch, or hang together at vertices") {
    const MeshFile assembly = stand_in("assembly").make();
    CHECK(measure(assembly).components == 21);
    CHECK(measure(assembly).crowded_edges > 50);
    CHECK(crossing_parts(assembly) == 21);
    CHECK(hardness_of(assembly).slivers > 0.05);
    const MeshFile vessel = stand_in("vessel").make();
    CHECK(measure(vessel).components == 4);
    CHECK(measure(vessel).pinched_vertices == 37);
    CHECK(crossing_parts(vessel) == 4);
}
