// Requests of the C API give what those of C++ give.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include <geodisk/request.hpp>

#include "c/api.hpp"
#include "device_run.hpp"

namespace geodisk::test {
namespace {

/// A request of a cube, to change.
struct CubeRequest {
    TestMesh shape = builtin("cube", 3);
    Owned<geodisk_mesh> mesh = mesh_of(shape);
    geodisk_surface_params params = sized<geodisk_surface_params>();
    geodisk_request request = sized<geodisk_request>();

    CubeRequest() { params.seed = 4; }

    Owned<geodisk_samples> sample() {
        request.params = &params;
        return owned<geodisk_samples>([&](geodisk_samples** made, geodisk_error* error) {
            return geodisk_sample_request(shared_sampler(), mesh.get(), &request, nullptr, nullptr,
                                          made, error);
        });
    }
    /// The same without waiting.
    Owned<geodisk_samples> poll() {
        request.params = &params;
        REQUIRE(geodisk_start_request(shared_sampler(), mesh.get(), &request, nullptr) ==
                GEODISK_OK);
        geodisk_samples* samples = nullptr;
        while (samples == nullptr) {
            REQUIRE(geodisk_poll(shared_sampler(), 1000, &samples, nullptr) == GEODISK_OK);
        }
        return Owned<geodisk_samples>(samples);
    }
    std::string refusal() {
        request.params = &params;
        geodisk_samples* none = nullptr;
        auto error = sized<geodisk_error>();
        CHECK(geodisk_sample_request(shared_sampler(), mesh.get(), &request, nullptr, nullptr,
                                     &none, &error) == GEODISK_INVALID_ARGUMENT);
        CHECK(none == nullptr);
        return error.message;
    }
};

RequestedSet expected_set(const TestMesh& shape, SampleRequest request) {
    const PreparedMesh mesh = prepared(shape);
    const MeshView view = shape.view();
    request.view = &view;
    Runner runner = expect(Runner::create(shared_context().device(), shared_context().queue()));
    return expect(sample(runner, mesh, request));
}

Placed placed_of(const RequestedSet& found) {
    Placed result;
    for (const Sample& sample : found.set.samples) {
        result.faces.push_back(sample.face);
        result.weights.insert(result.weights.end(), sample.weights, sample.weights + 3);
    }
    return result;
}

std::vector<std::uint32_t> integers(const geodisk_samples* samples, geodisk_attribute attribute) {
    std::vector<std::uint32_t> values(geodisk_samples_count(samples));
    REQUIRE(geodisk_samples_copy(samples, attribute, GEODISK_UINT32, values.data(), 0,
                                 values.size(), nullptr) == GEODISK_OK);
    return values;
}

geodisk_report report_on(const geodisk_samples* samples) {
    auto report = sized<geodisk_report>();
    REQUIRE(geodisk_samples_report(samples, &report, nullptr) == GEODISK_OK);
    return report;
}

} // namespace

TEST_CASE("a request with features and an exact count is that of C++") {
    SampleRequest wanted;
    wanted.params.seed = 4;
    wanted.count = 150;
    wanted.is_exact = true;
    wanted.features = 30;
    CubeRequest cube;
    const RequestedSet found = expected_set(cube.shape, wanted);
    cube.request.count = 150;
    cube.request.is_exact = 1;
    cube.request.features = 30;
    for (const auto& samples : {cube.sample(), cube.poll()}) {
        CHECK(placed(samples.get()) == placed_of(found));
        const geodisk_report report = report_on(samples.get());
        CHECK(report.samples == 150);
        CHECK(report.min_distance == found.min_distance);
        CHECK(report.tries == found.tries);
        CHECK(report.cut == found.cut);
        CHECK(report.corners == 8);
        CHECK(report.feature_length == doctest::Approx(found.feature_length));
        const auto features = integers(samples.get(), GEODISK_FEATURE);
        for (std::size_t i = 0; i < features.size(); ++i) {
            CHECK(features[i] == static_cast<std::uint32_t>(found.features[i]));
        }
        CHECK(geodisk_samples_width(samples.get(), GEODISK_LEVEL) == 0);
        std::vector<double> radii(150);
        REQUIRE(geodisk_samples_copy(samples.get(), GEODISK_RADIUS, GEODISK_FLOAT64, radii.data(),
                                     0, radii.size(), nullptr) == GEODISK_OK);
        CHECK(radii[0] == found.min_distance / 2);
    }
}

TEST_CASE("a request of levels tells the level of each sample") {
    SampleRequest wanted;
    wanted.params.seed = 4;
    wanted.params.min_distance = 0.1;
    wanted.order = SampleOrder::progressive;
    CubeRequest cube;
    const RequestedSet found = expected_set(cube.shape, wanted);
    REQUIRE(found.ends.size() > 1);
    cube.params.min_distance = 0.1;
    cube.request.order = GEODISK_ORDER_PROGRESSIVE;
    for (const auto& samples : {cube.sample(), cube.poll()}) {
        CHECK(placed(samples.get()) == placed_of(found));
        CHECK(report_on(samples.get()).levels == found.levels.count);
        const auto levels = integers(samples.get(), GEODISK_LEVEL);
        CHECK(levels.front() == 0);
        CHECK(levels[found.ends[0] - 1] == 0);
        CHECK(levels[found.ends[0]] == 1);
        CHECK(levels.back() == found.levels.count - 1);
    }
}

TEST_CASE("a request of the farthest order tells how far each sample is from those before") {
    SampleRequest wanted;
    wanted.params.seed = 4;
    wanted.params.min_distance = 0.3;
    wanted.order = SampleOrder::farthest;
    wanted.keep = 10;
    CubeRequest cube;
    const RequestedSet found = expected_set(cube.shape, wanted);
    cube.params.min_distance = 0.3;
    cube.request.order = GEODISK_ORDER_FARTHEST;
    cube.request.keep = 10;
    for (const auto& samples : {cube.sample(), cube.poll()}) {
        CHECK(placed(samples.get()) == placed_of(found));
        std::vector<float> cover(10);
        REQUIRE(geodisk_samples_copy(samples.get(), GEODISK_COVER, GEODISK_FLOAT32, cover.data(), 0,
                                     cover.size(), nullptr) == GEODISK_OK);
        CHECK(cover == found.farthest->distances);
        CHECK(integers(samples.get(), GEODISK_ROW) == found.farthest->indices);
        CHECK(report_on(samples.get()).cover == found.farthest->cover);
    }
    CHECK(found.unkept > 0);
    cube.params.stop_count = 20;
    CHECK(report_on(cube.sample().get()).missing == 0); // 10 of 20 are left out.
}

TEST_CASE("a request of the farthest order is cancelled while it samples or orders") {
    CubeRequest cube;
    cube.params.min_distance = 0.05;
    cube.request.order = GEODISK_ORDER_FARTHEST;
    cube.request.params = &cube.params;
    for (const std::uint32_t polls : {0u, 5u, 40u}) {
        REQUIRE(geodisk_start_request(shared_sampler(), cube.mesh.get(), &cube.request, nullptr) ==
                GEODISK_OK);
        geodisk_samples* samples = nullptr;
        geodisk_status status = GEODISK_OK;
        for (std::uint32_t i = 0; status == GEODISK_OK && samples == nullptr; ++i) {
            if (i == polls) {
                geodisk_cancel(shared_sampler());
            }
            status = geodisk_poll(shared_sampler(), 1, &samples, nullptr);
        }
        CHECK((status == GEODISK_CANCELLED) == (samples == nullptr)); // It may have been soon done.
        geodisk_samples_release(samples);
    }
    CHECK(cube.sample());
}

TEST_CASE("a request that contradicts itself is refused, and the sampler stays free") {
    CubeRequest cube;
    cube.request.count = 50;
    cube.request.is_exact = 1;
    cube.params.darts = 100;
    CHECK(cube.refusal() == "is_exact and darts exclude each other: darts stop at an exact "
                            "count already");
    cube.params.darts = 0;
    cube.request.order = 7;
    CHECK(cube.refusal() == "request->order is none of the three");
    cube.request.order = GEODISK_ORDER_DART;
    cube.request.count = -1;
    CHECK(cube.refusal() == "count is -1, not a number of samples");
    cube.request.count = 50;
    CHECK(geodisk_samples_count(cube.sample().get()) == 50);

    cube.request.params = nullptr;
    CHECK(geodisk_start_request(shared_sampler(), cube.mesh.get(), &cube.request, nullptr) ==
          GEODISK_INVALID_ARGUMENT);
    CHECK(geodisk_start_request(shared_sampler(), cube.mesh.get(), nullptr, nullptr) ==
          GEODISK_INVALID_ARGUMENT);
}

TEST_CASE("a request is cancelled amid its runs") {
    CubeRequest cube;
    cube.request.params = &cube.params;
    cube.params.min_distance = 0.004;
    cube.request.features = 30;
    REQUIRE(geodisk_start_request(shared_sampler(), cube.mesh.get(), &cube.request, nullptr) ==
            GEODISK_OK);
    CHECK(geodisk_start_request(shared_sampler(), cube.mesh.get(), &cube.request, nullptr) ==
          GEODISK_BUSY);
    geodisk_cancel(shared_sampler());
    geodisk_samples* samples = nullptr;
    geodisk_status status = GEODISK_OK;
    while (status == GEODISK_OK) {
        status = geodisk_poll(shared_sampler(), 1000, &samples, nullptr);
    }
    CHECK(status == GEODISK_CANCELLED);
    CHECK(geodisk_poll(shared_sampler(), 0, &samples, nullptr) == GEODISK_INVALID_ARGUMENT);
}

TEST_CASE("several requests at once give what each gives alone, with and without waiting") {
    CubeRequest a, b, c;
    a.request.count = 90;
    b.request.features = 30;
    b.params.min_distance = 0.3;
    c.params.min_distance = 0.3;
    c.params.seed = 5;
    const Owned<geodisk_samples> alone[] = {a.sample(), b.sample(), c.sample()};
    std::vector<geodisk_mesh_request> requests;
    for (const CubeRequest* const one : {&a, &b, &c}) {
        requests.push_back({sizeof(geodisk_mesh_request), one->mesh.get(), &one->request});
    }
    const auto check = [&](std::vector<geodisk_samples*> made) {
        for (std::size_t i = 0; i < made.size(); ++i) {
            REQUIRE(made[i] != nullptr);
            const Owned<geodisk_samples> own(made[i]);
            CHECK(placed(own.get()) == placed(alone[i].get()));
            CHECK(integers(own.get(), GEODISK_FACE) == integers(alone[i].get(), GEODISK_FACE));
            CHECK(report_on(own.get()).min_distance == report_on(alone[i].get()).min_distance);
        }
    };
    std::vector<geodisk_samples*> made(3);
    REQUIRE(geodisk_sample_requests(shared_sampler(), requests.data(), 3, nullptr, nullptr,
                                    made.data(), nullptr) == GEODISK_OK);
    check(made);
    REQUIRE(geodisk_start_requests(shared_sampler(), requests.data(), 3, nullptr) == GEODISK_OK);
    do {
        REQUIRE(geodisk_poll(shared_sampler(), 1000, made.data(), nullptr) == GEODISK_OK);
        CHECK((made[0] == nullptr) == (made[2] == nullptr));
    } while (made[0] == nullptr);
    check(made);
}

TEST_CASE("what is wrong with one of several requests names it, and gives no samples") {
    CubeRequest good, bad;
    good.params.min_distance = bad.params.min_distance = 0.3;
    good.request.params = &good.params;
    bad.request.params = &bad.params;
    geodisk_mesh_request requests[] = {
        {sizeof(geodisk_mesh_request), good.mesh.get(), &good.request},
        {sizeof(geodisk_mesh_request), bad.mesh.get(), &bad.request}};
    geodisk_samples* made[2] = {};
    const auto refusal = [&](std::size_t count = 2) {
        auto error = sized<geodisk_error>();
        CHECK(geodisk_sample_requests(shared_sampler(), requests, count, nullptr, nullptr, made,
                                      &error) == GEODISK_INVALID_ARGUMENT);
        CHECK(geodisk_start_requests(shared_sampler(), requests, count, nullptr) ==
              GEODISK_INVALID_ARGUMENT);
        CHECK(made[0] == nullptr);
        CHECK(made[1] == nullptr);
        return std::string(error.message);
    };
    CHECK(refusal(0) == "there are no requests");
    bad.params.min_distance = -1;
    CHECK(refusal().starts_with("mesh 1: "));
    requests[1].request = nullptr;
    CHECK(refusal() == "requests[1]: request is NULL");
    requests[1].mesh = nullptr;
    CHECK(refusal().starts_with("requests[1]: "));
    requests[1].struct_size = 3;
    CHECK(refusal().starts_with("requests[1]"));
    // A full disk everywhere leaves no room for a count: found after the first job.
    const geodisk_surface_point center{0, {1, 0, 0}};
    const double radius = 100;
    requests[1] = {sizeof(geodisk_mesh_request), bad.mesh.get(), &bad.request};
    bad.params.min_distance = 0;
    bad.params.avoid = &center;
    bad.params.avoid_radii = &radius;
    bad.params.avoid_count = 1;
    bad.request.count = 20;
    REQUIRE(geodisk_start_requests(shared_sampler(), requests, 2, nullptr) == GEODISK_OK);
    auto error = sized<geodisk_error>();
    geodisk_status status = GEODISK_OK;
    while (status == GEODISK_OK) {
        status = geodisk_poll(shared_sampler(), 1000, made, &error);
        REQUIRE(made[0] == nullptr);
    }
    CHECK(status == GEODISK_INVALID_ARGUMENT);
    CHECK(std::string(error.message).starts_with("mesh 1: count: found no room"));
    CHECK(geodisk_poll(shared_sampler(), 0, made, nullptr) == GEODISK_INVALID_ARGUMENT);
}

TEST_CASE("a request in a box is that of C++, with and without waiting") {
    BoxRequest wanted;
    wanted.params.extents = {1, 2};
    wanted.params.is_periodic = true;
    wanted.params.seed = 9;
    wanted.count = 80;
    wanted.is_exact = true;
    Runner runner = expect(Runner::create(shared_context().device(), shared_context().queue()));
    const RequestedSet found = expect(geodisk::sample(runner, wanted));
    const double extents[] = {1, 2};
    auto params = sized<geodisk_box_params>();
    params.extents = extents;
    params.dimension = 2;
    params.is_periodic = 1;
    params.seed = 9;
    auto request = sized<geodisk_box_request>();
    request.params = &params;
    request.count = 80;
    request.is_exact = 1;
    geodisk_samples* made = nullptr;
    REQUIRE(geodisk_sample_box_request(shared_sampler(), &request, nullptr, nullptr, &made,
                                       nullptr) == GEODISK_OK);
    const Owned<geodisk_samples> waited(made);
    REQUIRE(geodisk_start_box_request(shared_sampler(), &request, nullptr) == GEODISK_OK);
    made = nullptr;
    while (made == nullptr) {
        REQUIRE(geodisk_poll(shared_sampler(), 1000, &made, nullptr) == GEODISK_OK);
    }
    const Owned<geodisk_samples> polled(made);
    for (const auto* const samples : {waited.get(), polled.get()}) {
        REQUIRE(geodisk_samples_count(samples) == 80);
        std::vector<double> points(2 * 80);
        REQUIRE(geodisk_samples_copy(samples, GEODISK_POSITION, GEODISK_FLOAT64, points.data(), 0,
                                     80, nullptr) == GEODISK_OK);
        CHECK(points == found.set.points);
        CHECK(report_on(samples).min_distance == found.min_distance);
        CHECK(report_on(samples).cut == found.cut);
        CHECK(report_on(samples).tries == found.tries);
        CHECK(report_on(samples).missing == 0);
    }
    auto error = sized<geodisk_error>();
    request.params = nullptr;
    CHECK(geodisk_start_box_request(shared_sampler(), &request, &error) ==
          GEODISK_INVALID_ARGUMENT);
    CHECK(std::string(error.message) == "params is NULL");
}

} // namespace geodisk::test
