#include "common/builtin_shapes.hpp"

#include "mesh_facts.hpp"
#include "test_files.hpp"

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
            CHECK(facts.flattest > 1e-4);
            if (shape.name != "moebius") {
                CHECK(facts.clashing_edges == 0);
            }
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

TEST_CASE("open shapes have one border") {
    for (const char* name : {"folded-sheet", "unfolded-sheet", "terrain"}) {
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

TEST_CASE("folding keeps every edge of the sheet") {
    for (const int resolution : {1, 7, 32, 200}) {
        CAPTURE(resolution);
        const MeshFile folded = make_builtin("folded-sheet", resolution);
        const MeshFile flat = make_builtin("unfolded-sheet", resolution);
        REQUIRE(folded.triangles == flat.triangles);
        double worst = 0;
        for (std::size_t corner = 0; corner < flat.triangles.size(); ++corner) {
            const double expected = edge_length(flat, corner);
            worst = std::max(worst, std::abs(edge_length(folded, corner) / expected - 1));
        }
        CHECK(worst < 1e-12);
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
