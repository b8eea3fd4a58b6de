#include "support/stand_in_meshes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/angles.hpp"
#include "geometry/edge_edits.hpp"
#include "geometry/polygon_triangulation.hpp"
#include "shapes/builtin_shapes.hpp"
#include "shapes/shape_makers.hpp"

namespace geodisk::test {
namespace {

using tools::add_vertex;
using tools::MeshFile;
using tools::point_at;
using tools::Vec2;
using tools::Vec3;

/// Random numbers that are the same everywhere (SplitMix64).
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : state_(seed) {}

    std::uint64_t throw_word() {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t word = state_;
        word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9u;
        word = (word ^ (word >> 27)) * 0x94d049bb133111ebu;
        return word ^ (word >> 31);
    }
    /// From -1 to 1.
    double throw_number() { return static_cast<double>(throw_word() >> 11) * 0x1p-52 - 1; }
    Vec3 throw_vector() {
        const double x = throw_number();
        const double y = throw_number();
        return {x, y, throw_number()};
    }

  private:
    std::uint64_t state_;
};

Vec3 corner_at(const MeshFile& mesh, std::size_t triangle, std::size_t k) {
    return point_at(mesh.positions, mesh.triangles[3 * triangle + k % 3]);
}

void move_to(MeshFile& mesh, std::size_t vertex, const Vec3& place) {
    for (int axis = 0; axis < 3; ++axis) {
        mesh.positions[3 * vertex + static_cast<std::size_t>(axis)] = place[axis];
    }
}

template <typename Change>
void move_all(MeshFile& mesh, const Change& change) {
    for (std::size_t v = 0; v < mesh.positions.size() / 3; ++v) {
        move_to(mesh, v, change(point_at(mesh.positions, v)));
    }
}

void append(MeshFile& mesh, const MeshFile& part) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size() / 3);
    mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
    for (const std::uint32_t vertex : part.triangles) {
        mesh.triangles.push_back(first + vertex);
    }
}

/// Splits the longest edge of a triangle, not quite in its middle.
void split_longest(const MeshFile& mesh, tools::EdgeEdits& edits, std::size_t triangle,
                   Dice& dice) {
    std::size_t longest = 0;
    const auto edge = [&](std::size_t k) {
        return corner_at(mesh, triangle, k + 1) - corner_at(mesh, triangle, k);
    };
    for (std::size_t k = 1; k < 3; ++k) {
        longest = length(edge(k)) > length(edge(longest)) ? k : longest;
    }
    const Vec3 place =
        corner_at(mesh, triangle, longest) + (0.5 + 0.1 * dice.throw_number()) * edge(longest);
    edits.split(mesh.triangles[3 * triangle + longest],
                mesh.triangles[3 * triangle + (longest + 1) % 3], place);
}

/// Flips edges to make triangles rounder, where the surface bends by less than an angle of this
/// cosine.
void flip_edges(MeshFile& mesh, tools::EdgeEdits& edits, double flat) {
    const auto at = [&](std::uint32_t vertex) { return point_at(mesh.positions, vertex); };
    const auto normal = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        return cross(at(b) - at(a), at(c) - at(a));
    };
    const auto cotangent = [&](std::uint32_t apex, std::uint32_t a, std::uint32_t b) {
        return dot(at(a) - at(apex), at(b) - at(apex)) / length(normal(apex, a, b));
    };
    std::size_t flips_left = 4 * mesh.triangle_count(); // In case that they go round in circles.
    edits.flip_all([&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        if (flips_left == 0 || edits.has_edge(c, d) ||
            cotangent(c, a, b) + cotangent(d, b, a) > -1e-9) {
            return false;
        }
        const Vec3 normals[] = {normal(a, b, c), normal(b, a, d), normal(a, d, c), normal(d, b, c)};
        for (const Vec3& one : normals) {
            for (const Vec3& other : normals) {
                if (dot(one, other) <= flat * length(one) * length(other)) {
                    return false;
                }
            }
        }
        --flips_left;
        return true;
    });
}

/// Makes a mesh as a scanner leaves it: triangles of all sizes, `splits` more, and vertices moved
/// by up to `noise` of their shortest edge along each axis.
void roughen(MeshFile& mesh, std::uint64_t seed, std::size_t splits, double noise) {
    Dice dice(seed);
    tools::EdgeEdits edits(mesh);
    for (std::size_t i = 0; i < splits; ++i) {
        split_longest(mesh, edits, dice.throw_word() % mesh.triangle_count(), dice);
    }
    std::vector<double> shortest(mesh.positions.size() / 3, std::numeric_limits<double>::max());
    for (std::size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
        const double edge =
            length(corner_at(mesh, corner / 3, corner + 1) - corner_at(mesh, corner / 3, corner));
        for (const std::size_t end : {corner, corner / 3 * 3 + (corner + 1) % 3}) {
            double& least = shortest[mesh.triangles[end]];
            least = std::min(least, edge);
        }
    }
    for (std::size_t v = 0; v < shortest.size(); ++v) {
        move_to(mesh, v, point_at(mesh.positions, v) + noise * shortest[v] * dice.throw_vector());
    }
    flip_edges(mesh, edits, 0.7);
}

/// Direction of something from the middle of a body, and the cosine of how far around it reaches.
struct Spot {
    Vec3 way;
    double cosine;

    /// From 1 in its middle to 0 at its border and beyond.
    double depth(const Vec3& place) const {
        const double depth = (dot(normalize(place), normalize(way)) - cosine) / (1 - cosine);
        return std::max(depth, 0.0);
    }
};

/// A body with two ears, a snout, two feet and a dent below.
MeshFile body(int steps) {
    constexpr std::pair<Spot, double> kBumps[] = {
        {{{0.4, 0.3, 0.9}, 0.93}, 0.9},   {{{-0.4, 0.3, 0.9}, 0.93}, 0.9},
        {{{0, -1, 0.3}, 0.85}, 0.4},      {{{0.5, -0.4, -0.8}, 0.9}, 0.6},
        {{{-0.5, -0.4, -0.8}, 0.9}, 0.6}, {{{0, 0.5, -0.8}, 0.7}, -0.4}};
    MeshFile mesh = tools::make_icosphere(steps);
    move_all(mesh, [&](const Vec3& p) {
        double radius = 1;
        for (const auto& [spot, height] : kBumps) {
            const double t = spot.depth(p);
            radius += height * t * t * (3 - 2 * t);
        }
        return radius * p;
    });
    return mesh;
}

MeshFile make_coarse_scan() {
    MeshFile mesh = body(3);
    roughen(mesh, 1, 100, 0.2);
    return mesh;
}

MeshFile make_scan() {
    MeshFile mesh = body(4);
    roughen(mesh, 2, 1000, 0.2);
    return mesh;
}

/// In another pose, with edges stretched and pressed.
MeshFile make_twisted_scan() {
    MeshFile mesh = make_scan();
    move_all(mesh, [](const Vec3& p) {
        const double turn = 0.7 * p.z;
        const double cosine = tools::cosine(turn);
        const double sine = tools::sine(turn);
        return Vec3{cosine * p.x - sine * p.y, 1.3 * (sine * p.x + cosine * p.y),
                    p.z + 0.3 * p.x * p.x};
    });
    return mesh;
}

/// Moves the neighbours of a vertex up and down in turn, so that there is more surface around it
/// than a plane has.
void crumple(MeshFile& mesh, std::uint32_t vertex) {
    std::map<std::uint32_t, std::uint32_t> next; // Around it.
    for (std::size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
        if (mesh.triangles[corner] == vertex) {
            const std::size_t first = corner / 3 * 3;
            next[mesh.triangles[first + (corner + 1) % 3]] =
                mesh.triangles[first + (corner + 2) % 3];
        }
    }
    const Vec3 middle = point_at(mesh.positions, vertex);
    std::uint32_t other = next.begin()->first;
    for (std::size_t i = 0; i < next.size(); ++i, other = next.at(other)) {
        const Vec3 place = point_at(mesh.positions, other);
        const double height = (i % 2 == 0 ? 0.9 : -0.9) * length(place - middle);
        move_to(mesh, other, place + height * normalize(middle));
    }
}

/// A scan with five holes, unused vertices in them, crumpled places, and two eyeballs of their own.
MeshFile make_holed_scan() {
    constexpr Spot kHoles[] = {{{0, 0, -1}, 0.96},
                               {{0.1, 1, 0.1}, 0.98},
                               {{-1, 0.2, 0}, 0.985},
                               {{0, -1, 0.5}, 0.99},
                               {{0.9, 0.5, -0.4}, 0.995}};
    MeshFile mesh = body(4);
    roughen(mesh, 3, 800, 0.2);
    for (std::uint32_t vertex = 200; vertex <= 2400; vertex += 200) {
        crumple(mesh, vertex);
    }
    std::vector<std::uint32_t> kept;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const Vec3 middle = corner_at(mesh, t, 0) + corner_at(mesh, t, 1) + corner_at(mesh, t, 2);
        if (std::none_of(std::begin(kHoles), std::end(kHoles),
                         [&](const Spot& hole) { return hole.depth(middle) > 0; })) {
            kept.insert(kept.end(), {mesh.triangles[3 * t], mesh.triangles[3 * t + 1],
                                     mesh.triangles[3 * t + 2]});
        }
    }
    mesh.triangles = std::move(kept);
    for (const double x : {-0.4, 0.4}) {
        MeshFile eye = tools::make_icosphere(2);
        move_all(eye, [&](const Vec3& p) { return 0.15 * p + Vec3{x, -0.9, 0.5}; });
        append(mesh, eye);
    }
    return mesh;
}

MeshFile make_lattice_scan() {
    MeshFile mesh = tools::make_lattice(1);
    roughen(mesh, 4, 500, 0.15);
    return mesh;
}

MeshFile make_terrain_scan() {
    MeshFile mesh = tools::make_terrain(40);
    roughen(mesh, 5, 800, 0.2);
    return mesh;
}

/// A plate that is thinner than its edges are long, rolled up in layers nearly as close.
MeshFile make_thin_shell() {
    MeshFile mesh = tools::make_plate(40);
    roughen(mesh, 6, 500, 0.08);
    move_all(mesh, [](const Vec3& p) {
        const double turns = 1.5 * (p.x + 0.5);
        const double radius = 0.1 + 0.03 * turns + p.z;
        const double turn = 2 * tools::kPi * turns;
        return Vec3{radius * tools::sine(turn), p.y, radius * tools::cosine(turn)};
    });
    return mesh;
}

/// The points of a part of a circle, counter-clockwise.
std::vector<Vec2> arc(const Vec2& middle, double radius, double first_turn, double last_turn,
                      std::uint32_t parts) {
    std::vector<Vec2> points;
    for (std::uint32_t i = 0; i <= parts; ++i) {
        const double turn = 2 * tools::kPi * (first_turn + (last_turn - first_turn) * i / parts);
        points.push_back(middle + radius * Vec2(tools::cosine(turn), tools::sine(turn)));
    }
    return points;
}

/// A prism between z = 0 and `height` over an outline with a hole, both counter-clockwise. The
/// first corner of the outline sees the last one of the hole.
MeshFile drilled_prism(const std::vector<Vec2>& outline, const std::vector<Vec2>& hole,
                       double height) {
    MeshFile mesh;
    std::vector<std::vector<std::uint32_t>> rings(2);
    for (const Vec2& p : outline) {
        rings[0].push_back(add_vertex(mesh, {p.x, p.y, height}));
    }
    for (std::size_t i = hole.size(); i-- > 0;) {
        rings[1].push_back(add_vertex(mesh, {hole[i].x, hole[i].y, height}));
    }
    std::vector<std::uint32_t> polygon = rings[0];
    polygon.push_back(rings[0][0]);
    polygon.insert(polygon.end(), rings[1].begin(), rings[1].end());
    polygon.push_back(rings[1][0]);
    tools::triangulate_polygon(mesh.positions, polygon, mesh.triangles);
    tools::close_below(mesh, rings, 0);
    return mesh;
}

/// A part with sharp straight and curved creases, and a bore; triangles are small around that.
MeshFile make_bracket() {
    std::vector<Vec2> outline = arc({0, 0}, 0.5, 0.5, 0.75, 12);
    for (const auto& more :
         {std::vector<Vec2>{{2, -0.5}, {2, 0}}, arc({1, 0.5}, 0.5, 0.75, 0.5, 12),
          std::vector<Vec2>{{0.5, 1.5}, {-0.5, 1.5}}}) {
        outline.insert(outline.end(), more.begin(), more.end());
    }
    std::vector<Vec2> bore = arc({0, 0}, 0.3, 0.5, 1.5, 36);
    bore.pop_back();
    MeshFile mesh = drilled_prism(outline, bore, 0.6);
    Dice dice(7);
    tools::EdgeEdits edits(mesh);
    const auto is_long = [&](std::size_t t) {
        double longest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            longest = std::max(longest, length(corner_at(mesh, t, k + 1) - corner_at(mesh, t, k)));
        }
        return longest > 0.06 + 0.07 * length(Vec2(corner_at(mesh, t, 0)));
    };
    for (std::size_t before = 0; before != mesh.triangle_count();) {
        flip_edges(mesh, edits, 0.9999);
        before = mesh.triangle_count();
        for (std::size_t t = 0; t < before; ++t) {
            if (is_long(t)) {
                split_longest(mesh, edits, t, dice);
            }
        }
    }
    return mesh;
}

MeshFile make_slivers() {
    return tools::make_drilled_plate(5);
}

/// Joins vertices at the same place.
void join_vertices(MeshFile& mesh) {
    std::map<std::array<double, 3>, std::uint32_t> vertices;
    for (std::uint32_t& vertex : mesh.triangles) {
        const Vec3 p = point_at(mesh.positions, vertex);
        vertex = vertices.try_emplace({p.x, p.y, p.z}, vertex).first->second;
    }
}

/// Gears that run through each other, and blocks that touch along edges.
MeshFile make_assembly() {
    MeshFile mesh;
    for (int cell = 0; cell < 27; cell += 2) {
        MeshFile block = tools::make_cube(2);
        const Vec3 place(cell / 9, cell / 3 % 3, cell % 3);
        move_all(block, [&](const Vec3& p) { return p + place; });
        append(mesh, block);
    }
    join_vertices(mesh);
    for (int gear = 0; gear < 20; ++gear) {
        std::vector<Vec2> outline;
        const std::uint32_t teeth = 8 + static_cast<std::uint32_t>(gear) % 5;
        for (std::uint32_t tooth = 0; tooth < teeth; ++tooth) {
            const auto add = [&](double radius, double from, double to) {
                const std::vector<Vec2> points =
                    arc({0, 0}, radius, (tooth + from) / teeth, (tooth + to) / teeth, 2);
                outline.insert(outline.end(), points.begin(), points.end());
            };
            add(0.7, 0.05, 0.45);
            add(0.55, 0.5, 0.95);
        }
        std::vector<Vec2> bore = arc({0, 0}, 0.2, 0, 1, 16);
        bore.pop_back();
        MeshFile part = drilled_prism(outline, bore, 0.05 + 0.02 * (gear % 3));
        const int column = gear % 5, row = gear / 5;
        const Vec3 place(0.55 * column, 0.6 * row, 1.3 + 0.035 * gear);
        move_all(part, [&](const Vec3& p) {
            return (gear % 2 == 0 ? p : Vec3{p.z, p.x, p.y}) + place;
        });
        append(mesh, part);
    }
    return mesh;
}

/// Adds a tube of which place(i, j) is the point of step i along it and step j around, open at both
/// ends and along a seam but for every third vertex there.
template <typename Place>
void add_slit_tube(MeshFile& mesh, std::uint32_t along, std::uint32_t around, const Place& place) {
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t i = 0; i <= along; ++i) {
        for (std::uint32_t j = 0; j < around; ++j) {
            vertices.push_back(add_vertex(mesh, place(i, j)));
        }
        const std::uint32_t first = vertices[i * (around + 1)];
        const bool is_joined = i % 3 == 1 && i < along;
        vertices.push_back(is_joined ? first : add_vertex(mesh, place(i, 0)));
    }
    tools::add_grid(mesh, along, around, [&](std::uint32_t i, std::uint32_t j) {
        return vertices[i * (around + 1) + j];
    });
}

/// Four open parts that run through each other: a body, its lid, a spout and a handle.
MeshFile make_vessel() {
    constexpr std::uint32_t kAround = 24;
    MeshFile mesh;
    const auto add_turned = [&](std::uint32_t along, const auto& radius_and_height) {
        add_slit_tube(mesh, along, kAround, [&](std::uint32_t i, std::uint32_t j) {
            const Vec2 p = radius_and_height(static_cast<double>(i) / along);
            const double turn = tools::angle(j, kAround);
            return Vec3{p.x * tools::cosine(turn), p.x * tools::sine(turn), p.y};
        });
    };
    add_turned(30, [](double t) { return Vec2(0.6 + 0.4 * tools::sine(tools::kPi * t), t); });
    add_turned(12, [](double t) { return Vec2(0.7 - 0.68 * t, 0.95 + 0.2 * t * (2 - t)); });
    const auto add_bent = [&](std::uint32_t along, double radius, const auto& middle) {
        add_slit_tube(mesh, along, kAround, [&](std::uint32_t i, std::uint32_t j) {
            const double t = static_cast<double>(i) / along;
            const Vec2 p = middle(t);
            const Vec2 way = normalize(middle(t + 0.01) - p);
            const double turn = tools::angle(j, kAround);
            const double out = radius * tools::cosine(turn);
            return Vec3{p.x - out * way.y, radius * tools::sine(turn), p.y + out * way.x};
        });
    };
    add_bent(30, 0.12, [](double t) { return Vec2(0.7 + 0.9 * t, 0.3 + 0.7 * t * t); });
    add_bent(40, 0.06, [](double t) {
        const double turn = tools::kPi * (0.4 + 1.2 * t);
        return Vec2(-0.8 + 0.5 * tools::cosine(turn), 0.5 + 0.4 * tools::sine(turn));
    });
    return mesh;
}

constexpr std::string_view kForCoarseScan[] = {"bunny_1k4.obj"};
constexpr std::string_view kForScan[] = {"bunny_14k.obj", "bunny_144k.ply", "gargoyle_52k.obj",
                                         "armadillo_29k.obj", "spot_pose_a_6k.obj"};
constexpr std::string_view kForTwistedScan[] = {"spot_pose_b_6k.obj"};
constexpr std::string_view kForHoledScan[] = {"bunny_69k.ply", "human_neutral_21k.obj",
                                              "human_man_14k.obj", "human_woman_14k.obj"};
constexpr std::string_view kForLatticeScan[] = {"boot_40k.obj"};
constexpr std::string_view kForTerrainScan[] = {"mountain_51k.obj"};
constexpr std::string_view kForThinShell[] = {"lucy_100k.ply"};
constexpr std::string_view kForBracket[] = {"fandisk_13k.obj", "rocker_arm_20k.obj"};
constexpr std::string_view kForSlivers[] = {"tray_4k5.ply"};
constexpr std::string_view kForAssembly[] = {"cycloidal_43k.ply"};
constexpr std::string_view kForVessel[] = {"teapot_6k.obj"};

constexpr StandIn kStandIns[] = {
    {{"coarse scan", 742, 1480, 0, 1, 0, 19.26, 0.62419, {2.0564, 2.4197, 3.1405}},
     kForCoarseScan,
     make_coarse_scan},
    {{"scan", 3562, 7120, 0, 1, 0, 19.723, 0.37081, {2.027, 2.3933, 3.121}}, kForScan, make_scan},
    {{"twisted scan", 3562, 7120, 0, 1, 0, 24.381, 0.55882, {2.2104, 3.2549, 3.1536}},
     kForTwistedScan,
     make_twisted_scan},
    {{"holed scan", 3588, 7069, 105, 3, 0, 20.439, 0.52127, {2.0801, 2.3886, 3.1776}},
     kForHoledScan,
     make_holed_scan},
    {{"lattice scan", 1588, 3496, 0, 1, 0, 9.9278, 0.14662, {0.99759, 0.99792, 0.99672}},
     kForLatticeScan,
     make_lattice_scan},
    {{"terrain scan", 2481, 4792, 168, 1, 0, 1.2722, 0.057342, {1.0091, 1.0083, 0.18158}},
     kForTerrainScan,
     make_terrain_scan},
    {{"thin shell", 3862, 7720, 0, 1, 0, 2.3558, 0.045723, {0.27328, 1.0016, 0.28755}},
     kForThinShell,
     make_thin_shell},
    {{"bracket", 3739, 7478, 0, 1, 0, 11.209, 0.19978, {2.5, 2, 0.6}}, kForBracket, make_bracket},
    {{"slivers", 1288, 2652, 0, 1, 0, 1.6264, 1, {1, 0.8, 0.01}}, kForSlivers, make_slivers},
    {{"assembly", 3320, 6752, 0, 21, 72, 138.49, 1.0163, {3.5992, 3.1998, 3.1648}},
     kForAssembly,
     make_assembly},
    {{"vessel", 2863, 5376, 416, 4, 0, 10.075, 0.2629, {3.0611, 2, 1.15}}, kForVessel, make_vessel},
};

} // namespace

std::span<const StandIn> stand_ins() {
    return kStandIns;
}

const StandIn& stand_in(std::string_view name) {
    for (const StandIn& one : kStandIns) {
        if (one.known.name == name ||
            std::find(one.files.begin(), one.files.end(), name) != one.files.end()) {
            return one;
        }
    }
    throw std::logic_error("nothing stands for " + std::string(name));
}

} // namespace geodisk::test
