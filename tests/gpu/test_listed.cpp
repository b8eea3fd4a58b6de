// Candidates that the host gives.
#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "device_run.hpp"
#include "engine/domain/drawn.hpp"
#include "engine/domain/listed.hpp"
#include "sets.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {
namespace {

constexpr std::uint32_t kOneWeight = 1u << 24;

/// Returns random points, as many in each face, also of masked ones.
std::vector<ListedCandidate> random_candidates(const PreparedMesh& mesh, std::size_t count) {
    std::mt19937 random(1);
    const auto below = [&](std::uint32_t end) {
        return static_cast<std::uint32_t>(std::uint64_t{random()} * end >> 32);
    };
    std::vector<ListedCandidate> points;
    while (points.size() < count) {
        const std::uint32_t face = below(mesh.face_count());
        const std::uint32_t weight1 = below(kOneWeight + 1);
        points.push_back({face, weight1, below(kOneWeight + 1 - weight1)});
    }
    return points;
}

/// Checks that a run decides the candidates as the twin does, also if it has little room.
void check_as_twin(const PreparedMesh& mesh, const SampleParams& params, std::size_t count) {
    const auto candidates = random_candidates(mesh, count);
    const Domain domain = expect(listed_domain(mesh, params, candidates));
    RunnerOptions narrow;
    narrow.plan.slots = 16;
    narrow.plan.stages = 3;
    for (const RunnerOptions& options : {RunnerOptions(), narrow}) {
        Runner runner =
            expect(Runner::create(shared_context().device(), shared_context().queue(), options));
        const SampleSet set = expect(runner.sample_and_wait(domain));
        CHECK(set.existing == params.existing.size());
        CHECK(set.report.candidates == count);
        CHECK(test::points_of(set) ==
              listed_set(mesh, params, set.report.plan.error_bound, points_of(candidates)));
    }
}

/// Checks that a run over the candidates that the host draws returns the set of a plain run.
void check_drawn(const PreparedMesh& mesh, const SampleParams& params) {
    const JobFrame frame = expect(frame_of(mesh, params));
    const CandidateDraw draw(mesh, params, frame);
    std::vector<DrawnCandidate> drawn;
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        for (std::uint32_t stage = 0; stage < draw.stages().pool_stages(); ++stage) {
            draw.draw(face, stage, drawn);
        }
    }
    std::ranges::sort(drawn, [](const DrawnCandidate& a, const DrawnCandidate& b) {
        return is_before(a, b, false);
    });
    std::vector<ListedCandidate> candidates;
    for (const DrawnCandidate& candidate : drawn) {
        candidates.push_back(candidate.point);
    }
    Runner runner = expect(Runner::create(shared_context().device(), shared_context().queue()));
    const Domain domain = expect(listed_domain(mesh, params, frame, candidates));
    CHECK(test::points_of(expect(runner.sample_and_wait(domain))) ==
          test::points_of(sample(mesh, params)));
}

std::string refusal(const std::vector<ListedCandidate>& candidates, std::uint32_t darts = 0) {
    const PreparedMesh mesh = prepared(builtin("cube", 1));
    SampleParams params = params_for(mesh, 100);
    params.darts = darts;
    const auto domain = listed_domain(mesh, params, candidates);
    REQUIRE_FALSE(domain);
    CHECK(domain.error().status == Status::invalid_argument);
    return domain.error().message;
}

} // namespace

TEST_SUITE("listed") {
    TEST_CASE("listed candidates are decided in their order, as the twin does") {
        const PreparedMesh knot = prepared(builtin("torus-knot", 8));
        check_as_twin(knot, params_for(knot, 200), 3000);
        check_as_twin(knot, params_for(knot, 200), 1);
        const RadiusField radii = radius_field(knot, wavy_factors(builtin("torus-knot", 8), 0.3));
        check_as_twin(knot, params_for(knot, 200, 1, &radii), 3000);
        SampleParams settled = params_for(knot, 200);
        const std::vector<Sample> given = sample(knot, settled).samples;
        settled.existing = std::span(given).first(60);
        check_as_twin(knot, settled, 2000);
    }

    TEST_CASE("candidates that the host draws give the set of those that kernels draw") {
        for (const TestMesh& shape : {builtin("torus-knot", 8), builtin("cube", 1)}) {
            const PreparedMesh mesh = prepared(shape);
            const RadiusField radii = radius_field(mesh, wavy_factors(shape, 0.3));
            check_drawn(mesh, params_for(mesh, 700, 3));
            check_drawn(mesh, params_for(mesh, 700, 3, &radii));
        }
    }

    TEST_CASE("in faces of many cells") {
        const PreparedMesh cube = prepared(builtin("cube", 1));
        check_as_twin(cube, params_for(cube, 500), 5000);
        check_as_twin(cube, params_for(cube, 20), 300);
        const RadiusField radii = radius_field(cube, wavy_factors(builtin("cube", 1), 0.3));
        check_as_twin(cube, params_for(cube, 500, 1, &radii), 5000);
    }

    TEST_CASE("bad lists are refused") {
        const PreparedMesh cube = prepared(builtin("cube", 1));
        SampleParams maximal = params_for(cube, 100);
        maximal.maximal = true;
        const ListedCandidate one{0, 1, 1};
        CHECK_FALSE(listed_domain(cube, maximal, {&one, 1}));
        CHECK(refusal({}) == "a list of candidates has 1 to 2^28, not 0");
        CHECK(refusal({{0, 1, 1}, {12, 0, 0}}) ==
              "listed candidate 1 is in face 12, but there are 12");
        CHECK(refusal({{0, kOneWeight, 1}}) ==
              "listed candidate 0 has weights that sum to more than 1");
        CHECK(refusal({{0, 1, 1}}, 5) == "candidates are listed, so there are no darts to throw");
    }
}

} // namespace geodisk::test
