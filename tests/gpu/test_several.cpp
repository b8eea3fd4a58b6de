// Several surfaces in one job.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "device_run.hpp"
#include "engine/domain/drawn.hpp"
#include "lib/frame.hpp"
#include "sets.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {
namespace {

/// Returns the points of each surface, faces counted from its own first.
std::vector<Points> points_by_surface(const Domain& domain, const SampleSet& set) {
    const auto first_faces = domain.first_faces();
    std::vector<Points> points(first_faces.size() - 1);
    for (SamplePoint point : points_of(set)) {
        const auto after = std::upper_bound(first_faces.begin(), first_faces.end(), point.face);
        const auto surface = static_cast<std::size_t>(after - first_faces.begin() - 1);
        point.face -= first_faces[surface];
        points.at(surface).push_back(point);
    }
    return points;
}

void check_each_alone(const std::vector<SurfacePart>& parts) {
    const Domain domain = expect(Domain::surfaces(parts));
    Context& context = shared_context();
    Runner runner = expect(Runner::create(context.device(), context.queue()));
    const SampleSet set = expect(runner.sample_and_wait(domain));
    const auto points = points_by_surface(domain, set);
    REQUIRE(points.size() == parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        CAPTURE(i);
        SampleParams params = parts[i].params;
        params.min_distance /= parts[i].scale;
        CHECK(points[i] == float_set(*parts[i].mesh, params,
                                     ref::frame_of(*parts[i].mesh, params).first_error()));
        CHECK(points[i] == points_of(sample(*parts[i].mesh, params)));
    }
}

SampleParams with_pool(SampleParams params, double ratio) {
    params.pool_ratio = ratio;
    return params;
}

std::string surfaces_refusal(const std::vector<SurfacePart>& parts) {
    const auto domain = Domain::surfaces(parts);
    REQUIRE_FALSE(domain);
    CHECK(domain.error().status == Status::invalid_argument);
    return domain.error().message;
}

/// Returns the seed, of the first so many, with the most candidates in all stages.
std::uint64_t fullest_seed(const PreparedMesh& mesh, SampleParams params, std::uint64_t seeds) {
    const JobFrame frame = expect(frame_of(mesh, params));
    std::size_t most = 0;
    std::uint64_t fullest = 0;
    for (params.seed = 0; params.seed < seeds; ++params.seed) {
        const CandidateDraw draw(mesh, params, frame);
        std::vector<DrawnCandidate> drawn;
        for (std::uint32_t stage = 0; stage < draw.stages().pool_stages(); ++stage) {
            for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
                draw.draw(face, stage, drawn);
            }
        }
        if (drawn.size() > most) {
            most = drawn.size();
            fullest = params.seed;
        }
    }
    return fullest;
}

/// A ball stretched by `by` along one axis.
PreparedMesh stretched_ball(int level, double by) {
    TestMesh shape = builtin("icosphere", level);
    for (std::size_t i = 0; i < shape.positions.size(); i += 3) {
        shape.positions[i] *= by;
    }
    return prepared(shape);
}

} // namespace

TEST_SUITE("several") {
    TEST_CASE("each surface gets the samples that it gets alone") {
        const PreparedMesh knot = prepared(builtin("torus-knot", 8));
        const PreparedMesh ball = prepared(builtin("icosphere", 3));
        const PreparedMesh cube = prepared(builtin("cube", 1));
        const PreparedMesh terrain = prepared(builtin("terrain", 24));
        std::vector<std::uint32_t> keys(knot.face_count());
        std::iota(keys.rbegin(), keys.rend(), 1000u);
        SampleParams keyed = params_for(knot, 400, 1);
        keyed.face_keys = keys;
        SUBCASE("of small faces") {
            check_each_alone({{&ball, params_for(ball, 100, 5)},
                              {&knot, params_for(knot, 300, 6)},
                              {&knot, keyed},
                              {&terrain, params_for(terrain, 200, std::uint64_t{7} << 40)}});
        }
        SUBCASE("of large ones, and of both") {
            check_each_alone({{&knot, params_for(knot, 300, 1)},
                              {&cube, params_for(cube, 3000, 1)},
                              {&ball, params_for(ball, 100, 1)},
                              {&cube, params_for(cube, 200, 2)}});
        }
        SUBCASE("with pools of their own, down to a surface that holds one sample") {
            check_each_alone({{&ball, with_pool(params_for(ball, 300, 3), 1)},
                              {&ball, params_for(ball, 0.01, 4)},
                              {&knot, with_pool(params_for(knot, 50, 5), 60)},
                              {&cube, params_for(cube, 2, 6)}});
        }
        SUBCASE("whose disks trim their windows") {
            const PreparedMesh tube = prepared(builtin("tube", 6));
            const PreparedMesh volume = prepared(tetrahedra(3, 0.15));
            SampleParams long_way;
            long_way.min_distance = 1;
            SampleParams wide;
            wide.min_distance = 1.7;
            check_each_alone({{&ball, params_for(ball, 100, 5)},
                              {&tube, long_way},
                              {&volume, wide},
                              {&volume, wide, 2}});
        }
        SUBCASE("as instances of several sizes") {
            SampleParams params = params_for(ball, 200);
            check_each_alone({{&ball, params, 1}, {&ball, params, 2}, {&ball, params, 0.3}});
        }
        SUBCASE("of one alone") {
            check_each_alone({{&knot, params_for(knot, 100)}});
        }
    }

    TEST_CASE("radii vary over each of them") {
        const TestMesh knot_shape = builtin("torus-knot", 8);
        const TestMesh terrain_shape = builtin("terrain", 16);
        const PreparedMesh knot = prepared(knot_shape);
        const PreparedMesh terrain = prepared(terrain_shape);
        const RadiusField of_knot = radius_field(knot, wavy_factors(knot_shape, 0.2));
        const RadiusField of_terrain = radius_field(terrain, rough_factors(terrain_shape, 0.1));
        const RadiusField density = density_field(knot, rough_density(knot_shape));
        check_each_alone({{&knot, params_for(knot, 300, 1, &of_knot)},
                          {&terrain, params_for(terrain, 500, 2, &of_terrain)},
                          {&knot, params_for(knot, 100, 3, &of_knot), 0.5},
                          {&knot, params_for(knot, 200, 4, &density)}});
        const std::string message = surfaces_refusal(
            {{&knot, params_for(knot, 300, 1, &of_knot)}, {&knot, params_for(knot, 300)}});
        CHECK(message == "surface 1: some surfaces have radii that vary, others have not");
    }

    TEST_CASE("many props, in parts where the pool must be small") {
        const PreparedMesh knot = prepared(builtin("torus-knot", 4));
        std::vector<SurfacePart> parts;
        for (std::uint64_t i = 0; i < 200; ++i) {
            parts.push_back({&knot, params_for(knot, 20 + static_cast<double>(i % 7), i)});
        }
        const Domain domain = expect(Domain::surfaces(parts));
        const Points whole = points_of([&] {
            Runner runner =
                expect(Runner::create(shared_context().device(), shared_context().queue()));
            return expect(runner.sample_and_wait(domain));
        }());
        CHECK(whole.size() > 3000);
        RunnerOptions options;
        options.plan.stages = 1;
        options.plan.slots = 32;
        options.pool_bytes = std::uint64_t{1} << 20;
        Runner runner =
            expect(Runner::create(shared_context().device(), shared_context().queue(), options));
        CHECK(points_of(expect(runner.sample_and_wait(domain))) == whole);
    }

    TEST_CASE("a thousand equal surfaces have equal samples, also where a seed draws very many") {
        const PreparedMesh ball = prepared(builtin("icosphere", 1));
        SampleParams params = params_for(ball, 12);
        params.seed = fullest_seed(ball, params, 64);
        const Points alone = points_of(sample(ball, params));
        const Domain domain =
            expect(Domain::surfaces(std::vector<SurfacePart>(1000, {&ball, params})));
        Runner runner = expect(Runner::create(shared_context().device(), shared_context().queue()));
        const SampleSet set = expect(runner.sample_and_wait(domain));
        const auto points = points_by_surface(domain, set);
        CHECK(std::ranges::count(points, alone) == 1000);
        CHECK(set.report.batches < 300);
        RunnerOptions options;
        options.plan.stages = 1;
        options.plan.slots = 200;
        Runner small =
            expect(Runner::create(shared_context().device(), shared_context().queue(), options));
        CHECK(points_of(expect(small.sample_and_wait(domain))) == points_of(set));
    }

    TEST_CASE("different surfaces with equal faces and one seed") {
        std::vector<PreparedMesh> balls;
        for (int i = 0; i < 80; ++i) {
            balls.push_back(stretched_ball(1, 1 + 0.01 * i));
        }
        std::vector<SurfacePart> parts;
        for (const PreparedMesh& ball : balls) {
            parts.push_back({&ball, params_for(ball, 15)});
        }
        const Domain domain = expect(Domain::surfaces(parts));
        Runner runner = expect(Runner::create(shared_context().device(), shared_context().queue()));
        const auto points = points_by_surface(domain, expect(runner.sample_and_wait(domain)));
        for (std::size_t i = 0; i < parts.size(); ++i) {
            CAPTURE(i);
            CHECK(points[i] == float_set(balls[i], parts[i].params,
                                         ref::frame_of(balls[i], parts[i].params).first_error()));
        }
    }

    TEST_CASE("what cannot be is refused, by the part") {
        const PreparedMesh ball = prepared(builtin("icosphere", 2));
        const SampleParams good = params_for(ball, 50);
        CHECK(surfaces_refusal({}) == "there are no surfaces");
        CHECK(surfaces_refusal({{&ball, good}, {nullptr, good}}) == "surface 1: there is no mesh");
        SampleParams bad = good;
        bad.min_distance = -1;
        CHECK(surfaces_refusal({{&ball, good}, {&ball, good}, {&ball, bad}}) ==
              "surface 2: the minimum distance must be a positive finite number, not -1");
        const std::pair<double, std::string> scales[] = {
            {0.0, "0"},
            {-1.0, "-1"},
            {std::numeric_limits<double>::infinity(), "inf"},
            {std::numeric_limits<double>::quiet_NaN(), "nan"},
        };
        for (const auto& scale : scales) {
            CHECK(surfaces_refusal({{&ball, good, scale.first}}) ==
                  "surface 0: the scale must be a positive finite number, not " + scale.second);
        }
        SampleParams thrown = good;
        thrown.darts = 100;
        SampleParams stopped = good;
        stopped.stop_count = 10;
        for (const SampleParams& counted : {thrown, stopped}) {
            CHECK(surfaces_refusal({{&ball, good}, {&ball, counted}}) ==
                  "surface 1: of several surfaces, darts and samples are not counted");
        }
        const std::string cells =
            surfaces_refusal({{&ball, good}, {&ball, with_pool(params_for(ball, 3e8), 1)}});
        CHECK(cells.starts_with("surface 1: the minimum distance is too small: face "));
        CHECK(cells.ends_with(" or with those before it takes more than 2^30 grid cells"));
    }
}

} // namespace geodisk::test
