// Maximal sets: no sample fits anywhere else.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "coverage.hpp"
#include "device_run.hpp"
#include "maximal.hpp"
#include "sets.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {
namespace {

/// Checks by the reference, in double precision, that no point is uncovered.
void check_covered(const PreparedMesh& mesh, const SampleParams& params, const SampleSet& set) {
    ref::Surface<double> surface(mesh, params.min_distance);
    surface.one_cell_each = true;
    const double unit = surface.frame.unit;
    std::vector<double> corners;
    if (params.radii != nullptr) {
        for (const float g : params.radii->factors()) {
            corners.push_back(0.5 * double{g});
        }
    }
    ref::CoverageCheck check(surface, corners, 1 + 2 * set.report.guard);
    for (const Sample& s : set.samples) {
        const double g = params.radii != nullptr ? params.radii->factor_at(s.face, s.weights) : 1;
        check.add_sample({s.face, s.weights[1], s.weights[2]}, g * params.min_distance / 2 / unit);
    }
    for (const auto& [center, radius] : params.avoid) {
        check.add_avoided({center.face, center.weights[1], center.weights[2]}, radius / unit);
    }
    check.sort();
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        if (params.face_mask.empty() || params.face_mask[face] != 0) {
            check.test(face);
        }
    }
    CHECK_FALSE(check.result().uncovered.has_value());
    CHECK(check.result().largest > 0.9);
}

/// Checks that the sequential twin fills the same gaps.
void check_as_twin(const PreparedMesh& mesh, const SampleParams& params, const SampleSet& set) {
    const ref::MaximalSet twin = ref::maximal_set<float>(mesh, params, set.report.plan.error_bound);
    Points points;
    for (const auto& [face, weight1, weight2] : twin.samples) {
        points.push_back({face, static_cast<float>(weight1), static_cast<float>(weight2)});
    }
    CHECK(twin.is_complete == set.report.maximal.certified);
    CHECK(twin.rounds == set.report.maximal.rounds);
    CHECK(points == points_of(set));
}

/// Returns the maximal set, after checking that it is one and certified, and begins with the
/// pool's.
SampleSet check_maximal(const PreparedMesh& mesh, SampleParams params) {
    const SampleSet pool = sample(mesh, params);
    params.maximal = true;
    const SampleSet set = sample(mesh, params);
    const Points points = points_of(set), first = points_of(pool);
    REQUIRE(points.size() >= first.size());
    CHECK(std::equal(first.begin(), first.end(), points.begin()));
    CHECK(set.existing == params.existing.size());
    CHECK(set.report.maximal.certified);
    CHECK(set.report.maximal.largest_gap ==
          doctest::Approx(params.min_distance * (1 + 2 * set.report.guard)));
    CHECK(set.report.disks < 3 * set.samples.size() + 20);
    check_covered(mesh, params, set);
    check_as_twin(mesh, params, set);
    return set;
}

/// Checks that the set is the same with few candidates at a time, records of lights read in parts,
/// and other kernels.
void check_narrow(const PreparedMesh& mesh, SampleParams params, const SampleSet& set) {
    params.maximal = true;
    RunnerOptions narrow;
    narrow.plan.slots = 16;
    narrow.plan.disks_by = DisksBy::groups;
    narrow.sampler.tuning.reads = Reads::storage;
    narrow.device_bytes = 4 << 20;
    const SampleSet found = sample(mesh, params, narrow);
    CHECK(points_of(found) == points_of(set));
    CHECK(found.report.candidates == set.report.candidates);
}

std::string refusal(const PreparedMesh& mesh, SampleParams params) {
    params.maximal = true;
    const auto domain = Domain::surface(mesh, params);
    REQUIRE_FALSE(domain);
    CHECK(domain.error().status == Status::invalid_argument);
    return domain.error().message;
}

} // namespace

TEST_SUITE("maximal") {
    TEST_CASE("no point is left uncovered") {
        const PreparedMesh knot = prepared(builtin("torus-knot", 8));
        const SampleSet set = check_maximal(knot, params_for(knot, 200));
        CHECK(set.report.maximal.rounds > 0);
        CHECK(set.report.maximal.cells > knot.face_count());
        check_narrow(knot, params_for(knot, 200), set);
        for (const PreparedMesh& mesh :
             {prepared(builtin("cube", 1)), prepared(builtin("icosphere", 3)),
              prepared(builtin("plate", 4))}) {
            check_maximal(mesh, params_for(mesh, 120));
        }
    }

    TEST_CASE("with radii that vary, existing samples, points to avoid and masks") {
        const TestMesh shape = builtin("torus-knot", 8);
        const PreparedMesh knot = prepared(shape);
        const RadiusField radii = radius_field(knot, wavy_factors(shape, 0.3));
        const SampleParams varying = params_for(knot, 150, 1, &radii);
        check_narrow(knot, varying, check_maximal(knot, varying));
        SampleParams params = params_for(knot, 150);
        const std::vector<Sample> given = sample(knot, params_for(knot, 20, 7)).samples;
        params.existing = given;
        const std::vector<KeepOut> avoid{{{5, {0.25f, 0.5f, 0.25f}}, 3 * params.min_distance},
                                         {{90, {0.25f, 0.5f, 0.25f}}, params.min_distance / 3}};
        params.avoid = avoid;
        std::vector<std::uint8_t> mask(knot.face_count(), 1);
        std::fill_n(mask.begin(), mask.size() / 2, std::uint8_t{0});
        params.face_mask = mask;
        check_narrow(knot, params, check_maximal(knot, params));
    }

    TEST_CASE("a mesh that the device cannot hold has the set of the whole") {
        const TestMesh shape = builtin("terrain", 120);
        const PreparedMesh terrain = prepared(shape);
        RunnerOptions little; // Less than the faces and their fans take.
        little.device_bytes = 3 << 20;
        const auto check = [&](SampleParams params) {
            params.maximal = true;
            const SampleSet whole = sample(terrain, params);
            const SampleSet divided = sample(terrain, params, little);
            CHECK(points_of(divided) == points_of(whole));
            CHECK(divided.existing == whole.existing);
            CHECK(divided.report.candidates == whole.report.candidates);
            CHECK(divided.report.maximal.certified);
            CHECK(divided.report.maximal.rounds == whole.report.maximal.rounds);
            CHECK(divided.report.maximal.cells == whole.report.maximal.cells);
            CHECK(divided.report.maximal.largest_gap == whole.report.maximal.largest_gap);
            CHECK(divided.report.device_bytes <= little.device_bytes);
        };
        SampleParams params = params_for(terrain, 1200);
        const std::vector<Sample> given = sample(terrain, params_for(terrain, 100, 7)).samples;
        params.existing = given;
        std::vector<KeepOut> avoid; // Some are at borders of parts.
        for (std::uint32_t face = 99; face < terrain.face_count(); face += 1187) {
            avoid.push_back({{face, {0.25f, 0.5f, 0.25f}}, 2 * params.min_distance});
        }
        params.avoid = avoid;
        std::vector<std::uint8_t> mask(terrain.face_count(), 1);
        std::fill_n(mask.begin(), mask.size() / 3, std::uint8_t{0});
        params.face_mask = mask;
        check(params);
        const RadiusField radii = radius_field(terrain, wavy_factors(shape, 0.5));
        check(params_for(terrain, 1000, 1, &radii));
    }

    TEST_CASE("four samples saturate a sphere at a quarter of its girth") {
        // Chen and Holmes-Cerfon 2017. Triangles make the sphere a little smaller.
        const PreparedMesh sphere = prepared(builtin("icosphere", 4));
        SampleParams params;
        params.min_distance = 1.5707 * std::sqrt(sphere.statistics().area / 12.566370614359172);
        params.maximal = true;
        for (params.seed = 1; params.seed <= 5; ++params.seed) {
            CHECK(sample(sphere, params).samples.size() == 4);
        }
    }

    TEST_CASE("progress is heard, and a run can be cancelled in any job") {
        const PreparedMesh knot = prepared(builtin("torus-knot", 8));
        SampleParams params = params_for(knot, 300);
        params.maximal = true;
        Runner runner = expect(Runner::create(shared_context().device(), shared_context().queue()));
        std::size_t calls = 0;
        const SampleSet set = expect(runner.sample_and_wait(knot, params, [&](const Progress&) {
            ++calls;
            return true;
        }));
        REQUIRE(calls > 10);
        for (const std::size_t last : {1u, 3u, 8u}) {
            std::size_t heard = 0;
            const auto cancelled = runner.sample_and_wait(
                knot, params, [&](const Progress&) { return ++heard < last; });
            REQUIRE_FALSE(cancelled);
            CHECK(cancelled.error().status == Status::cancelled);
        }
        CHECK(points_of(expect(runner.sample_and_wait(knot, params))) == points_of(set));
    }

    TEST_CASE("what contradicts it is refused") {
        const TestMesh shape = builtin("cube", 1);
        const PreparedMesh cube = prepared(shape);
        SampleParams params = params_for(cube, 100);
        params.darts = 5;
        CHECK(refusal(cube, params) ==
              "maximal and darts exclude each other: darts are no pool to complete");
        params = params_for(cube, 100);
        params.stop_count = 5;
        CHECK(refusal(cube, params) == "maximal and stop_count exclude each other: a count drops "
                                       "the last samples, which leaves gaps");
        const auto density =
            RadiusField::from_density(cube, std::vector<double>(cube.vertex_count(), 1));
        params = params_for(cube, 100, 1, &*density);
        CHECK(refusal(cube, params) ==
              "maximal and density exclude each other: a density leaves gaps by chance");
        params = params_for(cube, 100);
        const std::vector<float> classes{1, 0.5f, 0.5f, 1};
        params.class_factors = classes;
        CHECK(refusal(cube, params) == "maximal and class_factors exclude each other: gaps are "
                                       "those of samples without classes");
        params = params_for(cube, 100);
        params.maximal = true;
        const SurfacePart part{&cube, params};
        CHECK_FALSE(Domain::surfaces({&part, 1}));
        const Domain domain = expect(Domain::surface(cube, params));
        CHECK_THROWS_WITH_AS(DeviceRun run(domain),
                             "a maximal set takes several jobs; sample it with Runner",
                             std::runtime_error);
    }
}

} // namespace geodisk::test
