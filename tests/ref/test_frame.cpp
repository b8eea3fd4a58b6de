// The frame of a job, as the library and as the reference derive it. They share no formula, so a
// wrong one shows here.
#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "engine/domain/stages.hpp"
#include "engine/domain/tolerances.hpp"
#include "lib/frame.hpp"
#include "lib/surface.hpp"
#include "ref/dart_check.hpp"
#include "support/radius_fields.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

/// Sums of areas are rounded in another order.
bool is_about(double a, double b) {
    return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b));
}

void check_tolerances(const Tolerances& a, const ref::Tolerances& b) {
    CHECK(a.limit == b.limit);
    CHECK(a.margin == b.margin);
    CHECK(a.slack == b.slack);
    CHECK(a.guard == b.guard);
    CHECK(a.error_bound == b.error_bound);
}

void check_frames(const PreparedMesh& mesh, const SampleParams& params) {
    const ref::Frame frame = ref::frame_of(mesh, params);
    CAPTURE(params.min_distance);
    CAPTURE(params.pool_ratio);
    CAPTURE(params.throws);
    CHECK(frame.unit == working_distance(mesh, params));
    const Stages stages = stages_of(mesh, params);
    CHECK(is_about(stages.samples, frame.stages.samples));
    CHECK(is_about(stages.ratio, frame.stages.ratio));
    CHECK(stages.pool_stages() == frame.stages.pool_stages());
    for (std::uint32_t stage = 0; stage < 40; ++stage) {
        CHECK(stage_intensity(mesh, params, stage) == frame.intensity(stage));
        CHECK(is_about(stages.expected(stage), frame.stages.expected(stage)));
    }
    const ErrorModel model(mesh, params);
    CHECK(first_error(mesh, params) == frame.first_error());
    for (const std::uint32_t crossings : {1u, 64u, 100u, 1000u, 70000u}) {
        CHECK(model.error_of(crossings) == frame.error_of(crossings));
    }
    for (const double larger : {1.0, 1.5, 2.0, 40.0, 10000.0}) {
        const double error = larger * frame.first_error();
        check_tolerances(model.tolerances(error), frame.tolerances(error));
    }
    CHECK(has_small_faces(mesh, params) == ref::Surface<float>(mesh, params).one_cell_each);
}

std::vector<TestMesh> shapes() {
    return {builtin("icosphere", 3),
            builtin("torus-knot", 6),
            builtin("cone", 4),
            flat_obtuse_fan(40),
            flat_lines({0, 0.1, 0.11, 1}, {0, 0.5, 0.7, 1}),
            needle_sheets(),
            tetrahedra(2, 0.1),
            two_sided_square(),
            all_triangles(6)};
}

} // namespace

TEST_CASE("frame: of the library and of the reference are equal") {
    for (const TestMesh& mesh : shapes()) {
        const PreparedMesh surface = prepared(mesh);
        for (const double count : {0.001, 0.5, 1.0, 3.0, 40.0, 700.0, 30000.0}) {
            SampleParams params = params_for(surface, count);
            for (const double ratio : {1.0, 7.5, 20.0, 100.0}) {
                params.pool_ratio = ratio;
                check_frames(surface, params);
            }
            for (const std::uint32_t darts : {1u, 1000u, 50'000'000u}) {
                params.throws = darts;
                check_frames(surface, params);
            }
        }
    }
}

TEST_CASE("frame: of the library and of the reference are equal where radii vary") {
    for (const TestMesh& mesh : {builtin("icosphere", 3), builtin("torus-knot", 6)}) {
        for (const double least : {0.001, 0.3, 1.0}) {
            const FieldCase waves(mesh, radius_field, wavy_factors(mesh, least));
            const FieldCase density(mesh, density_field, rough_density(mesh));
            for (const double count : {0.01, 2.0, 40.0, 20000.0}) {
                check_frames(waves.surface, waves.params(count));
                check_frames(density.surface, density.params(count));
            }
        }
    }
}
