// Face masks: sets against those of the twins, and against the candidates without a mask.
#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include <geodisk/domain.hpp>

#include "device_run.hpp"
#include "kernels/pool.hpp"
#include "kernels/space.hpp"
#include "lib/frame.hpp"
#include "sets.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {
namespace {

using Mask = std::vector<std::uint8_t>;

/// Checks that the set is that of both twins, and in the mask.
Points check_masked(const PreparedMesh& mesh, const SampleParams& params,
                    const RunnerOptions& options = {}) {
    const SampleSet set = sample(mesh, params, options);
    const double bound = set.report.plan.error_bound;
    Points points = points_of(set);
    CHECK(points.size() > 0);
    CHECK(points == float_set(mesh, params, bound));
    CHECK(points == double_set(mesh, params, bound));
    CHECK(std::ranges::all_of(
        points, [&](const SamplePoint& point) { return params.face_mask[point.face] != 0; }));
    return points;
}

Mask every(std::uint32_t faces, std::uint32_t step) {
    Mask mask(faces, 0);
    for (std::uint32_t face = 0; face < faces; face += step) {
        mask[face] = 1;
    }
    return mask;
}

} // namespace

TEST_SUITE("masks") {
    TEST_CASE("sets of a masked surface") {
        for (const auto& [name, resolution, count] :
             {std::tuple{"torus-knot", 8, 300.0}, {"icosphere", 3, 40.0}, {"cube", 1, 2000.0}}) {
            const char* const shown = name;
            CAPTURE(shown);
            const TestMesh shape = builtin(name, resolution);
            const PreparedMesh mesh = prepared(shape);
            SampleParams params = params_for(mesh, count, 3);
            for (const Mask& mask : {mask_above(shape, 0), every(mesh.face_count(), 3)}) {
                params.face_mask = mask;
                check_masked(mesh, params);
            }
        }
    }

    TEST_CASE("a mask of all faces changes nothing") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 8));
        SampleParams params = params_for(mesh, 300, 3);
        const Points all = points_of(sample(mesh, params));
        const Mask mask(mesh.face_count(), 1);
        params.face_mask = mask;
        CHECK(points_of(sample(mesh, params)) == all);
    }

    TEST_CASE("in pieces of the pool, by darts, with a stop count, and on a few faces") {
        const TestMesh shape = builtin("torus-knot", 8);
        const PreparedMesh mesh = prepared(shape);
        const Mask half = mask_above(shape, 1);
        SampleParams params = params_for(mesh, 2000, 5);
        params.face_mask = half;
        RunnerOptions few;
        few.plan.stages = 1;
        const Points whole = check_masked(mesh, params);
        CHECK(check_masked(mesh, params, few) == whole);
        params.stop_count = 100;
        CHECK(check_masked(mesh, params) == Points(whole.begin(), whole.begin() + 100));
        params.stop_count = 0;
        params.darts = 5000;
        check_masked(mesh, params);
        // The least pool is that of the faces left.
        params = params_for(mesh, 2, 5);
        Mask one(mesh.face_count(), 0);
        one[17] = 1;
        params.face_mask = one;
        CHECK(check_masked(mesh, params).size() == 1);
    }

    TEST_CASE("with radii that vary, and keys") {
        const TestMesh shape = builtin("torus-knot", 8);
        const PreparedMesh mesh = prepared(shape);
        const Mask half = mask_above(shape, 0);
        const RadiusField waves = radius_field(mesh, wavy_factors(shape, 0.2));
        const RadiusField density = density_field(mesh, rough_density(shape));
        std::vector<std::uint32_t> keys(mesh.face_count());
        std::iota(keys.rbegin(), keys.rend(), 1000u);
        for (const RadiusField* field :
             {static_cast<const RadiusField*>(nullptr), &waves, &density}) {
            SampleParams params = params_for(mesh, 400, 7, field);
            params.face_mask = half;
            check_masked(mesh, params);
            params.face_keys = keys;
            check_masked(mesh, params);
        }
    }

    TEST_CASE("with existing samples, which may lie on faces that the mask leaves out") {
        const TestMesh shape = builtin("torus-knot", 8);
        const PreparedMesh mesh = prepared(shape);
        SampleParams params = params_for(mesh, 300, 3);
        std::vector<Sample> given = sample(mesh, params).samples;
        given.resize(60);
        Points settled;
        for (const Sample& one : given) {
            settled.push_back({one.face, one.weights[1], one.weights[2]});
        }
        const Mask half = mask_above(shape, 0);
        CHECK(std::ranges::any_of(given, [&](const Sample& one) { return half[one.face] == 0; }));
        params.face_mask = half;
        params.seed = 4;
        const SampleParams alone = params;
        params.existing = given;
        const SampleSet set = sample(mesh, params);
        const Points points = points_of(set);
        CHECK(points == set_after(mesh, alone, set.report.plan.error_bound, settled));
        CHECK(std::ranges::all_of(points.begin() + 60, points.end(),
                                  [&](const SamplePoint& point) { return half[point.face] != 0; }));
    }

    TEST_CASE("in more than three dimensions") {
        TestMesh shape = builtin("cube", 6);
        TestMesh lifted;
        lifted.dimension = 4;
        lifted.triangles = shape.triangles;
        for (std::uint32_t v = 0; v < shape.vertex_count(); ++v) {
            const Vec3 p = shape.vertex(v);
            lifted.positions.insert(lifted.positions.end(), {p.x, p.y, p.z, p.x * p.y});
        }
        const PreparedMesh mesh = prepared(lifted);
        const Mask half = mask_above(shape, 2);
        SampleParams params = params_for(mesh, 300, 2);
        params.face_mask = half;
        check_masked(mesh, params);
    }

    TEST_CASE("several surfaces, of which some have masks") {
        const TestMesh knot_shape = builtin("torus-knot", 8);
        const PreparedMesh knot = prepared(knot_shape);
        const PreparedMesh cube = prepared(builtin("cube", 1));
        const Mask half = mask_above(knot_shape, 0);
        const Mask side = every(cube.face_count(), 5);
        std::vector<SurfacePart> parts{{&knot, params_for(knot, 300, 1)},
                                       {&cube, params_for(cube, 500, 2)},
                                       {&knot, params_for(knot, 200, 3)},
                                       {&cube, params_for(cube, 100, 4)}};
        parts[1].params.face_mask = side;
        parts[2].params.face_mask = half;
        const Domain domain = expect(Domain::surfaces(parts));
        Runner runner = expect(Runner::create(shared_context().device(), shared_context().queue()));
        const Points together = points_of(expect(runner.sample_and_wait(domain)));
        const auto first = domain.first_faces();
        for (std::size_t i = 0; i < parts.size(); ++i) {
            Points own;
            for (SamplePoint point : together) {
                if (point.face >= first[i] && point.face < first[i + 1]) {
                    point.face -= first[i];
                    own.push_back(point);
                }
            }
            CHECK(own == points_of(sample(*parts[i].mesh, parts[i].params)));
        }
    }

    TEST_CASE("by straight-line distance") {
        const TestMesh shape = builtin("folded-sheet", 8);
        const PreparedMesh mesh = prepared(shape);
        SampleParams params = params_for(mesh, 400, 6);
        const Mask half = mask_above(shape, 0);
        params.face_mask = half;
        Runner runner = expect(Runner::create(shared_context().device(), shared_context().queue()));
        const SampleSet set = expect(runner.sample_and_wait(
            expect(Domain::surface_in_space(shape.view(), mesh, params, Metric::euclidean))));
        const auto candidates =
            ref::draw_pool(ref::Surface<double>(mesh, params), params).by_rank();
        const ref::SpacePoints points = ref::draw_in_space(shape.view(), mesh, params);
        Points twin;
        for (const std::uint32_t rank : ref::throw_darts(ref::space_pool<float>(points, false))) {
            const Point& c = candidates[rank];
            twin.push_back({c.face, static_cast<float>(c.weight1), static_cast<float>(c.weight2)});
        }
        CHECK(twin.size() > 50);
        CHECK(points_of(set) == twin);
    }
}

} // namespace geodisk::test
