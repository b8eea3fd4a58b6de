// Several requests at once: each gets what it gets alone, whatever shares its jobs.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <geodisk/request.hpp>

#include "device_run.hpp"
#include "sets.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {
namespace {

Runner runner_of_requests() {
    return expect(Runner::create(shared_context().device(), shared_context().queue()));
}

/// Requests of many kinds on a few meshes, and what they refer to.
struct ManyRequests {
    TestMesh cube = builtin("cube", 3);
    PreparedMesh sphere = prepared(builtin("icosphere", 3)),
                 knot = prepared(builtin("torus-knot", 8)), box = prepared(cube);
    MeshView view = cube.view();
    RadiusField radii = radius_field(sphere, std::vector<double>(sphere.vertex_count(), 0.5));
    std::array<Sample, 2> existing{{{0, {1, 0, 0}}, {9, {0.5F, 0.25F, 0.25F}}}};
    std::vector<std::uint8_t> mask = std::vector<std::uint8_t>(box.face_count(), 1);
    std::array<float, 4> factors{1, 0.5F, 0.5F, 1};
    std::vector<MeshRequest> requests;

    SampleRequest& add(const PreparedMesh& mesh, double distance) {
        requests.push_back({&mesh});
        requests.back().request.params.min_distance = distance;
        return requests.back().request;
    }

    ManyRequests() {
        std::fill_n(mask.begin(), mask.size() / 2, std::uint8_t{0});
        requests.reserve(20);
        for (std::uint64_t seed = 0; seed < 3; ++seed) {
            add(sphere, 0.3).params.seed = seed % 2; // Two of them draw alike.
        }
        add(knot, 0).count = 120;
        SampleRequest& exact = add(sphere, 0);
        exact.count = 77;
        exact.is_exact = true;
        add(sphere, 0.4).params.radii = &radii;
        add(sphere, 0.3).params.radii = &radii;
        add(box, 0.2).params.existing = existing;
        add(box, 0.2).params.face_mask = mask;
        SampleRequest& curves = add(box, 0.2);
        curves.features = 30;
        curves.view = &view;
        SampleRequest& levels = add(knot, 0);
        levels.count = 150;
        levels.order = SampleOrder::progressive;
        add(knot, 0.3).params.stop_count = 20;
        add(knot, 0.3).params.darts = 500;
        add(sphere, 0.4).params.maximal = true;
        add(sphere, 0.4).params.class_factors = factors;
        SampleRequest& straight = add(box, 0.2);
        straight.metric = Metric::euclidean;
        straight.view = &view;
        SampleRequest& farthest = add(sphere, 0.3);
        farthest.order = SampleOrder::farthest;
        farthest.keep = 30;
    }
};

/// A request on a mesh that is refused, and the words of the refusal.
std::string refusal(const std::vector<MeshRequest>& requests) {
    const auto made = RequestRuns::create(requests);
    REQUIRE_FALSE(made);
    return made.error().message;
}

} // namespace

TEST_SUITE("request") {
    TEST_CASE("several requests at once give what each gives alone") {
        ManyRequests many;
        Runner runner = runner_of_requests();
        const auto found = expect(sample(runner, many.requests));
        REQUIRE(found.size() == many.requests.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            CAPTURE(i);
            const auto& [mesh, request] = many.requests[i];
            const RequestedSet alone = expect(sample(runner, *mesh, request));
            CHECK_FALSE(alone.set.samples.empty());
            CHECK(points_of(found[i].set) == points_of(alone.set));
            CHECK(found[i].min_distance == alone.min_distance);
            CHECK(found[i].tries == alone.tries);
            CHECK(found[i].cut == alone.cut);
            CHECK(found[i].ends == alone.ends);
            CHECK(found[i].features == alone.features);
            CHECK(found[i].set.existing == alone.set.existing);
            CHECK(found[i].set.classes == alone.set.classes);
        }
    }

    TEST_CASE("requests that are started are sampled and ordered as those that are waited for") {
        ManyRequests many;
        Runner runner = runner_of_requests();
        const auto found = expect(sample(runner, many.requests));
        std::size_t heard = 0;
        auto started = expect(StartedRequests::start(runner, many.requests, [&](const Progress&) {
            ++heard;
            return true;
        }));
        CHECK_FALSE(sample(runner, many.requests)); // The runner is busy.
        std::optional<std::vector<RequestedSet>> polled;
        while (!polled) {
            polled = expect(started.poll(std::chrono::milliseconds(5)));
        }
        CHECK(heard > 10);
        REQUIRE(polled->size() == found.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            CAPTURE(i);
            CHECK(points_of((*polled)[i].set) == points_of(found[i].set));
            CHECK((*polled)[i].unkept == found[i].unkept);
        }
        REQUIRE(polled->back().farthest);
        CHECK(polled->back().farthest->distances == found.back().farthest->distances);
        CHECK_FALSE(started.poll()); // They have ended.
    }

    TEST_CASE("requests that are given up leave the runner free, whatever they were at") {
        const PreparedMesh sphere = prepared(builtin("icosphere", 3));
        MeshRequest one{&sphere};
        one.request.params.min_distance = 0.06;
        one.request.order = SampleOrder::farthest;
        Runner runner = runner_of_requests();
        const RequestedSet whole = expect(sample(runner, sphere, one.request));
        for (const bool in_order : {false, true}) {
            auto started = expect(StartedRequests::start(runner, std::span(&one, 1)));
            // Of the order, the progress counts samples alone.
            while (in_order && runner.progress().candidates != whole.set.samples.size()) {
                REQUIRE_FALSE(expect(started.poll(std::chrono::milliseconds(1))));
            }
        }
        CHECK(points_of(expect(sample(runner, sphere, one.request)).set) == points_of(whole.set));
        auto none = expect(StartedRequests::start(runner, std::span<const MeshRequest>()));
        CHECK(expect(none.poll())->empty());
    }

    TEST_CASE("meshes with another guard or far larger disks have jobs of their own") {
        const PreparedMesh sphere = prepared(builtin("icosphere", 2));
        TestMesh shape;
        shape.positions = {0, 0, 0, 1000, 0, 0, 500, 0.05, 0};
        shape.triangles = {0, 1, 2};
        const PreparedMesh needle = prepared(shape); // Its edges are 2,000 distances long.
        const PreparedMesh grid = prepared(flat_grid(60, 60, 1, 1));
        std::vector<MeshRequest> requests{{&sphere}, {&needle}, {&sphere}, {&grid}, {&grid}};
        const double distances[] = {0.05, 0.5, 0.2, 0.9, 0.02};
        for (std::size_t i = 0; i < requests.size(); ++i) {
            requests[i].request.params.min_distance = distances[i];
        }
        auto runs = expect(RequestRuns::create(requests));
        const RequestedSet alone = expect(
            sample(*std::make_unique<Runner>(runner_of_requests()), sphere, requests[0].request));
        Runner runner = runner_of_requests();
        std::vector<std::size_t> surfaces;
        while (const Domain* const job = runs.job()) {
            surfaces.push_back(job->first_faces().size() - 1);
            expect(runs.take(expect(runner.sample_and_wait(*job))));
        }
        CHECK(surfaces == std::vector<std::size_t>{3, 1, 1}); // Spheres with the fine grid.
        CHECK(points_of(expect(std::move(runs).finish())[0].set) == points_of(alone.set));
    }

    TEST_CASE("an error of the device names the mesh of a job of its own") {
        const PreparedMesh sphere = prepared(builtin("icosphere", 2));
        std::vector<MeshRequest> requests(2, MeshRequest{&sphere});
        requests[0].request.params.min_distance = 0.5;
        requests[1].request.params.min_distance = 0.0004; // Some 10^9 candidates.
        RunnerOptions options;
        options.device_bytes = std::uint64_t{64} << 20;
        Runner runner =
            expect(Runner::create(shared_context().device(), shared_context().queue(), options));
        const auto none = sample(runner, requests);
        REQUIRE_FALSE(none);
        INFO(none.error().message);
        CHECK(none.error().message.starts_with("mesh 1: "));
    }

    TEST_CASE("runs along surfaces share a job, up to what any device binds") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 3));
        const auto job_of = [](std::span<const MeshRequest> requests) {
            const auto runs = expect(RequestRuns::create(requests));
            REQUIRE(runs.job() != nullptr);
            return runs.job()->first_faces().size() - 1;
        };
        std::vector<MeshRequest> requests(300, MeshRequest{&mesh});
        for (MeshRequest& one : requests) {
            one.request.params.min_distance = 0.5;
        }
        CHECK(job_of(std::span(requests).first(200)) == 200);
        CHECK(job_of(requests) == (1u << 18) / mesh.face_count());
        for (MeshRequest& one : requests) { // Some 100,000 candidates each.
            one.request.params.min_distance = 0.04;
        }
        const std::size_t few = job_of(requests);
        CHECK(few > 1);
        CHECK(few < 30);
        ManyRequests many;
        auto runs = expect(RequestRuns::create(many.requests));
        std::size_t jobs = 0;
        Runner runner = runner_of_requests();
        while (const Domain* const job = runs.job()) {
            ++jobs;
            expect(runs.take(expect(runner.sample_and_wait(*job))));
        }
        CHECK(jobs < 25); // Of the levels 5 to 7, and of tries about as many.
        CHECK_FALSE(runs.take({}));
        CHECK(expect(RequestRuns::create(std::span<const MeshRequest>())).job() == nullptr);
    }

    TEST_CASE("what is wrong with one of several requests names its mesh") {
        ManyRequests many;
        many.requests[2].request.params.min_distance = -1;
        CHECK(refusal(many.requests).starts_with("mesh 2: "));
        many.requests[2].mesh = nullptr;
        CHECK(refusal(many.requests) == "mesh 2: there is no mesh");
        Runner runner = runner_of_requests();
        const std::array<KeepOut, 1> everywhere{{{{0, {1, 0, 0}}, 10}}};
        std::vector<MeshRequest> requests(3, MeshRequest{&many.sphere});
        for (MeshRequest& one : requests) {
            one.request.count = 20;
        }
        requests[1].request.params.avoid = everywhere;
        const auto none = sample(runner, requests);
        REQUIRE_FALSE(none);
        CHECK(none.error().message.starts_with("mesh 1: count: found no room for a sample"));
    }
}

} // namespace geodisk::test
