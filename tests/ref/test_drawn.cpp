// Candidates that the host draws, against those of the twin.
#include <algorithm>
#include <numeric>
#include <vector>

#include <doctest/doctest.h>

#include "engine/domain/drawn.hpp"
#include "kernels/candidates.hpp"
#include "kernels/pool.hpp"
#include "ref/dart_check.hpp"
#include "support/radius_fields.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

/// Returns the candidates of all stages of a pool, in dart order.
std::vector<DrawnCandidate> drawn_pool(const PreparedMesh& mesh, const SampleParams& params) {
    const auto frame = frame_of(mesh, params);
    REQUIRE(frame);
    const CandidateDraw draw(mesh, params, *frame);
    std::vector<DrawnCandidate> drawn;
    for (std::uint32_t face = mesh.face_count(); face-- > 0;) {
        for (std::uint32_t stage = 0; stage < draw.stages().pool_stages(); ++stage) {
            draw.draw(face, stage, drawn);
        }
    }
    std::ranges::sort(drawn, [&](const DrawnCandidate& a, const DrawnCandidate& b) {
        return is_before(a, b, !params.face_keys.empty());
    });
    return drawn;
}

/// Checks that the host draws the pool of the twin.
void check_drawn_pool(const PreparedMesh& mesh, const SampleParams& params) {
    const auto drawn = drawn_pool(mesh, params);
    const auto pool = ref::draw_pool(ref::Surface<float>(mesh, params), params);
    REQUIRE(drawn.size() == pool.size());
    for (std::uint32_t rank = 0; rank < pool.size(); ++rank) {
        const auto& [stage, priority, point] = drawn[rank];
        const ref::FacePoint<float> expected = pool.candidate(rank);
        REQUIRE((stage << 28 | priority) == pool.word(rank));
        REQUIRE(point.face == expected.face);
        REQUIRE(static_cast<float>(point.weight1) * 0x1p-24f == expected.weight1);
        REQUIRE(static_cast<float>(point.weight2) * 0x1p-24f == expected.weight2);
    }
}

} // namespace

TEST_CASE("drawn candidates: the twin's, in faces of any size") {
    for (const TestMesh& shape : {builtin("torus-knot", 8), builtin("cube", 1), two_sided_square(),
                                  needle_disk(50), tetrahedra(2, 0.2), builtin("icosphere", 4)}) {
        const PreparedMesh mesh = prepared(shape);
        for (const double count : {1.0, 30.0, 700.0, 3000.0}) {
            check_drawn_pool(mesh, params_for(mesh, count, 5));
        }
        SampleParams many = params_for(mesh, 300, 0x9e3779b97f4a7c15);
        many.pool_ratio = 100;
        check_drawn_pool(mesh, many);
    }
}

TEST_CASE("drawn candidates: radii that vary, densities, masks and keys") {
    for (const TestMesh& shape : {builtin("torus-knot", 8), builtin("cube", 1)}) {
        const PreparedMesh mesh = prepared(shape);
        const RadiusField wavy = radius_field(mesh, wavy_factors(shape, 0.1));
        const RadiusField rough = radius_field(mesh, rough_factors(shape, 0.01));
        const RadiusField density = density_field(mesh, rough_density(shape));
        std::vector<std::uint32_t> keys(mesh.face_count());
        std::iota(keys.rbegin(), keys.rend(), 77u);
        const auto mask = mask_above(shape, 1);
        for (const RadiusField* radii : {&wavy, &rough, &density}) {
            SampleParams params = params_for(mesh, 500, 2);
            params.radii = radii;
            params.min_distance = distance_for_count(radii->effective_area(), 500);
            check_drawn_pool(mesh, params);
            params.face_keys = keys;
            params.face_mask = mask;
            check_drawn_pool(mesh, params);
        }
    }
}

TEST_CASE("drawn candidates: stages of darts") {
    const PreparedMesh mesh = prepared(builtin("cube", 2));
    SampleParams params = params_for(mesh, 200);
    params.darts = 100000;
    const auto frame = frame_of(mesh, params);
    REQUIRE(frame);
    const CandidateDraw draw(mesh, params, *frame);
    const ref::Surface<float> surface(mesh, params);
    for (const std::uint32_t stage : {0u, 3u, 17u}) {
        const auto counts = ref::count_candidates(surface, params, stage);
        for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
            std::vector<DrawnCandidate> drawn;
            draw.draw(face, stage, drawn);
            REQUIRE(drawn.size() == counts[face]);
            std::vector<ref::FacePoint<float>> points(counts[face]);
            std::vector<std::uint32_t> priorities(counts[face]);
            ref::draw_candidates<float>(surface, params, face, stage, points, priorities);
            for (std::size_t k = 0; k < points.size(); ++k) {
                REQUIRE(drawn[k].priority == priorities[k]);
                REQUIRE(static_cast<float>(drawn[k].point.weight1) * 0x1p-24f == points[k].weight1);
            }
        }
    }
}
