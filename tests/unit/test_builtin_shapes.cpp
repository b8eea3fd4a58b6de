#include "shapes/builtin_shapes.hpp"
#include "shapes/shape_makers.hpp"

#include "mesh_facts.hpp"
#include "test_files.hpp"

#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

using namespace geodisk::tools;

namespace {

MeshFacts facts_of(std::string_view name, std::optional<int> resolution) {
    return measure(make_builtin(name, resolution));
}

/// The smallest, the default and an uneven resolution.
std::vector<int> some_resolutions(const BuiltinShape& shape) {
    return {shape.min_resolution, shape.min_resolution + 1, shape.default_resolution};
}

const BuiltinShape& shape_named(std::string_view name) {
    for (const BuiltinShape& shape : builtin_shapes()) {
        if (shape.name == name) {
            return shape;
        }
    }
    throw std::logic_error("no such shape");
}

double signed_volume(const MeshFile& mesh) {
    double six_volumes = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        six_volumes += dot(position_at(mesh, mesh.triangles[i]),
                           cross(position_at(mesh, mesh.triangles[i + 1]),
                                 position_at(mesh, mesh.triangles[i + 2])));
    }
    return six_volumes / 6;
}

double edge_length(const MeshFile& mesh, std::size_t corner) {
    const std::size_t next = 3 * (corner / 3) + (corner + 1) % 3;
    return length(position_at(mesh, mesh.triangles[next]) -
                  position_at(mesh, mesh.triangles[corner]));
}

/// The integral over one turn of a smooth function, to rounding: the trapezoidal rule is exact up
/// to the frequencies of its steps.
template <typename Function>
double turn_integral(const Function& function) {
    constexpr int kSteps = 4096;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        sum += function(2 * kPi * i / kSteps);
    }
    return 2 * kPi / kSteps * sum;
}

/// Along the tube of radius 1/2 a step du is sqrt((1 + cos(v)/2)^2 + (sin(v)/4)^2) long, across it
/// a step dv is 1/2, at right angles.
double klein_bottle_area() {
    return turn_integral([](double v) {
        return 2 * kPi * 0.5 * std::hypot(1 + 0.5 * std::cos(v), 0.25 * std::sin(v));
    });
}

/// Half the sphere's image under (xx - yy, xy, xz, yz): by Gauss' determinant over latitude and
/// longitude, with derivatives taken by hand. The midpoint rule in latitude leaves 1e-7.
double veronese_area() {
    constexpr int kRings = 2000;
    double area = 0;
    for (int i = 0; i < kRings; ++i) {
        const double t = kPi * (i + 0.5) / kRings;
        const double s = std::sin(t), c = std::cos(t);
        area += kPi / kRings * turn_integral([=](double u) {
                    const double cu = std::cos(u), su = std::sin(u);
                    const double c2 = std::cos(2 * u), s2 = std::sin(2 * u);
                    const double by_t[4] = {2 * s * c * c2, s * c * s2, (c * c - s * s) * cu,
                                            (c * c - s * s) * su};
                    const double by_u[4] = {-2 * s * s * s2, s * s * c2, -s * c * su, s * c * cu};
                    double tt = 0, uu = 0, tu = 0;
                    for (int k = 0; k < 4; ++k) {
                        tt += by_t[k] * by_t[k];
                        uu += by_u[k] * by_u[k];
                        tu += by_t[k] * by_u[k];
                    }
                    return std::sqrt(tt * uu - tu * tu);
                });
    }
    return area / 2;
}

/// Returns true if triangles can be turned over so that neighbours agree, on a closed surface of
/// one part.
bool is_orientable(const MeshFile& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::pair<std::size_t, bool>>>
        edges;
    const std::size_t count = mesh.triangles.size() / 3;
    for (std::size_t corner = 0; corner < 3 * count; ++corner) {
        const std::uint32_t from = mesh.triangles[corner];
        const std::uint32_t to = mesh.triangles[3 * (corner / 3) + (corner + 1) % 3];
        edges[std::minmax(from, to)].emplace_back(corner / 3, from < to);
    }
    // Node t is triangle t as it is, node t + count the same turned over.
    Groups groups(2 * count);
    for (const auto& [ends, faces] : edges) {
        const std::size_t a = faces.at(0).first;
        const std::size_t b = faces.at(1).first;
        const bool agree = faces[0].second != faces[1].second;
        groups.join(a, agree ? b : b + count);
        groups.join(a + count, agree ? b + count : b);
    }
    return groups.find(0) != groups.find(count);
}

double distance_between(const MeshFile& mesh, std::size_t a, std::size_t b) {
    const std::vector<double> apart = side(mesh, a, b);
    return std::sqrt(dot_product(apart, apart));
}

double shortest_edge(const MeshFile& mesh) {
    double shortest = HUGE_VAL;
    for (std::size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
        const std::size_t next = 3 * (corner / 3) + (corner + 1) % 3;
        shortest = std::min(shortest,
                            distance_between(mesh, mesh.triangles[corner], mesh.triangles[next]));
    }
    return shortest;
}

/// The least distance in R^4 of two vertices that share no triangle.
double closest_far_apart(const MeshFile& mesh) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> neighbours;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            neighbours.insert(std::minmax(mesh.triangles[i + k], mesh.triangles[i + (k + 1) % 3]));
        }
    }
    double closest = HUGE_VAL;
    const auto count = static_cast<std::uint32_t>(mesh.positions.size() / mesh.dimension);
    for (std::uint32_t a = 0; a < count; ++a) {
        for (std::uint32_t b = a + 1; b < count; ++b) {
            if (!neighbours.contains({a, b})) {
                closest = std::min(closest, distance_between(mesh, a, b));
            }
        }
    }
    return closest;
}

} // namespace

TEST_CASE("every shape is one clean manifold at every resolution") {
    for (const BuiltinShape& shape : builtin_shapes()) {
        CHECK(shape.min_resolution <= shape.default_resolution);
        CHECK(shape.default_resolution < shape.max_resolution);
        for (const int resolution : some_resolutions(shape)) {
            CAPTURE(shape.name);
            CAPTURE(resolution);
            const MeshFacts facts = facts_of(shape.name, resolution);
            CHECK(facts.unused_vertices == 0);
            CHECK(facts.components == 1);
            CHECK(facts.crowded_edges == 0);
            CHECK(facts.pinched_vertices == 0);
            const bool is_thin = shape.name == "spike" || shape.name == "cone" ||
                                 shape.name == "drilled-plate"; // On purpose.
            CHECK(facts.flattest > (is_thin ? 1e-9 : 1e-4));
            const bool is_one_sided =
                shape.name == "moebius" || shape.name == "klein-bottle" || shape.name == "veronese";
            CHECK((facts.clashing_edges > 0) == is_one_sided);
        }
    }
}

TEST_CASE("closed shapes are closed, of the right genus and face outwards") {
    struct Closed {
        std::string_view name;
        std::ptrdiff_t genus;
    };
    for (const Closed& closed :
         {Closed{"cube", 0}, Closed{"plate", 0}, Closed{"icosphere", 0}, Closed{"torus-knot", 1},
          Closed{"showpiece", 1}, Closed{"lattice", 81}}) {
        for (const int resolution : some_resolutions(shape_named(closed.name))) {
            CAPTURE(closed.name);
            CAPTURE(resolution);
            const MeshFile mesh = make_builtin(closed.name, resolution);
            const MeshFacts facts = measure(mesh);
            CHECK(facts.is_closed_manifold());
            CHECK(facts.genus() == closed.genus);
            CHECK(signed_volume(mesh) > 0);
        }
    }
}

TEST_CASE("the drilled plate is closed, has holes and is cut into slivers") {
    for (const int resolution : {2, 7, 20}) {
        CAPTURE(resolution);
        const MeshFile mesh = make_builtin("drilled-plate", resolution);
        const MeshFacts facts = measure(mesh);
        const int holes = resolution * ((3 * resolution + 3) / 4);
        CHECK(facts.is_closed_manifold());
        CHECK(facts.genus() == holes);
        CHECK(signed_volume(mesh) > 0);
        CHECK(facts.flattest < 1e-3);
    }
}

TEST_CASE("open shapes have one border") {
    for (const char* name : {"folded-sheet", "unfolded-sheet", "swiss-roll", "unrolled-sheet",
                             "crossed-sheet", "uncrossed-sheet", "terrain"}) {
        CAPTURE(name);
        const MeshFacts facts = facts_of(name, std::nullopt);
        CHECK(facts.border_edges > 0);
        CHECK(facts.euler_characteristic == 1);
    }
    const MeshFacts moebius = facts_of("moebius", 4);
    CHECK(moebius.euler_characteristic == 0);
    CHECK(moebius.border_edges == 2 * 9 * 4);
    CHECK(moebius.clashing_edges == 4); // The seam; no orientation is without one.
}

TEST_CASE("shapes in R^4 are closed, of the right kind and as large as the surfaces they follow") {
    struct Surface {
        std::string_view name;
        std::ptrdiff_t euler_characteristic;
        bool is_orientable;
        double area;
        int fine;
    };
    // The areas of the last two by numerical integration, see below.
    for (const Surface& surface : {Surface{"clifford-torus", 0, true, 4 * kPi * kPi, 256},
                                   Surface{"klein-bottle", 0, false, klein_bottle_area(), 128},
                                   Surface{"veronese", 1, false, veronese_area(), 6}}) {
        CAPTURE(surface.name);
        for (const int resolution : some_resolutions(shape_named(surface.name))) {
            CAPTURE(resolution);
            const MeshFile mesh = make_builtin(surface.name, resolution);
            CHECK(mesh.dimension == 4);
            const MeshFacts facts = measure(mesh);
            CHECK(facts.is_closed_manifold());
            CHECK(facts.euler_characteristic == surface.euler_characteristic);
            CHECK(is_orientable(mesh) == surface.is_orientable);
        }
        const double coarse = total_area(make_builtin(surface.name, surface.fine / 2));
        const double fine = total_area(make_builtin(surface.name, surface.fine));
        CHECK(fine == doctest::Approx(surface.area).epsilon(1e-3));
        CHECK(std::abs(fine - surface.area) < 0.3 * std::abs(coarse - surface.area));
    }
}

TEST_CASE("the Clifford torus is flat: its squares keep their shape") {
    for (const int resolution : {3, 10, 64}) {
        const double side_length = 2 * resolution * std::sin(kPi / resolution);
        CHECK(total_area(make_builtin("clifford-torus", resolution)) ==
              doctest::Approx(side_length * side_length).epsilon(1e-13));
    }
}

TEST_CASE("neither the Klein bottle nor the projective plane meets itself") {
    for (const auto& [name, resolution] :
         {std::pair{"klein-bottle", 24}, std::pair{"veronese", 4}}) {
        const auto& shown = name; // Before Clang 16 lambdas capture no bindings.
        CAPTURE(shown);
        const MeshFile mesh = make_builtin(name, resolution);
        CHECK(closest_far_apart(mesh) > 0.5 * shortest_edge(mesh));
    }
}

TEST_CASE("sizes are as documented") {
    CHECK(facts_of("cube", std::nullopt).triangles == 12);
    CHECK(facts_of("cube", 3).triangles == 12 * 9);
    CHECK(facts_of("icosphere", 2).triangles == 20 * 16);
    const std::size_t showpiece = facts_of("showpiece", std::nullopt).triangles;
    CHECK(showpiece >= 20000);
    CHECK(showpiece <= 60000);
    CHECK(total_area(make_builtin("cube", 5)) == doctest::Approx(6));
    CHECK(total_area(make_builtin("plate", 3)) == doctest::Approx(2.04));
    const double sphere_area = 12.566370614359172;
    CHECK(total_area(make_builtin("icosphere", 6)) == doctest::Approx(sphere_area).epsilon(1e-3));
}

TEST_CASE("folding keeps every edge of the sheet, rolling and crossing to the last bit") {
    struct Sheet {
        const char* bent;
        const char* flat;
        double allowed;
    };
    for (const auto& [bent_name, flat_name, allowed] :
         {Sheet{"folded-sheet", "unfolded-sheet", 1e-12}, Sheet{"swiss-roll", "unrolled-sheet", 0},
          Sheet{"crossed-sheet", "uncrossed-sheet", 0}}) {
        for (const int resolution : {3, 7, 32, 200, 1000}) {
            const auto& shown = bent_name; // Before Clang 16 lambdas capture no bindings.
            CAPTURE(shown);
            CAPTURE(resolution);
            const MeshFile bent = make_builtin(bent_name, resolution);
            const MeshFile flat = make_builtin(flat_name, resolution);
            REQUIRE(bent.triangles == flat.triangles);
            double worst = 0;
            for (std::size_t corner = 0; corner < flat.triangles.size(); ++corner) {
                const double expected = edge_length(flat, corner);
                worst = std::max(worst, std::abs(edge_length(bent, corner) / expected - 1));
            }
            CHECK(worst <= allowed);
            double height = 0;
            for (std::size_t i = 2; i < flat.positions.size(); i += 3) {
                height = std::max(height, std::abs(flat.positions[i]));
            }
            CHECK(height == 0);
        }
    }
}

TEST_CASE("the crossed sheet comes back to where it was, at a right angle") {
    const std::size_t parts = 32;
    const MeshFile mesh = make_builtin("crossed-sheet", parts);
    const auto column = [&](std::size_t i) { return position_at(mesh, i * (parts + 1)); };
    REQUIRE(mesh.positions.size() / 3 == (6 * parts + 1) * (parts + 1));
    CHECK(length(column(parts) - column(5 * parts)) < 0.002);
    const auto way = [&](std::size_t i) { return normalize(column(i + 1) - column(i - 1)); };
    CHECK(std::abs(dot(way(parts), way(5 * parts))) < 0.05);
}

TEST_CASE("turns of the swiss roll lie close above each other") {
    const MeshFile mesh = make_builtin("swiss-roll", 8);
    const auto radius = [&](std::size_t column) {
        const Vec3 from_axis = position_at(mesh, column * 9) - position_at(mesh, 0) -
                               Vec3{-0.1, 0, 0}; // The sheet starts at (0.1, 0, 0) of its axis.
        return length(from_axis);
    };
    for (const std::size_t column : {0u, 5u, 8u, 16u}) {
        CHECK(radius(column + 8) == doctest::Approx(radius(column) + 0.05).epsilon(0.01));
    }
}

TEST_CASE("layers of the folded sheet lie close above each other") {
    const MeshFile mesh = make_builtin("folded-sheet", 1);
    double top = 0;
    for (std::size_t i = 2; i < mesh.positions.size(); i += 3) {
        top = std::max(top, mesh.positions[i]);
    }
    CHECK(top == doctest::Approx(4 * 0.01));
}

TEST_CASE("shapes are the same every time and wrong requests are refused") {
    for (const BuiltinShape& shape : builtin_shapes()) {
        const MeshFile first = make_builtin(shape.name, std::nullopt);
        const MeshFile second = make_builtin(shape.name, shape.default_resolution);
        CHECK(first.positions == second.positions);
        CHECK(first.triangles == second.triangles);
        check_fails(ExitCode::usage, "resolution",
                    [&] { make_builtin(shape.name, shape.max_resolution + 1); });
        check_fails(ExitCode::usage, "resolution",
                    [&] { make_builtin(shape.name, shape.min_resolution - 1); });
        check_fails(ExitCode::usage, shape.name, [] { make_builtin("nonsense", std::nullopt); });
    }
}
