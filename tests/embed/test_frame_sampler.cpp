// The object between Runner and Sampler: its samples in a buffer to draw from.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <geodisk/frame_sampler.hpp>

#include "app_device.hpp"
#include "arena.hpp"
#include "engine_job.hpp"
#include "gpu/sets.hpp"
#include "samples.h"
#include "support/meshes.hpp"
#include "workshop.hpp"

namespace geodisk::test {
namespace {

constexpr std::uint32_t kMaxCalls = 20'000;

/// Samples of a single mesh in frames.
Result<FrameSampler> frames_of(const std::shared_ptr<const Sampler>& sampler,
                               const PreparedMesh& mesh, const SampleRequest& request,
                               const FrameSamplerOptions& options = {}) {
    const MeshRequest on_mesh{&mesh, request};
    return FrameSampler::create(sampler, {&on_mesh, 1}, options);
}

std::shared_ptr<const Sampler> shared_sampler(const Context& context) {
    return std::make_shared<const Sampler>(expect(Sampler::create(context.device())));
}

/// A mesh, where its samples are to lie, and which they are.
struct SampledSubject {
    TestMesh shape;
    PreparedMesh mesh;
    SampleParams params;
    Domain domain;
    Points wanted;

    SampledSubject(const Sampler& sampler, double count, std::uint64_t seed = 1,
                   TestMesh of = builtin("torus-knot", 8))
        : shape(std::move(of)), mesh(prepared(shape)), params(params_for(mesh, count, seed)),
          domain(expect(Domain::surface(mesh, params))),
          wanted(float_set(mesh, params,
                           expect(sampler.plan_run(domain, Workshop::kPoolBytes)).error_bound)) {}
};

Result<FrameSampler> frames_of(const std::shared_ptr<const Sampler>& sampler,
                               const SampledSubject& subject,
                               const FrameSamplerOptions& options = {}) {
    const MeshView view = subject.shape.view();
    return frames_of(sampler, subject.mesh, {.params = subject.params, .view = &view}, options);
}

/// A workshop whose frames hold other work of its own.
struct SamplerBench : Workshop {
    explicit SamplerBench(const Context& context) : Workshop(context) { cut({}); }
};

/// Contents of the buffer: the records, and how many the draw has.
struct Placed {
    VkDrawIndirectCommand draw{};
    std::vector<gpu::PlacedRec> records;

    Points points() const {
        Points points;
        for (const gpu::PlacedRec& p : records) {
            points.push_back({p.face, p.weight1, p.weight2});
        }
        return points;
    }
};

Placed read(Workshop& workshop, const FrameSamples& samples) {
    Placed placed;
    const auto get = [&](VkDeviceSize offset, VkDeviceSize bytes, void* to) {
        workshop.frame(0, [&](VkCommandBuffer commands) {
            workshop.record_download(commands, {samples.buffer, offset, bytes}, bytes);
        });
        std::memcpy(to, workshop.download_bytes().data(), bytes);
    };
    get(samples.arguments_offset, sizeof placed.draw, &placed.draw);
    placed.records.resize(placed.draw.instanceCount);
    if (!placed.records.empty()) {
        get(samples.placed_offset, placed.records.size() * sizeof(gpu::PlacedRec),
            placed.records.data());
    }
    return placed;
}

/// Records a frame at a time; how many that took.
std::uint32_t record_all(Workshop& workshop, FrameSampler& frames) {
    std::uint32_t calls = 0;
    for (bool is_complete = false; !is_complete; ++calls) {
        REQUIRE(calls < kMaxCalls);
        workshop.frame(calls, [&](VkCommandBuffer commands) {
            is_complete = expect(frames.record(commands));
        });
    }
    return calls;
}

void check_all(Workshop& workshop, const FrameSampler& frames, const SampledSubject& subject) {
    const FrameSamples samples = frames.samples();
    CHECK(samples.is_complete);
    CHECK(samples.ready == subject.wanted.size());
    const Placed placed = read(workshop, samples);
    CHECK(placed.points() == subject.wanted);
    // The place follows from its weights, in the caller's coordinates.
    const gpu::PlacedRec& p = placed.records.front();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        double x = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t v = subject.shape.triangles[std::size_t{3} * p.face + k];
            const double w1 = p.weight1, w2 = p.weight2;
            const double weights[] = {1 - w1 - w2, w1, w2};
            x += weights[k] * subject.shape.positions[3 * v + axis];
        }
        const float found[] = {p.x, p.y, p.z};
        CHECK(double{found[axis]} == doctest::Approx(x).epsilon(1e-5));
    }
    CHECK(double{p.radius} == doctest::Approx(subject.params.min_distance / 2).epsilon(1e-6));
}

} // namespace

TEST_SUITE("frame sampler") {
    TEST_CASE("existing samples are drawn first, and points to avoid are not") {
        const Context context = validated_context();
        {
            const auto sampler = shared_sampler(context);
            SampledSubject knot(*sampler, 200);
            const std::vector<Sample> given =
                samples_of(Points(knot.wanted.begin(), knot.wanted.begin() + 9));
            const std::vector<KeepOut> avoid{
                {{700, {0.5f, 0.25f, 0.25f}}, 2 * knot.params.min_distance},
                {{20, {1, 0, 0}}, 0.5 * knot.params.min_distance}};
            knot.params.existing = given;
            knot.params.avoid = avoid;
            knot.domain = expect(Domain::surface(knot.mesh, knot.params));
            knot.wanted =
                float_set(knot.mesh, knot.params,
                          expect(sampler->plan_run(knot.domain, Workshop::kPoolBytes)).error_bound);
            SamplerBench workshop(context);
            FrameSampler frames = expect(frames_of(sampler, knot));
            record_all(workshop, frames);
            check_all(workshop, frames, knot);
        }
        check_silent(context);
    }

    TEST_CASE("samples a few rounds a frame, with any number of frames in flight") {
        const Context context = validated_context();
        {
            const auto sampler = shared_sampler(context);
            const SampledSubject knot(*sampler, 200);
            SamplerBench workshop(context);
            for (const std::uint32_t in_flight : {1u, 2u, 5u}) {
                FrameSamplerOptions options;
                options.frames = in_flight;
                options.vertices_each = 6;
                FrameSampler frames = expect(frames_of(sampler, knot, options));
                CHECK(record_all(workshop, frames) > in_flight);
                check_all(workshop, frames, knot);
                CHECK(read(workshop, frames.samples()).draw.vertexCount == 6);
            }
        }
        check_silent(context);
    }

    TEST_CASE("what is placed so far is final, and the host's count never ahead of it") {
        const Context context = validated_context();
        {
            const auto sampler = shared_sampler(context);
            const SampledSubject knot(*sampler, 200);
            SamplerBench workshop(context);
            FrameSampler frames = expect(frames_of(sampler, knot));
            std::size_t steps = 0, before = 0;
            for (bool is_complete = false; !is_complete;) {
                workshop.frame(0, [&](VkCommandBuffer commands) {
                    is_complete = expect(frames.record(commands));
                });
                const Placed placed = read(workshop, frames.samples());
                CHECK(placed.records.size() >= before);
                CHECK(placed.records.size() >= frames.samples().ready);
                const Points points = placed.points();
                CHECK(std::equal(points.begin(), points.end(), knot.wanted.begin()));
                steps += points.size() > before;
                before = points.size();
            }
            CHECK(steps > 1);
        }
        check_silent(context);
    }

    TEST_CASE("submits by itself, stops and goes on, and begins again with another seed") {
        const Context context = validated_context();
        {
            const auto sampler = shared_sampler(context);
            const SampledSubject knot(*sampler, 200, 1);
            const SampledSubject other(*sampler, 200, 2);
            SamplerBench workshop(context);
            Runner runner = expect(Runner::create(sampler, context.queue()));
            FrameSampler frames = expect(frames_of(sampler, knot));
            const auto stopped =
                frames.sample_and_wait(runner, [](const Progress&) { return false; });
            REQUIRE_FALSE(stopped);
            CHECK(stopped.error().status == Status::cancelled);
            CHECK_FALSE(frames.samples().is_complete);
            expect(frames.sample_and_wait(runner));
            check_all(workshop, frames, knot);
            frames.set_seed(2);
            CHECK_FALSE(frames.samples().is_complete);
            expect(frames.sample_and_wait(runner));
            check_all(workshop, frames, other);
            frames.set_seed(1);
            record_all(workshop, frames);
            check_all(workshop, frames, knot);
        }
        check_silent(context);
    }

    TEST_CASE("takes a larger buffer where disks outgrow the first") {
        const Context context = validated_context();
        {
            const auto sampler = shared_sampler(context);
            const SampledSubject few(*sampler, 3, 1, builtin("lattice", 1));
            SamplerBench workshop(context);
            FrameSamplerOptions options;
            // The least that one lane fits in.
            for (options.pool_bytes = 1024; !sampler->plan_run(few.domain, options.pool_bytes);) {
                options.pool_bytes *= 2;
            }
            FrameSampler frames = expect(frames_of(sampler, few, options));
            const VkBuffer first = frames.samples().buffer;
            const std::uint64_t bytes = frames.device_bytes();
            record_all(workshop, frames);
            check_all(workshop, frames, few);
            CHECK(frames.samples().buffer != first);
            CHECK(frames.device_bytes() > bytes);
        }
        check_silent(context);
    }

    TEST_CASE("places samples of several surfaces") {
        const Context context = validated_context();
        {
            const auto sampler = shared_sampler(context);
            const TestMesh shapes[] = {builtin("icosphere", 3), builtin("torus-knot", 8)};
            const PreparedMesh meshes[] = {prepared(shapes[0]), prepared(shapes[1])};
            const SurfacePart parts[] = {{&meshes[0], params_for(meshes[0], 100)},
                                         {&meshes[1], params_for(meshes[1], 100)}};
            const Domain domain = expect(Domain::surfaces(parts));
            Runner runner = expect(Runner::create(sampler, context.queue()));
            const SampleSet wanted = expect(runner.sample_and_wait(domain));
            const MeshView views[] = {shapes[0].view(), shapes[1].view()};
            FrameSampler frames = expect(FrameSampler::create(sampler, domain, views));
            expect(frames.sample_and_wait(runner));
            SamplerBench workshop(context);
            const Placed placed = read(workshop, frames.samples());
            REQUIRE(placed.records.size() == wanted.samples.size());
            for (std::size_t i = 0; i < wanted.samples.size(); ++i) {
                const gpu::PlacedRec& p = placed.records[i];
                CHECK(p.face + domain.first_faces()[p.part] == wanted.samples[i].face);
            }
        }
        check_silent(context);
    }

    TEST_CASE("shares a run among requests, as RequestRuns does") {
        const Context context = validated_context();
        {
            const auto sampler = shared_sampler(context);
            const TestMesh shapes[] = {builtin("icosphere", 3), builtin("icosphere", 2)};
            const PreparedMesh meshes[] = {prepared(shapes[0]), prepared(shapes[1])};
            const MeshView views[] = {shapes[0].view(), shapes[1].view()};
            std::vector<MeshRequest> requests;
            for (std::size_t i = 0; i < 2; ++i) {
                requests.push_back(
                    {&meshes[i],
                     {.params = params_for(meshes[i], i == 0 ? 400 : 100, 5), .view = &views[i]}});
            }
            Runner runner = expect(Runner::create(sampler, context.queue()));
            const auto wanted = expect(sample(runner, requests));
            FrameSampler frames = expect(FrameSampler::create(sampler, requests));
            expect(frames.sample_and_wait(runner));
            SamplerBench workshop(context);
            std::vector<Points> found(2);
            for (const gpu::PlacedRec& p : read(workshop, frames.samples()).records) {
                found[p.part].push_back({p.face, p.weight1, p.weight2});
            }
            for (std::size_t i = 0; i < 2; ++i) {
                CHECK(found[i] == points_of(wanted[i].set));
            }
            requests[1].request.params.darts = 50;
            const auto refused = FrameSampler::create(sampler, requests);
            REQUIRE_FALSE(refused);
            CHECK(refused.error().message.starts_with("the requests share no run"));
        }
        check_silent(context);
    }

    TEST_CASE("names the field of a request that takes several runs") {
        const Context context = validated_context();
        {
            const auto sampler = shared_sampler(context);
            const SampledSubject knot(*sampler, 100);
            const MeshView view = knot.shape.view();
            const auto refused = [&](const char* words, auto&& change) {
                CAPTURE(words);
                SampleRequest request{.params = knot.params, .view = &view};
                change(request);
                const auto made = frames_of(sampler, knot.mesh, request);
                REQUIRE_FALSE(made);
                CHECK(made.error().status == Status::invalid_argument);
                CHECK(made.error().message.find(words) != std::string::npos);
            };
            using Request = SampleRequest;
            refused("frames and count", [](Request& r) { r.count = 50; });
            refused("frames and maximal", [](Request& r) { r.params.maximal = true; });
            refused("frames and features", [](Request& r) { r.features = 30; });
            refused("frames and progressive",
                    [](Request& r) { r.order = SampleOrder::progressive; });
            refused("frames and farthest", [](Request& r) { r.order = SampleOrder::farthest; });
            refused("frames and metric", [](Request& r) { r.metric = Metric::euclidean; });
            refused("no view", [](Request& r) { r.view = nullptr; });
            CHECK_FALSE(FrameSampler::create(sampler, std::span<const MeshRequest>()));
        }
        check_silent(context);
    }

    TEST_CASE("takes its memory from the caller, in one buffer of the device") {
        AppDevice app;
        {
            Arena arena(app.refs());
            const MemoryHooks hooks = arena.hooks();
            DeviceRefs refs = app.refs();
            refs.memory_hooks = &hooks;
            const auto sampler = std::make_shared<const Sampler>(expect(Sampler::create(refs)));
            const SampledSubject knot(*sampler, 100);
            {
                Runner runner = expect(Runner::create(sampler, app.queue()));
                const std::size_t before = arena.alive.size();
                FrameSampler frames = expect(frames_of(sampler, knot));
                // One for the device; staging and control records for the host.
                CHECK(arena.alive.size() - before == 3);
                expect(frames.sample_and_wait(runner));
                CHECK(frames.samples().ready == knot.wanted.size());
            }
            CHECK(arena.alive.empty());
        }
        CHECK(app.messages().empty());
    }

    TEST_CASE("refuses what cannot be") {
        const Context context = validated_context();
        {
            const auto sampler = shared_sampler(context);
            const SampledSubject knot(*sampler, 100);
            const TestMesh other = builtin("cube", 1);
            const auto status = [&](const Domain& domain, std::span<const MeshView> meshes,
                                    const FrameSamplerOptions& options = {}) {
                const auto made = FrameSampler::create(sampler, domain, meshes, options);
                REQUIRE_FALSE(made);
                return made.error().status;
            };
            const MeshView view = knot.shape.view();
            const MeshView wrong = other.view();
            CHECK(status(knot.domain, {}) == Status::invalid_argument);
            CHECK(status(knot.domain, {&wrong, 1}) == Status::invalid_argument);
            MeshView flat = view;
            flat.dimension = 1;
            CHECK(status(knot.domain, {&flat, 1}) == Status::invalid_argument);
            std::vector<std::uint32_t> triangles = knot.shape.triangles;
            triangles[7] = 1'000'000;
            const MeshView out{view.positions, triangles};
            CHECK(status(knot.domain, {&out, 1}) == Status::invalid_argument);
            for (int i = 0; i < 5; ++i) {
                FrameSamplerOptions options;
                options.frames = i == 0 ? 0 : i == 1 ? 17 : 2;
                options.rounds = i == 2 ? 0 : 1;
                options.vertices_each = i == 3 ? 0 : 1;
                options.readers.stages = i == 4 ? 0 : options.readers.stages;
                CHECK(status(knot.domain, {&view, 1}, options) == Status::invalid_argument);
            }
            FrameSamplerOptions tiny;
            tiny.pool_bytes = 16;
            CHECK(status(knot.domain, {&view, 1}, tiny) == Status::workspace_too_small);
            BoxParams box{{1, 1}, true};
            box.min_distance = 0.1;
            CHECK(status(expect(Domain::box(box)), {}) == Status::invalid_argument);
            CHECK_FALSE(FrameSampler::create(nullptr, knot.domain, {&view, 1}));
            FrameSampler frames = expect(frames_of(sampler, knot));
            CHECK_FALSE(frames.record(VK_NULL_HANDLE));
        }
        check_silent(context);
    }
}

} // namespace geodisk::test
