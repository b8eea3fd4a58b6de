// PreparedMesh from edge lengths alone: the same surface as from coordinates, what is rejected, and
// surfaces that fit in no space.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "ref/dart_check.hpp"
#include "support/meshes.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

using Indices = std::vector<std::uint32_t>;
using Lengths = std::vector<double>;

const Indices kTriangle{0, 1, 2};
/// Two faces on both sides of edge 0-2.
const Indices kPair{0, 1, 2, 0, 2, 3};

Lengths lengths_of(const PreparedMesh& mesh) {
    Lengths lengths;
    for (const HalfEdge& edge : mesh.half_edges()) {
        lengths.push_back(edge.length);
    }
    return lengths;
}

Result<PreparedMesh> from_lengths(const Indices& triangles, const Lengths& lengths,
                                  std::uint32_t vertex_count = 4) {
    return PreparedMesh::prepare({triangles, lengths, vertex_count});
}

Error rejection_of_lengths(const Indices& triangles, const Lengths& lengths,
                           std::uint32_t vertex_count = 4) {
    const auto result = from_lengths(triangles, lengths, vertex_count);
    REQUIRE(!result);
    CHECK(result.error().message.find('\n') == std::string::npos);
    return result.error();
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Frames differ by rounding alone, everything else not at all.
void check_same_surface(const PreparedMesh& a, const PreparedMesh& b, double exactness) {
    REQUIRE(a.half_edges().size() == b.half_edges().size());
    double worst = 0;
    for (std::size_t h = 0; h < a.half_edges().size(); ++h) {
        const HalfEdge& p = a.half_edges()[h];
        const HalfEdge& q = b.half_edges()[h];
        worst = std::max({worst, std::abs(p.length - q.length), std::abs(p.apex_x - q.apex_x),
                          std::abs(p.apex_y - q.apex_y)});
        REQUIRE(p.origin == q.origin);
        REQUIRE(p.around == q.around);
    }
    CHECK(worst <= exactness * a.statistics().longest_edge);
    CHECK(a.vertex_count() == b.vertex_count());
    CHECK(a.statistics().vertices == b.statistics().vertices);
    CHECK(a.statistics().triangles == b.statistics().triangles);
    CHECK(a.statistics().components == b.statistics().components);
    CHECK(a.statistics().boundary_edges == b.statistics().boundary_edges);
    CHECK(a.statistics().repeated_index_faces == b.statistics().repeated_index_faces);
    CHECK(a.statistics().zero_area_faces == b.statistics().zero_area_faces);
    CHECK(a.statistics().area == doctest::Approx(b.statistics().area).epsilon(1e-12));
}

} // namespace

TEST_CASE("lengths: the same surface as from coordinates") {
    const std::pair<const char*, int> shapes[] = {{"cube", 3},    {"icosphere", 3},
                                                  {"plate", 5},   {"terrain", 20},
                                                  {"moebius", 4}, {"lattice", 1}};
    for (const auto& [name, resolution] : shapes) {
        const auto& shown = name; // Before Clang 16 lambdas capture no bindings.
        CAPTURE(shown);
        const TestMesh mesh = builtin(name, resolution);
        const PreparedMesh model = prepared(mesh);
        const Lengths lengths = lengths_of(model);
        const auto surface = PreparedMesh::prepare({mesh.triangles, lengths, mesh.vertex_count()});
        REQUIRE(surface);
        check_same_surface(model, *surface, 1e-13);
        CHECK(surface->statistics().diagonal == 0);
        const SampleParams params = params_for(model, 300);
        CHECK(thrown<double>(*surface, params).ranks == thrown<double>(model, params).ranks);
    }
}

TEST_CASE("lengths: scale does not matter within the range of double") {
    for (const double scale : {1e-99, 1.0, 1e99}) {
        const auto mesh = from_lengths(kTriangle, {3 * scale, 4 * scale, 5 * scale}, 3);
        REQUIRE(mesh);
        CHECK(mesh->statistics().area == doctest::Approx(6 * scale * scale).epsilon(1e-14));
        CHECK(mesh->half_edges()[0].apex_x == doctest::Approx(3 * scale).epsilon(1e-14));
        CHECK(mesh->half_edges()[0].apex_y == doctest::Approx(4 * scale).epsilon(1e-14));
    }
    CHECK(rejection_of_lengths(kTriangle, {1e-101, 1e-101, 1e-101}).message ==
          "the mesh is smaller than 1e-100; rescale it");
}

TEST_CASE("lengths: a needle keeps its height") {
    const double height = 1e-9;
    const double side = std::sqrt(0.25 + height * height);
    const auto needle = from_lengths({0, 1, 2, 0, 2, 3}, {1, side, side, side, 1, 1});
    REQUIRE(needle);
    // The square of the height is 1e-18 of the sides' and lost in them: degenerate, but no error.
    CHECK(needle->statistics().zero_area_faces == 1);
    const auto thin = from_lengths({0, 1, 2}, {1, 1, 1e-9}, 3);
    REQUIRE(thin);
    CHECK(thin->half_edges()[2].apex_y == doctest::Approx(1).epsilon(1e-14));
    CHECK(thin->half_edges()[0].apex_y == doctest::Approx(1e-9).epsilon(1e-14));
}

TEST_CASE("lengths: a face that only just closes has no area and lies on a line") {
    for (const double excess : {0.0, 1e-15, 1e-7}) {
        CAPTURE(excess);
        const auto mesh = from_lengths(kPair, {1, 2, 3 * (1 + excess), 3 * (1 + excess), 4, 5});
        REQUIRE(mesh);
        CHECK(mesh->statistics().zero_area_faces == 1);
        const auto edges = mesh->half_edges();
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(std::abs(edges[k].apex_x) ==
                  doctest::Approx(edges[(k + 2) % 3].length).epsilon(1e-15));
            CHECK(edges[k].apex_y == 0);
            CHECK(edges[k].angle().sine == 0);
        }
        CHECK(edges[0].apex_x == doctest::Approx(3 * (1 + excess)));
        CHECK(edges[1].apex_x == doctest::Approx(-1.0));
        CHECK(edges[2].apex_x == doctest::Approx(2.0));
    }
}

TEST_CASE("lengths: what is rejected is named") {
    CHECK(from_lengths(kPair, {3, 4, 5, 5, 4, 3}));
    for (const double bad : {0.0, -1.0, 1e101, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
        const Error error = rejection_of_lengths(kPair, {3, 4, 5, 5, bad, 3});
        CHECK(error.status == Status::mesh_rejected);
        CHECK(error.element == 1);
        CHECK(contains(error.message, "face 1 has an edge of length "));
    }
    const Error open = rejection_of_lengths(kPair, {3, 4, 5, 5, 1, 3});
    CHECK(open.element == 1);
    CHECK(open.message ==
          "face 1 violates the triangle inequality: its edges have the lengths 5, 1 and 3");
    const Error torn = rejection_of_lengths(kPair, {3, 4, 5, 5.001, 4, 3});
    CHECK(torn.element == 0);
    CHECK(torn.message == "faces 0 and 1 disagree about edge 2-0: its length is 5 and 5.001");
    CHECK(from_lengths(kPair, {3, 4, 5, 5 * (1 + 1e-10), 4, 3}));

    const Error range = rejection_of_lengths({0, 1, 4}, {3, 4, 5});
    CHECK(range.element == 0);
    CHECK(range.message == "face 0 names vertex 4, but there are only 4");
    CHECK(rejection_of_lengths(kPair, {3, 4, 5}).status == Status::invalid_argument);
    CHECK(rejection_of_lengths({0, 1}, {3, 4}).status == Status::invalid_argument);
    CHECK(contains(rejection_of_lengths({}, {}).message, "no faces"));
    CHECK(contains(rejection_of_lengths(kTriangle, {1, 2, 3}).message, "no face has area"));
    CHECK(contains(rejection_of_lengths({0, 0, 1}, {1, 1, 1}).message, "no face has area"));
    // Above a vertex's number the kernels keep two flags.
    CHECK(
        contains(rejection_of_lengths(kTriangle, {1, 1, 1}, (1u << 30) + 1).message, "too large"));
}

TEST_CASE("lengths: a face that names a vertex twice takes no part, whatever its lengths") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto mesh = from_lengths({0, 1, 2, 1, 1, 2}, {3, 4, 5, nan, -1, 0});
    REQUIRE(mesh);
    CHECK(mesh->statistics().repeated_index_faces == 1);
    CHECK(mesh->statistics().longest_edge == 5);
    CHECK(mesh->statistics().area == doctest::Approx(6));
}

TEST_CASE(
    "lengths: a flat torus of 7 vertices, which no space holds flat, is sampled to the full") {
    // The triangulation of Moebius and Csaszar with all edges of length 1.
    Indices triangles;
    for (std::uint32_t v = 0; v < 7; ++v) {
        triangles.insert(triangles.end(), {v, (v + 1) % 7, (v + 3) % 7});
        triangles.insert(triangles.end(), {v, (v + 3) % 7, (v + 2) % 7});
    }
    const Lengths lengths(triangles.size(), 1.0);
    const auto mesh = PreparedMesh::prepare({triangles, lengths, 7});
    REQUIRE(mesh);
    CHECK(mesh->statistics().boundary_edges == 0);
    CHECK(mesh->statistics().nonmanifold_edges == 0);
    CHECK(mesh->statistics().area == doctest::Approx(14 * std::sqrt(3.0) / 4));
    for (const VertexFan& fan : mesh->fans()) {
        CHECK(fan.corner_count == 6);
    }
    const SampleParams params = params_for(*mesh, 400);
    const Darts darts = thrown<float>(*mesh, params);
    check_maximal(*mesh, darts);
    // A flat torus has the packing density of the plane.
    CHECK(packing_density(mesh->statistics().area, params.min_distance,
                          static_cast<double>(darts.ranks.size())) > 0.68);
}
