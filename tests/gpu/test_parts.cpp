// One surface sampled in parts that tell each other of their samples: the set of one run, for any
// number of parts.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <geodisk/request.hpp>

#include "device_run.hpp"
#include "parts/cut.hpp"
#include "parts/sample_parts.hpp"
#include "sets.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"
#include "threads_exchange.hpp"

namespace geodisk::test {
namespace {

Result<std::vector<std::uint32_t>> grown(const PreparedMesh& mesh, const SampleParams& params,
                                         std::uint32_t processes) {
    return halved_parts(mesh, work_of_faces(mesh, params), processes);
}

/// Every face is another part's than the one before.
Result<std::vector<std::uint32_t>> scattered(const PreparedMesh& mesh, const SampleParams&,
                                             std::uint32_t processes) {
    std::vector<std::uint32_t> parts(mesh.face_count());
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        parts[face] = face % processes;
    }
    return parts;
}

Result<SharedSamples> in_parts(const PreparedMesh& mesh, const SampleParams& params,
                               std::uint32_t count, const Cut& cut, double max_candidates,
                               const Checkpoints* checkpoints = nullptr) {
    static const auto kSampler =
        std::make_shared<const Sampler>(expect(Sampler::create(shared_context().device())));
    const WholeSurface whole{mesh, params, cut, max_candidates, checkpoints};
    std::vector<std::optional<Result<SharedSamples>>> results(count);
    run_threads(count, [&](Exchange& exchange) {
        auto runner = Runner::create(kSampler, shared_context().queue());
        if (runner) {
            const std::uint32_t rank = exchange.rank();
            results[rank].emplace(sample_parts(exchange, *runner, rank == 0 ? &whole : nullptr));
        }
    });
    for (const auto& result : results) {
        REQUIRE(result);
        REQUIRE(result->operator bool() == results[0]->operator bool());
        if (!*result) {
            CHECK(result->error().message == results[0]->error().message);
        }
    }
    return std::move(*results[0]);
}

void check_parts(const PreparedMesh& mesh, const SampleParams& params,
                 std::initializer_list<std::uint32_t> counts, const Cut& cut = grown,
                 double max_candidates = 0x1p26) {
    const SampleSet whole = sample(mesh, params);
    for (const std::uint32_t count : counts) {
        CAPTURE(count);
        const SharedSamples result = expect(in_parts(mesh, params, count, cut, max_candidates));
        CHECK(points_of(result.set) == points_of(whole));
        CHECK(result.set.existing == whole.existing);
        CHECK(result.set.report.guard == whole.report.guard);
        std::uint64_t faces = 0;
        for (const ProcessReport& process : result.processes) {
            CHECK(process.own_faces > 0);
            faces += process.own_faces;
        }
        CHECK(faces == mesh.face_count());
        CHECK(result.set.report.candidates == whole.report.candidates);
    }
}

/// Saves a checkpoint after each stage, and goes on from each with another number of parts.
void check_resumed(const PreparedMesh& mesh, const SampleParams& params, std::size_t least) {
    const SampleSet whole = sample(mesh, params);
    std::vector<Checkpoint> saved;
    const Checkpoints saving{nullptr, [&](const Checkpoint& checkpoint) -> Result<Done> {
                                 saved.push_back(checkpoint);
                                 return Done{};
                             }};
    const SharedSamples first = expect(in_parts(mesh, params, 3, grown, 0x1p26, &saving));
    CHECK(points_of(first.set) == points_of(whole));
    CHECK(saved.size() >= least);
    CHECK(saved.back().first_stage == kNoStage);
    std::uint32_t count = 1;
    for (const Checkpoint& checkpoint : saved) {
        CAPTURE(checkpoint.first_stage);
        const Checkpoints resuming{&checkpoint, {}};
        const SharedSamples result =
            expect(in_parts(mesh, params, 1 + count++ % 4, grown, 0x1p26, &resuming));
        CHECK(points_of(result.set) == points_of(whole));
        CHECK(result.set.report.candidates == whole.report.candidates);
    }
}

std::string refusal(const PreparedMesh& mesh, const SampleParams& params, std::uint32_t count) {
    const auto result = in_parts(mesh, params, count, grown, 0x1p26);
    REQUIRE_FALSE(result);
    CHECK(result.error().status == Status::invalid_argument);
    return result.error().message;
}

/// Less memory than a run on 125,000 triangles takes.
constexpr std::uint64_t kLittleMemory = 24u << 20;

Runner small_runner(std::uint64_t device_bytes = kLittleMemory) {
    static const auto kSampler =
        std::make_shared<const Sampler>(expect(Sampler::create(shared_context().device())));
    RunnerOptions options;
    options.device_bytes = device_bytes;
    return expect(Runner::create(kSampler, shared_context().queue(), options));
}

/// A surface that such a runner does not hold as a whole.
const TestMesh& large_shape() {
    static const TestMesh kShape = builtin("terrain", 250);
    return kShape;
}

/// Checks that a runner with little memory divides a job, and gives the set of the whole.
void check_divided(const PreparedMesh& mesh, const SampleParams& params,
                   std::uint64_t device_bytes = kLittleMemory) {
    const SampleSet whole = sample(mesh, params);
    CHECK(whole.report.starts == 1);
    const SampleSet divided = expect(small_runner(device_bytes).sample_and_wait(mesh, params));
    CHECK(points_of(divided) == points_of(whole));
    CHECK(divided.classes == whole.classes);
    CHECK(divided.existing == whole.existing);
    CHECK(divided.report.candidates == whole.report.candidates);
    CHECK(divided.report.starts > 1);
    CHECK(divided.report.device_bytes <= device_bytes);
}

} // namespace

TEST_SUITE("parts") {
    TEST_CASE("any number of parts gives the set of one run") {
        const PreparedMesh knot = prepared(builtin("torus-knot", 8));
        check_parts(knot, params_for(knot, 2000), {1, 2, 3, 4, 7});
        check_parts(knot, params_for(knot, 60, 2), {2, 7});
        check_parts(knot, params_for(knot, 300, 3), {5}, scattered);
    }

    TEST_CASE("disks larger than a part, and than the surface") {
        const PreparedMesh ball = prepared(builtin("icosphere", 2));
        check_parts(ball, params_for(ball, 12), {7});
        check_parts(ball, params_for(ball, 0.01), {3});
    }

    TEST_CASE("radii that vary") {
        const TestMesh shape = builtin("torus-knot", 8);
        const PreparedMesh knot = prepared(shape);
        const RadiusField waves = radius_field(knot, wavy_factors(shape, 0.3));
        check_parts(knot, params_for(knot, 600, 1, &waves), {3});
        const RadiusField density = density_field(knot, rough_density(shape));
        check_parts(knot, params_for(knot, 600, 1, &density), {4});
    }

    TEST_CASE("radii over a wide range: parts with small ones hold less around them") {
        const TestMesh shape = builtin("terrain", 60);
        const PreparedMesh hills = prepared(shape);
        std::vector<double> smooth, steps;
        for (std::uint32_t v = 0; v < shape.vertex_count(); ++v) {
            const double x = shape.positions[3 * std::size_t{v}];
            smooth.push_back(std::exp2(-5 * std::clamp(x, 0.0, 1.0)));
            steps.push_back(std::fmod(8 * x, 2) < 1 ? 1 : 1.0 / 16);
        }
        for (const auto& factors : {smooth, steps, rough_factors(shape, 1.0 / 32)}) {
            const RadiusField field = radius_field(hills, factors);
            check_parts(hills, params_for(hills, 3000, 1, &field), {3, 7});
        }
        const RadiusField field = radius_field(hills, smooth);
        // Points to avoid that keep out less than samples do.
        SampleParams avoiding = params_for(hills, 3000, 1, &field);
        std::vector<KeepOut> points;
        for (std::uint32_t face = 0; face < hills.face_count(); face += 97) {
            KeepOut& point = points.emplace_back();
            point.center = {face, {0.25f, 0.25f, 0.5f}};
            point.radius = 0.02 * avoiding.min_distance;
        }
        avoiding.avoid = points;
        check_parts(hills, avoiding, {3, 7});
        const SampleParams params = params_for(hills, 20000, 1, &field);
        const SharedSamples result = expect(in_parts(hills, params, 5, grown, 0x1p26));
        std::uint64_t faces = 0;
        for (const ProcessReport& process : result.processes) {
            faces += process.faces;
        }
        CHECK(faces < 2 * std::uint64_t{hills.face_count()});
    }

    TEST_CASE("borders, edges of many faces, and separate parts") {
        const PreparedMesh strip = prepared(builtin("moebius", 24));
        check_parts(strip, params_for(strip, 500), {4});
        const PreparedMesh cells = prepared(tetrahedra(2, 0.1));
        check_parts(cells, params_for(cells, 700), {3});
        TestMesh shape = builtin("icosphere", 2);
        const std::uint32_t vertices = shape.vertex_count();
        const std::vector<std::uint32_t> triangles = shape.triangles;
        for (const double x : std::vector<double>(shape.positions)) {
            shape.positions.push_back(x + 5);
        }
        for (const std::uint32_t vertex : triangles) {
            shape.triangles.push_back(vertices + vertex);
        }
        const PreparedMesh two = prepared(shape);
        check_parts(two, params_for(two, 400), {3});
    }

    TEST_CASE("surfaces in R^4, and of edge lengths alone") {
        const TestMesh shape = builtin("clifford-torus", 24);
        const PreparedMesh torus = prepared(shape);
        check_parts(torus, params_for(torus, 400), {3});
        std::vector<double> lengths;
        for (const HalfEdge& edge : torus.half_edges()) {
            lengths.push_back(edge.length);
        }
        const PreparedMesh bare = expect(
            PreparedMesh::prepare(LengthMeshView{shape.triangles, lengths, shape.vertex_count()}));
        check_parts(bare, params_for(bare, 300), {4});
    }

    TEST_CASE("masks, keys, existing samples, points to avoid, and a count to stop at") {
        const TestMesh shape = builtin("torus-knot", 8);
        const PreparedMesh knot = prepared(shape);
        const std::vector<std::uint8_t> mask = mask_above(shape, 2);
        SampleParams params = params_for(knot, 500);
        params.face_mask = mask;
        check_parts(knot, params, {4});

        params = params_for(knot, 500);
        std::vector<std::uint32_t> keys(knot.face_count());
        std::iota(keys.rbegin(), keys.rend(), 7u);
        params.face_keys = keys;
        check_parts(knot, params, {3});

        const std::vector<Sample> given = sample(knot, params_for(knot, 40, 5)).samples;
        const KeepOut avoided[] = {{given[3], params.min_distance * 3},
                                   {given[9], params.min_distance / 2}};
        params = params_for(knot, 500);
        params.existing = given;
        params.avoid = avoided;
        check_parts(knot, params, {4});

        params.stop_count = 150;
        check_parts(knot, params, {3});
    }

    TEST_CASE("candidates drawn a stage at a time, and an exact number of darts") {
        const TestMesh shape = builtin("torus-knot", 8);
        const PreparedMesh knot = prepared(shape);
        check_parts(knot, params_for(knot, 800), {3}, grown, 1);
        SampleParams params = params_for(knot, 300);
        params.darts = 2345;
        check_parts(knot, params, {1, 4});
        params.stop_count = 200;
        check_parts(knot, params, {3});
        params.darts = 1000000;
        params.stop_count = 280;
        check_parts(knot, params, {2});
    }

    TEST_CASE("what parts cannot do is refused by all") {
        const PreparedMesh cube = prepared(builtin("cube", 1));
        SampleParams params = params_for(cube, 100);
        CHECK(refusal(cube, params, 13) ==
              "there are 13 processes, but the mesh has 12 faces; start at most as many processes");
        check_parts(cube, params, {12});
        params.maximal = true;
        CHECK(refusal(cube, params, 2) ==
              "processes and maximal exclude each other: gaps are found on the whole surface");
        params = params_for(cube, 100);
        params.min_distance = -1;
        CHECK(refusal(cube, params, 2).starts_with("the minimum distance must be"));
    }

    TEST_CASE("a job goes on from each checkpoint, with any number of parts") {
        const TestMesh shape = builtin("torus-knot", 8);
        const PreparedMesh knot = prepared(shape);
        check_resumed(knot, params_for(knot, 600), 4);
        const RadiusField waves = radius_field(knot, wavy_factors(shape, 0.3));
        SampleParams params = params_for(knot, 300, 2, &waves);
        params.darts = 3000;
        check_resumed(knot, params, 2);
        params = params_for(knot, 300, 3);
        params.stop_count = 250;
        const std::vector<Sample> given{{5, {0.25f, 0.25f, 0.5f}}, {900, {0.5f, 0.25f, 0.25f}}};
        params.existing = given;
        check_resumed(knot, params, 1);
    }

    TEST_CASE("a checkpoint that cannot be saved ends all parts") {
        const PreparedMesh knot = prepared(builtin("torus-knot", 8));
        const Checkpoints saving{nullptr, [](const Checkpoint&) -> Result<Done> {
                                     return Error{Status::internal, "the disk is full"};
                                 }};
        const auto result = in_parts(knot, params_for(knot, 300), 3, grown, 0x1p26, &saving);
        REQUIRE_FALSE(result);
        CHECK(result.error().message == "the disk is full");
    }

    TEST_CASE("a runner divides by itself what the device cannot hold") {
        const PreparedMesh terrain = prepared(large_shape());
        SampleParams params = params_for(terrain, 3000);
        check_divided(terrain, params);
        const std::vector<Sample> given = sample(terrain, params_for(terrain, 30, 5)).samples;
        const KeepOut avoided[] = {{given[3], params.min_distance * 2}};
        const std::vector<std::uint8_t> mask = mask_above(large_shape(), 0);
        params.existing = given;
        params.avoid = avoided;
        params.face_mask = mask;
        check_divided(terrain, params);
        params = params_for(terrain, 3000, 2);
        params.darts = 15000;
        params.stop_count = 2000;
        check_divided(terrain, params);
        const RadiusField waves = radius_field(terrain, wavy_factors(large_shape(), 0.4));
        check_divided(terrain, params_for(terrain, 3000, 3, &waves));

        const float factors[] = {1, 0.5f, 0.75f, 0.5f, 0.5f, 0, 0.75f, 0, 0.6f};
        params = params_for(terrain, 3000, 5);
        params.class_factors = factors;
        check_divided(terrain, params);
        const std::uint8_t kinds[] = {2, 0, 1, 1, 2, 0, 0, 2, 1, 1};
        params.existing = std::span(given).first(std::size(kinds));
        params.existing_classes = kinds;
        const KeepOut kept_out[] = {{given[10], params.min_distance * 2},
                                    {given[11], params.min_distance / 2},
                                    {given[12], params.min_distance * 3}};
        const std::uint8_t kept_kinds[] = {1, kAllClasses, 0};
        params.avoid = kept_out;
        params.avoid_classes = kept_kinds;
        check_divided(terrain, params);
        params.darts = 15000;
        params.stop_count = 900;
        check_divided(terrain, params);

        // In the frame of a mesh with longer edges.
        params = params_for(terrain, 3000, 4);
        JobFrame frame = expect(frame_of(terrain, params));
        frame.longest_edge += 9;
        frame.samples *= 2;
        const Domain framed = expect(Domain::surface(terrain, params, frame));
        const SampleSet divided = expect(small_runner().sample_and_wait(framed));
        Runner runner = expect(Runner::create(shared_context().device(), shared_context().queue()));
        CHECK(divided.report.starts > 1);
        CHECK(points_of(divided) == points_of(expect(runner.sample_and_wait(framed))));
    }

    TEST_CASE("a runner divides a mesh that fits, but not together with its candidates") {
        const PreparedMesh ball = prepared(builtin("icosphere", 4));
        check_divided(ball, params_for(ball, 10000), 2u << 20);
    }

    TEST_CASE("a runner divides lists of candidates: on features, and at vertices") {
        const PreparedMesh terrain = prepared(large_shape());
        const MeshView view = large_shape().view();
        Runner whole_runner =
            expect(Runner::create(shared_context().device(), shared_context().queue()));
        SampleRequest requests[2];
        for (SampleRequest& request : requests) {
            request.params = params_for(terrain, 3000);
            request.view = &view;
        }
        requests[0].features = 8;
        requests[1].at_vertices = true;
        for (const SampleRequest& request : requests) {
            CAPTURE(request.features);
            const RequestedSet whole = expect(sample(whole_runner, terrain, request));
            Runner runner = small_runner();
            const RequestedSet divided = expect(sample(runner, terrain, request));
            CHECK(points_of(divided.set) == points_of(whole.set));
            CHECK(divided.features == whole.features);
            CHECK(divided.set.report.candidates == whole.set.report.candidates);
            CHECK(divided.set.report.starts > whole.set.report.starts);
            CHECK(divided.set.report.device_bytes <= kLittleMemory);
            if (request.features > 0) {
                CHECK(std::ranges::count(whole.features, FeatureKind::curve) > 100);
            }
        }
    }

    TEST_CASE("a divided run is polled, told of and cancelled as any other") {
        const PreparedMesh terrain = prepared(large_shape());
        const SampleParams params = params_for(terrain, 3000);
        const Domain domain = expect(Domain::surface(terrain, params));
        Runner runner = small_runner();
        std::uint32_t calls = 0, most = 0;
        expect(runner.start(domain, [&](const Progress& now) {
            ++calls;
            most = std::max(most, now.accepted);
            CHECK(now.decided <= now.candidates);
            return true;
        }));
        std::optional<SampleSet> set;
        while (!set) {
            CHECK_FALSE(runner.start(domain));
            set = expect(runner.poll(std::chrono::milliseconds(20)));
        }
        CHECK(points_of(*set) == points_of(sample(terrain, params)));
        CHECK(calls > 3);
        CHECK(most > 100);
        CHECK_FALSE(runner.poll()); // Nothing is in progress.

        std::uint32_t before = 5;
        const auto stopped = runner.sample_and_wait(
            domain, [&](const Progress&) { return before == 0 || --before > 0; });
        REQUIRE_FALSE(stopped);
        CHECK(stopped.error().status == Status::cancelled);
        expect(runner.start(domain));
        CHECK_FALSE(expect(runner.poll(std::chrono::milliseconds(5))));
        runner.cancel();
        runner.release_memory();
        CHECK(points_of(expect(runner.sample_and_wait(domain))) == points_of(*set));
    }

    TEST_CASE("what cannot be divided ends with the error of the whole") {
        const PreparedMesh terrain = prepared(large_shape());
        SampleParams params = params_for(terrain, 3000);
        const float factors[] = {1, 0.5f, 0.5f, 1};
        params.class_factors = factors;
        const std::vector<float> shares(std::size_t{6} * terrain.face_count(), 0.5f);
        params.class_shares = shares;
        Runner runner = small_runner();
        const auto classed = runner.sample_and_wait(terrain, params);
        REQUIRE_FALSE(classed);
        CHECK(classed.error().status == Status::out_of_device_memory);
        // Of disks as large as the surface, each part has it all.
        const auto wide = runner.sample_and_wait(terrain, params_for(terrain, 2));
        REQUIRE_FALSE(wide);
        CHECK(wide.error().status == Status::out_of_device_memory);
    }
}

} // namespace geodisk::test
