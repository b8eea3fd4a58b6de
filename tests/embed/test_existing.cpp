// Samples that are given to a run: kept as its first ones, and new ones respect them.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "gpu/device_run.hpp"
#include "gpu/sets.hpp"
#include "lib/frame.hpp"
#include "support/geodesic_query.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {
namespace {

const TestMesh& knot() {
    static const TestMesh kMesh = builtin("torus-knot", 8);
    return kMesh;
}

std::vector<Sample> first_of(const SampleSet& set, std::size_t count) {
    return {set.samples.begin(), set.samples.begin() + static_cast<std::ptrdiff_t>(count)};
}

/// Checks that a run with existing samples is the twin's, also if it has little room.
void check_as_twin(const PreparedMesh& mesh, SampleParams params,
                   const std::vector<Sample>& given) {
    params.existing = given;
    RunnerOptions narrow;
    narrow.plan.slots = 16;
    narrow.plan.stages = 1;
    for (const RunnerOptions& options : {RunnerOptions(), narrow}) {
        const SampleSet set = sample(mesh, params, options);
        CHECK(set.existing == given.size());
        CHECK(points_of(set) == float_set(mesh, params, set.report.plan.error_bound));
        CHECK(set.samples.size() > given.size());
    }
}

/// Returns the mesh of some faces of another, with all its vertices.
TestMesh with_faces(const TestMesh& mesh, const std::vector<std::uint32_t>& faces) {
    TestMesh part = mesh;
    part.triangles.clear();
    for (const std::uint32_t face : faces) {
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            part.triangles.push_back(mesh.triangles[std::size_t{3} * face + corner]);
        }
    }
    return part;
}

/// Returns the smallest distance of two points, both in double precision; kUnreachable beyond
/// twice the distance expected.
double smallest_distance(const TestMesh& mesh, const std::vector<Point>& points, double expected) {
    GeodesicQuery<double> query(prepared(mesh), 2 * expected, points, tight_tolerances());
    double smallest = kUnreachable;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::vector<double> distances = query.from(points[i]);
        for (std::size_t k = 0; k < i; ++k) {
            smallest = std::min(smallest, distances[k]);
        }
    }
    return smallest;
}

std::string refusal(const PreparedMesh& mesh, const Sample& wrong, std::uint32_t stop_count = 0) {
    const std::vector<Sample> given{{0, {0.5f, 0.25f, 0.25f}}, wrong};
    SampleParams params = params_for(mesh, 100);
    params.existing = given;
    params.stop_count = stop_count;
    const auto domain = Domain::surface(mesh, params);
    REQUIRE_FALSE(domain);
    CHECK(domain.error().status == Status::invalid_argument);
    return domain.error().message;
}

} // namespace

TEST_SUITE("existing") {
    TEST_CASE("a run goes on from its own first samples") {
        const PreparedMesh mesh = prepared(knot());
        const RadiusField radii = radius_field(mesh, wavy_factors(knot(), 0.3));
        for (const RadiusField* const field : {static_cast<const RadiusField*>(nullptr), &radii}) {
            SampleParams params = params_for(mesh, 200, 1, field);
            const SampleSet whole = sample(mesh, params);
            CHECK(whole.existing == 0);
            for (const std::size_t count : {std::size_t{1}, whole.samples.size()}) {
                const std::vector<Sample> given = first_of(whole, count);
                params.existing = given;
                const SampleSet again = sample(mesh, params);
                CHECK(again.existing == count);
                CHECK(points_of(again) == points_of(whole));
            }
        }
    }

    TEST_CASE("any samples are kept, on vertices and edges too, and too close to each other") {
        const PreparedMesh mesh = prepared(knot());
        std::vector<Sample> given = sample(mesh, params_for(mesh, 30, 7)).samples;
        given.push_back({5, {1, 0, 0}});
        given.push_back({5, {0, 0, 1}});
        given.push_back({9, {0.5f, 0.5f, 0}});
        given.push_back({9, {0, 0.25f, 0.75f}});
        given.push_back(given.back());
        check_as_twin(mesh, params_for(mesh, 200), given);
        const RadiusField radii = radius_field(mesh, wavy_factors(knot(), 0.3));
        check_as_twin(mesh, params_for(mesh, 200, 1, &radii), given);
        SampleParams darts = params_for(mesh, 200);
        darts.darts = 3000;
        check_as_twin(mesh, darts, given);
        // More than the surface holds otherwise.
        check_as_twin(mesh, params_for(mesh, 20),
                      std::vector<Sample>(300, Sample{1, {0.5f, 0.25f, 0.25f}}));
    }

    TEST_CASE("they count towards a stop count") {
        const PreparedMesh mesh = prepared(knot());
        const SampleSet first = sample(mesh, params_for(mesh, 30, 7));
        const std::vector<Sample>& given = first.samples;
        SampleParams params = params_for(mesh, 200);
        params.existing = given;
        params.stop_count = static_cast<std::uint32_t>(given.size()) + 10;
        CHECK(sample(mesh, params).samples.size() == given.size() + 10);
        params.stop_count = static_cast<std::uint32_t>(given.size());
        const SampleSet all = sample(mesh, params);
        CHECK(all.samples.size() == given.size());
        CHECK(points_of(all) == points_of(first));
    }

    TEST_CASE("weights are rounded to multiples of 2^-24") {
        const PreparedMesh mesh = prepared(knot());
        const std::vector<Sample> given{{3, {0.333333343f, 0.333333343f, 0.333333343f}},
                                        {4, {0.000001f, 1.000003f, -0.000001f}}};
        SampleParams params = params_for(mesh, 100);
        params.existing = given;
        const SampleSet set = sample(mesh, params);
        for (std::size_t i = 0; i < given.size(); ++i) {
            const auto& weights = set.samples[i].weights;
            CHECK(double{weights[0]} + weights[1] + weights[2] == 1);
            for (std::size_t k = 0; k < 3; ++k) {
                CHECK(weights[k] >= 0);
                CHECK(weights[k] == doctest::Approx(given[i].weights[k]).epsilon(1e-5));
            }
        }
    }

    TEST_CASE("each of several surfaces has its own, and they come first") {
        const PreparedMesh ball = prepared(builtin("icosphere", 3));
        const PreparedMesh mesh = prepared(knot());
        const std::vector<Sample> given = sample(mesh, params_for(mesh, 30, 7)).samples;
        SampleParams params = params_for(mesh, 200);
        params.existing = given;
        const Domain domain = expect(Domain::surfaces(std::vector<SurfacePart>{
            {&ball, params_for(ball, 100)}, {&mesh, params}, {&mesh, params_for(mesh, 200)}}));
        Context& context = shared_context();
        Runner runner = expect(Runner::create(context.device(), context.queue()));
        const SampleSet set = expect(runner.sample_and_wait(domain));
        CHECK(set.existing == given.size());
        Points of_second;
        const std::uint32_t first = domain.first_faces()[1], last = domain.first_faces()[2];
        for (const SamplePoint& point : points_of(set)) {
            if (point.face >= first && point.face < last) {
                of_second.push_back({point.face - first, point.weight1, point.weight2});
            }
        }
        CHECK(of_second == points_of(sample(mesh, params)));
    }

    TEST_CASE("by distances through space as well") {
        const PreparedMesh mesh = prepared(knot());
        SampleParams params = params_for(mesh, 200);
        const auto run = [&] {
            const Domain domain =
                expect(Domain::surface_in_space(knot().view(), mesh, params, Metric::euclidean));
            Context& context = shared_context();
            Runner runner = expect(Runner::create(context.device(), context.queue()));
            return expect(runner.sample_and_wait(domain));
        };
        const SampleSet whole = run();
        const std::vector<Sample> given = first_of(whole, 50);
        params.existing = given;
        CHECK(points_of(run()) == points_of(whole));
    }

    TEST_CASE("a recorded job uploads those of its domain, and set_existing() replaces them") {
        const PreparedMesh mesh = prepared(knot());
        SampleParams params = params_for(mesh, 100);
        const std::vector<Sample> given = sample(mesh, params_for(mesh, 30, 7)).samples;
        params.existing = given;
        const Points wanted = points_of(sample(mesh, params));
        DeviceRun run(mesh, params);
        REQUIRE(run.follow_all().next == Next::complete);
        CHECK(ready_points(run) == wanted);
        run.job().set_seed(2);
        REQUIRE(run.follow_all().next == Next::complete);
        params.seed = 2;
        CHECK(ready_points(run) == points_of(sample(mesh, params)));
        expect(run.job().set_existing({}));
        run.job().set_seed(1);
        REQUIRE(run.follow_all().next == Next::complete);
        CHECK(ready_points(run) == points_of(sample(mesh, params_for(mesh, 100))));
    }

    TEST_CASE("a tile sampled with its neighbour's margin leaves no pair too close at the seam") {
        const TestMesh terrain = builtin("terrain", 24);
        const double distance = params_for(prepared(terrain), 400).min_distance;
        std::vector<std::uint32_t> west, east;
        double left = std::numeric_limits<double>::infinity(), right = -left;
        for (std::uint32_t v = 0; v < terrain.vertex_count(); ++v) {
            left = std::min(left, terrain.vertex(v)[0]);
            right = std::max(right, terrain.vertex(v)[0]);
        }
        const double seam = (left + right) / 2;
        const auto reaches = [&](std::uint32_t face, double x) {
            return std::max({terrain.corner(face, 0)[0], terrain.corner(face, 1)[0],
                             terrain.corner(face, 2)[0]}) > x;
        };
        for (std::uint32_t face = 0; face < terrain.face_count(); ++face) {
            if (!reaches(face, seam + 1e-9)) {
                west.push_back(face);
            }
            if (reaches(face, seam - distance)) {
                east.push_back(face);
            }
        }
        const auto tile = [&](const std::vector<std::uint32_t>& faces) {
            return prepared(with_faces(terrain, faces));
        };
        SampleParams params;
        params.min_distance = distance;
        std::vector<Point> all;
        std::vector<Sample> given;
        for (const Sample& s : sample(tile(west), params).samples) {
            const std::uint32_t face = west[s.face];
            all.push_back({face, s.weights[1], s.weights[2]});
            const auto at = std::ranges::find(east, face);
            if (at != east.end()) {
                given.push_back({static_cast<std::uint32_t>(at - east.begin()),
                                 {s.weights[0], s.weights[1], s.weights[2]}});
            }
        }
        REQUIRE(given.size() > 5);
        const std::size_t before = all.size();
        const auto add_east = [&] {
            all.resize(before);
            for (const Sample& s : sample(tile(east), params).samples) {
                const std::uint32_t face = east[s.face];
                if (!std::ranges::binary_search(west, face)) { // Not in the margin.
                    all.push_back({face, s.weights[1], s.weights[2]});
                }
            }
            return smallest_distance(terrain, all, distance);
        };
        CHECK(add_east() < distance);
        params.existing = given;
        CHECK(add_east() >= distance);
        CHECK(all.size() > before + 100);
    }

    TEST_CASE("existing samples far closer than the distance reject as if each had a whole disk") {
        const PreparedMesh mesh = prepared(knot());
        SampleParams params = params_for(mesh, 60);
        // On half of the knot: others have room there is, and the border crosses faces.
        std::vector<Sample> dense = sample(mesh, params_for(mesh, 1'200, 7)).samples;
        std::erase_if(dense, [&](const Sample& s) { return s.face > mesh.face_count() / 2; });
        REQUIRE(dense.size() > 400);
        check_as_twin(mesh, params, dense);
        params.existing = dense;
        const SampleSet set = sample(mesh, params);
        RunnerOptions groups;
        groups.plan.disks_by = DisksBy::groups;
        CHECK(points_of(sample(mesh, params, groups)) == points_of(set));
        // Points to avoid have whole disks.
        std::vector<KeepOut> avoid;
        for (const Sample& s : dense) {
            avoid.push_back({s, params.min_distance});
        }
        params.existing = {};
        params.avoid = avoid;
        const SampleSet others = sample(mesh, params);
        const Points all = points_of(set);
        const auto first_new = all.begin() + static_cast<std::ptrdiff_t>(set.existing);
        CHECK(Points(first_new, all.end()) == points_of(others));
        CHECK(set.report.disks == others.report.disks);
        CHECK(set.report.windows < others.report.windows / 2);
    }

    TEST_CASE("points are avoided by radii smaller and larger than the distance") {
        const PreparedMesh mesh = prepared(knot());
        const RadiusField radii = radius_field(mesh, wavy_factors(knot(), 0.3));
        SampleParams params = params_for(mesh, 400);
        const double distance = params.min_distance;
        const std::vector<KeepOut> avoid{{{40, {0.5f, 0.25f, 0.25f}}, 0.3 * distance},
                                         {{200, {1, 0, 0}}, distance},
                                         {{300, {0, 0.5f, 0.5f}}, 1.7 * distance},
                                         {{700, {0.25f, 0.25f, 0.5f}}, 5 * distance}};
        const std::vector<Sample> given = sample(mesh, params_for(mesh, 30, 7)).samples;
        for (const RadiusField* const field : {static_cast<const RadiusField*>(nullptr), &radii}) {
            params.radii = field;
            params.avoid = {};
            const std::size_t without = sample(mesh, params).samples.size();
            params.avoid = avoid;
            check_as_twin(mesh, params, {});
            check_as_twin(mesh, params, given);
            const SampleSet set = sample(mesh, params);
            CHECK(set.samples.size() < without - 20);
            for (const DisksBy who : {DisksBy::lanes, DisksBy::groups}) {
                RunnerOptions options;
                options.plan.disks_by = who;
                CHECK(points_of(sample(mesh, params, options)) == points_of(set));
            }
            CHECK(points_of(set) ==
                  double_set(mesh, params, ref::frame_of(mesh, params).first_error()));
            std::vector<Point> points;
            for (const SamplePoint& point : points_of(set)) {
                points.push_back({point.face, point.weight1, point.weight2});
            }
            for (const auto& [center, radius] : avoid) {
                const double reach = radius + 2 * distance;
                GeodesicQuery<double> query(prepared(knot()), reach, points, tight_tolerances());
                const std::vector<double> distances =
                    query.from({center.face, center.weights[1], center.weights[2]});
                const double smallest = *std::ranges::min_element(distances);
                CHECK(smallest >= radius);
                CHECK(smallest < reach);
            }
        }
    }

    TEST_CASE("the pool that the disks of points to avoid need is divided again after them") {
        const PreparedMesh mesh = prepared(knot());
        SampleParams params = params_for(mesh, 400);
        const std::vector<KeepOut> avoid{{{700, {0.25f, 0.25f, 0.5f}}, 9 * params.min_distance},
                                         {{40, {0.5f, 0.25f, 0.25f}}, 7 * params.min_distance}};
        params.avoid = avoid;
        RunnerOptions tight;
        tight.plan.slots = 64;
        tight.plan.list_capacity = 16;
        tight.plan.window_capacity = 16;
        // So short that no submission holds a whole chunk, however fast the device is.
        tight.submission_seconds = 1e-6;
        for (const std::uint32_t stages : {0u, 1u}) { // All in a chunk, or one in each.
            CAPTURE(stages);
            tight.plan.stages = stages;
            const SampleSet set = sample(mesh, params, tight);
            CHECK(points_of(set) == float_set(mesh, params, set.report.plan.error_bound));
            CHECK(set.report.regrown > 0);
            CHECK((stages == 0 || set.report.chunks > 1));
            // No disk of a sample is as large as those of the points.
            CHECK(set.report.plan.list_capacity < 512);
        }
    }

    TEST_CASE(
        "a batch that is decided in part is not restarted after the disks of points to avoid") {
        const PreparedMesh mesh = prepared(knot());
        SampleParams params = params_for(mesh, 60);
        const std::vector<KeepOut> avoid{{{700, {0.25f, 0.25f, 0.5f}}, 2 * params.min_distance}};
        params.avoid = avoid;
        RunnerOptions tight;
        tight.plan.slots = 200;
        tight.plan.list_capacity = 64;
        // When a submission ends depends on the speed of the device; of some that begin the first
        // batch, it is in the middle of its decisions.
        for (const double seconds : {0.01, 10.0}) {
            tight.submission_seconds = seconds;
            for (params.seed = 0; params.seed < 8; ++params.seed) {
                CAPTURE(seconds);
                CAPTURE(params.seed);
                const SampleSet set = sample(mesh, params, tight);
                CHECK(points_of(set) == float_set(mesh, params, set.report.plan.error_bound));
                CHECK(set.report.regrown > 0);
            }
        }
    }

    TEST_CASE("a point may keep out all, and a job counts and places the others") {
        const PreparedMesh mesh = prepared(knot());
        SampleParams params = params_for(mesh, 100);
        const SampleSet first = sample(mesh, params_for(mesh, 30, 7));
        const std::vector<Sample>& given = first.samples;
        std::vector<KeepOut> avoid{{{40, {0.5f, 0.25f, 0.25f}}, 1e30}};
        params.avoid = avoid;
        CHECK(sample(mesh, params).samples.empty());
        params.existing = given;
        CHECK(points_of(sample(mesh, params)) == points_of(first));
        avoid[0].radius = 2 * params.min_distance;
        params.existing = {};
        params.stop_count = 20;
        const SampleSet some = sample(mesh, params);
        CHECK(some.samples.size() == 20);
        CHECK(some.report.candidates > 20);
        CHECK(points_of(some) == float_set(mesh, params, some.report.plan.error_bound));
        // Another set of existing samples takes the place of the points.
        DeviceRun run(mesh, params);
        expect(run.job().set_existing({}));
        REQUIRE(run.follow_all().next == Next::complete);
        params.avoid = {};
        CHECK(ready_points(run) == points_of(sample(mesh, params)));
    }

    TEST_CASE("each of several surfaces has points of its own to avoid, in its scale") {
        const PreparedMesh mesh = prepared(knot());
        SampleParams params = params_for(mesh, 200);
        const std::vector<KeepOut> avoid{{{700, {0.25f, 0.25f, 0.5f}}, 3 * params.min_distance}};
        params.avoid = avoid;
        const Points alone = points_of(sample(mesh, params));
        SampleParams doubled = params;
        doubled.min_distance *= 2;
        std::vector<KeepOut> wide = avoid;
        wide[0].radius *= 2;
        doubled.avoid = wide;
        const Domain domain = expect(Domain::surfaces(
            std::vector<SurfacePart>{{&mesh, params_for(mesh, 200)}, {&mesh, doubled, 2}}));
        Context& context = shared_context();
        Runner runner = expect(Runner::create(context.device(), context.queue()));
        Points of_second;
        for (const SamplePoint& point : points_of(expect(runner.sample_and_wait(domain)))) {
            if (point.face >= mesh.face_count()) {
                of_second.push_back({point.face - mesh.face_count(), point.weight1, point.weight2});
            }
        }
        CHECK(of_second == alone);
    }

    TEST_CASE("points that cannot be avoided are refused, by their number") {
        const PreparedMesh mesh = prepared(knot());
        SampleParams params = params_for(mesh, 100);
        const auto refuses = [&](const KeepOut& wrong, const char* text) {
            const std::vector<KeepOut> avoid{{{0, {1, 0, 0}}, 0.1}, wrong};
            params.avoid = avoid;
            const auto domain = Domain::surface(mesh, params);
            REQUIRE_FALSE(domain);
            CHECK(domain.error().message.find(text) != std::string::npos);
        };
        const double infinity = std::numeric_limits<double>::infinity();
        refuses({{0, {1, 0, 0}}, 0}, "point to avoid 1 has the radius 0");
        refuses({{0, {1, 0, 0}}, -1}, "point to avoid 1 has the radius -1");
        refuses({{0, {1, 0, 0}}, infinity}, "point to avoid 1 has the radius");
        refuses({{0, {1, 0, 0}}, std::numeric_limits<double>::quiet_NaN()}, "point to avoid 1");
        refuses({{1'000'000, {1, 0, 0}}, 1}, "point to avoid 1 is in face 1000000");
        refuses({{0, {1, 1, 0}}, 1}, "point to avoid 1 has weights");
        const std::vector<KeepOut> avoid{{{0, {1, 0, 0}}, 0.1}};
        params.avoid = avoid;
        CHECK_FALSE(Domain::surface_in_space(knot().view(), mesh, params, Metric::euclidean));
    }

    TEST_CASE("existing samples that cannot be are refused, by their number") {
        TestMesh flat = flat_grid(4, 4, 1, 1);
        flat.add_triangle(0, 0, 1);
        const PreparedMesh mesh = prepared(flat);
        const auto has = [](const std::string& text, const char* part) {
            return text.find(part) != std::string::npos;
        };
        CHECK(has(refusal(mesh, {33, {1, 0, 0}}), "existing sample 1 is in face 33"));
        CHECK(has(refusal(mesh, {32, {1, 0, 0}}), "face 32, which repeats a vertex"));
        const float nan = std::numeric_limits<float>::quiet_NaN();
        for (const Sample& wrong : {Sample{0, {1, 1, 0}}, Sample{0, {1.5f, -0.5f, 0}},
                                    Sample{0, {nan, 0, 0}}, Sample{0, {0, 0, 0}}}) {
            CHECK(has(refusal(mesh, wrong), "existing sample 1 has weights"));
        }
        CHECK(
            has(refusal(mesh, {0, {1, 0, 0}}, 1), "2 existing samples, more than the stop count"));
    }
}

} // namespace geodisk::test
