// Samples at vertices: the set of sequential dart throwing over a list that an independent code
// draws, spacing by the reference, the law of the order, masks, radii, levels and counts.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include <geodisk/geodesics.hpp>
#include <geodisk/request.hpp>

#include "device_run.hpp"
#include "engine/domain/vertex_darts.hpp"
#include "sets.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {
namespace {

Runner vertex_runner() {
    return expect(Runner::create(shared_context().device(), shared_context().queue()));
}

/// Returns the vertex that a sample is at.
std::optional<std::uint32_t> vertex_of(const TestMesh& mesh, const Sample& sample) {
    for (std::uint32_t k = 0; k < 3; ++k) {
        if (sample.weights[k] == 1) {
            return mesh.triangles[3 * sample.face + k];
        }
    }
    return std::nullopt;
}

std::vector<std::uint32_t> vertices_of(const TestMesh& mesh, const std::vector<Sample>& samples) {
    std::vector<std::uint32_t> vertices;
    for (const Sample& sample : samples) {
        const auto vertex = vertex_of(mesh, sample);
        REQUIRE(vertex);
        vertices.push_back(*vertex);
    }
    return vertices;
}

/// Returns the distances of all vertices from one.
std::vector<double> distances_from(const PreparedMesh& mesh, const Sample& source) {
    DistanceQuery query;
    query.sources = std::span(&source, 1);
    return expect(geodesic_distances(mesh, query)).distances;
}

SampleRequest at_vertices(double distance, std::uint64_t seed) {
    SampleRequest request;
    request.params.min_distance = distance;
    request.params.seed = seed;
    request.at_vertices = true;
    return request;
}

} // namespace

TEST_SUITE("vertices") {
    TEST_CASE("samples are vertices, no two too close, and no other vertex has room") {
        Runner runner = vertex_runner();
        for (const auto& [name, shape] :
             {NamedMesh{"sphere", builtin("icosphere", 3)}, {"knot", builtin("torus-knot", 8)}}) {
            const std::string shown = name; // Lambdas of Clang 14 capture no bindings.
            CAPTURE(shown);
            const PreparedMesh mesh = prepared(shape);
            const double distance = 0.1 * mesh.statistics().diagonal;
            const auto found = expect(sample(runner, mesh, at_vertices(distance, 3)));
            const auto vertices = vertices_of(shape, found.set.samples);
            REQUIRE(vertices.size() > 20);
            std::vector<double> nearest(mesh.vertex_count(), HUGE_VAL);
            for (std::size_t i = 0; i < vertices.size(); ++i) {
                CHECK(nearest[vertices[i]] >= distance * (1 - 1e-9));
                const auto own = distances_from(mesh, found.set.samples[i]);
                for (std::size_t v = 0; v < own.size(); ++v) {
                    nearest[v] = std::min(nearest[v], own[v]);
                }
            }
            for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
                if (mesh.fans()[v].corner_count > 0) {
                    CHECK(nearest[v] < distance * (1 + 1e-4));
                }
            }
        }
    }

    TEST_CASE("the set is that of darts over vertices one after the other") {
        // With a tiny distance all vertices are samples, in the order of darts.
        Runner runner = vertex_runner();
        const TestMesh shape = builtin("icosphere", 2);
        const PreparedMesh mesh = prepared(shape);
        const double edge = mesh.statistics().longest_edge;
        double shortest = HUGE_VAL;
        for (const HalfEdge& half : mesh.half_edges()) {
            shortest = std::min(shortest, half.length);
        }
        const auto all = expect(sample(runner, mesh, at_vertices(shortest / 4, 9)));
        REQUIRE(all.set.samples.size() == mesh.statistics().vertices);
        const double distance = 1.7 * edge;
        std::vector<std::uint32_t> expected;
        std::vector<double> nearest(mesh.vertex_count(), HUGE_VAL);
        for (const Sample& one : all.set.samples) {
            const std::uint32_t vertex = *vertex_of(shape, one);
            if (nearest[vertex] < distance) {
                continue;
            }
            expected.push_back(vertex);
            const auto own = distances_from(mesh, one);
            for (std::size_t v = 0; v < own.size(); ++v) {
                nearest[v] = std::min(nearest[v], own[v]);
            }
        }
        const auto found = expect(sample(runner, mesh, at_vertices(distance, 9)));
        CHECK(vertices_of(shape, found.set.samples) == expected);
    }

    TEST_CASE("a vertex is drawn by its share of the area") {
        // The first dart of many seeds, on two triangles of areas as 3 to 5.
        TestMesh shape;
        shape.add_vertex({0, 0, 0});
        shape.add_vertex({3, 0, 0});
        shape.add_vertex({0, 1, 0});
        shape.add_vertex({-5, 0, 0});
        shape.add_triangle(0, 1, 2); // Area 1.5.
        shape.add_triangle(0, 2, 3); // Area 2.5.
        const PreparedMesh mesh = prepared(shape);
        const std::vector<double> shares{4.0 / 12, 1.5 / 12, 4.0 / 12, 2.5 / 12};
        std::vector<double> hits(4);
        constexpr int kSeeds = 20000;
        SampleParams params;
        for (params.seed = 0; params.seed < kSeeds; ++params.seed) {
            const std::vector<ListedCandidate> darts = vertex_darts(mesh, params);
            REQUIRE(darts.size() == 4);
            const auto [face, second, third] = darts.front();
            ++hits[shape.triangles[3 * face + (second > 0 ? 1 : third > 0 ? 2 : 0)]];
        }
        double chi_square = 0;
        for (std::size_t v = 0; v < 4; ++v) {
            const double expected = kSeeds * shares[v];
            chi_square += (hits[v] - expected) * (hits[v] - expected) / expected;
        }
        CHECK(chi_square <
              16.3); // Exceeded by chance once in 1,000 sets of seeds, which are fixed.
    }

    TEST_CASE("masks, radii, existing samples and levels hold at vertices") {
        Runner runner = vertex_runner();
        const TestMesh shape = builtin("torus-knot", 8);
        const PreparedMesh mesh = prepared(shape);
        SampleRequest request = at_vertices(0.06 * mesh.statistics().diagonal, 5);
        std::vector<std::uint8_t> mask(mesh.face_count());
        for (std::uint32_t f = 0; f < mask.size(); ++f) {
            mask[f] = shape.corner(f, 0).x > 0 ? 1 : 0;
        }
        request.params.face_mask = mask;
        const auto masked = expect(sample(runner, mesh, request));
        REQUIRE(masked.set.samples.size() > 10);
        for (const Sample& one : masked.set.samples) {
            CHECK(mask[one.face] == 1);
        }
        request.params.face_mask = {};
        request.params.existing = masked.set.samples;
        const auto more = expect(sample(runner, mesh, request));
        CHECK(more.set.existing == masked.set.samples.size());
        CHECK(more.set.samples.size() > masked.set.samples.size());
        request.params.existing = {};
        request.order = SampleOrder::progressive;
        request.levels = {3, 2};
        const auto levels = expect(sample(runner, mesh, request));
        REQUIRE(levels.ends.size() == 3);
        CHECK(levels.ends[0] < levels.ends[2]);
        vertices_of(shape, levels.set.samples);
        request.order = SampleOrder::dart;
        request.levels = Levels{0};
        std::vector<double> factors(mesh.vertex_count());
        for (std::uint32_t v = 0; v < factors.size(); ++v) {
            factors[v] = shape.vertex(v).x > 0 ? 0.4 : 1;
        }
        const RadiusField radii = expect(RadiusField::prepare(mesh, factors));
        request.params.radii = &radii;
        const auto adaptive = expect(sample(runner, mesh, request));
        const auto vertices = vertices_of(shape, adaptive.set.samples);
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const auto own = distances_from(mesh, adaptive.set.samples[i]);
            for (std::size_t k = 0; k < i; ++k) {
                const double sum = factors[vertices[i]] + factors[vertices[k]];
                CHECK(own[vertices[k]] >= request.params.min_distance * sum / 2 * (1 - 1e-6));
            }
        }
    }

    TEST_CASE("counts of samples at vertices are found, up to all vertices") {
        Runner runner = vertex_runner();
        const TestMesh shape = builtin("icosphere", 3);
        const PreparedMesh mesh = prepared(shape);
        SampleRequest request = at_vertices(0, 5);
        request.count = 100;
        const auto about = expect(sample(runner, mesh, request));
        CHECK(about.set.samples.size() >= 93);
        CHECK(about.set.samples.size() <= 107);
        request.is_exact = true;
        CHECK(expect(sample(runner, mesh, request)).set.samples.size() == 100);
        request.is_exact = false;
        request.count = 642;
        CHECK(expect(sample(runner, mesh, request)).set.samples.size() >= 610);
        request.count = 643;
        const auto refused = sample(runner, mesh, request);
        REQUIRE(!refused);
        CHECK(refused.error().message ==
              "count is 643, but there are only 642 vertices that take samples");
    }
}

} // namespace geodisk::test
