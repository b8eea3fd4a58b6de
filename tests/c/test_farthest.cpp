// Farthest-point order by the C API is that of the C++ API.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <geodisk/farthest.hpp>
#include <geodisk/runner.hpp>

#include "c/api.hpp"
#include "device_run.hpp"

namespace geodisk::test {
namespace {

geodisk_farthest_params params_for(const std::vector<geodisk_surface_point>& samples,
                                   std::uint32_t count) {
    geodisk_farthest_params params = GEODISK_INIT(geodisk_farthest_params);
    params.samples = samples.data();
    params.sample_count = samples.size();
    params.count = count;
    return params;
}

std::string farthest_refusal(const geodisk_mesh* mesh,
                             const std::vector<geodisk_surface_point>& samples, std::uint32_t count,
                             geodisk_farthest_info* info = nullptr,
                             geodisk_progress_fn progress = nullptr) {
    std::vector<std::uint32_t> order(samples.size() + 1, 77);
    geodisk_error error{};
    error.struct_size = sizeof error;
    const geodisk_farthest_params params = params_for(samples, count);
    CHECK(geodisk_farthest_order(shared_sampler(), mesh, &params, progress, nullptr, order.data(),
                                 nullptr, info, &error) != GEODISK_OK);
    CHECK(order[0] == 77);
    return error.message;
}

} // namespace

TEST_CASE("a farthest-point order is that of C++") {
    const TestMesh shape = builtin("torus-knot", 8);
    const PreparedMesh prepared_mesh = prepared(shape);
    std::vector<geodisk_surface_point> points;
    std::vector<Sample> samples;
    for (std::uint32_t i = 0; i < 90; ++i) {
        points.push_back({i * 3, {0.5f, 0.25f, 0.25f}});
        samples.push_back({i * 3, {0.5f, 0.25f, 0.25f}});
    }
    Runner runner = expect(Runner::create(shared_context().device(), shared_context().queue()));
    const FarthestOrder expected = expect(farthest_order(runner, prepared_mesh, samples, {60}));

    const auto mesh = mesh_of(shape);
    std::vector<std::uint32_t> order(60);
    std::vector<float> distances(60);
    geodisk_farthest_info info{};
    info.struct_size = sizeof info;
    geodisk_farthest_params params = params_for(points, 60);
    REQUIRE(geodisk_farthest_order(shared_sampler(), mesh.get(), &params, nullptr, nullptr,
                                   order.data(), distances.data(), &info, nullptr) == GEODISK_OK);
    CHECK(order == expected.indices);
    CHECK(distances == expected.distances);
    CHECK(info.cover == double{expected.cover});
    CHECK(info.error == expected.error);
    CHECK(info.searches == expected.searches);

    params.existing = 12;
    REQUIRE(geodisk_farthest_order(shared_sampler(), mesh.get(), &params, nullptr, nullptr,
                                   order.data(), distances.data(), &info, nullptr) == GEODISK_OK);
    const FarthestOrder after = expect(farthest_order(runner, prepared_mesh, samples, {60, 0, 12}));
    CHECK(order == after.indices);
    CHECK(order[11] == 11);
    CHECK(distances == after.distances);
    params.existing = 0;
    params.start = 7;
    REQUIRE(geodisk_farthest_order(shared_sampler(), mesh.get(), &params, nullptr, nullptr,
                                   order.data(), nullptr, nullptr, nullptr) == GEODISK_OK);
    CHECK(order == expect(farthest_order(runner, prepared_mesh, samples, {60, 7})).indices);
    CHECK(order[0] == 7);
}

TEST_CASE("orders that cannot be are refused") {
    const auto mesh = mesh_of(builtin("cube", 2));
    const std::vector<geodisk_surface_point> points{{0, {1, 0, 0}}, {7, {0, 1, 0}}};
    CHECK(farthest_refusal(mesh.get(), points, 3) == "there are 2 samples, fewer than 3 to choose");
    CHECK(farthest_refusal(mesh.get(), {}, 0) == "there is no sample to put in order");
    CHECK(farthest_refusal(nullptr, points, 0) == "mesh or order is NULL");
    geodisk_farthest_info info{};
    CHECK(farthest_refusal(mesh.get(), points, 0, &info) == "info->struct_size is not its size");
    CHECK(farthest_refusal(mesh.get(), points, 0, nullptr,
                           [](void*, const geodisk_progress*) { return 1; }) == "cancelled");
    geodisk_error error{};
    error.struct_size = sizeof error;
    std::uint32_t order[2];
    geodisk_farthest_params params = params_for(points, 0);
    params.samples = nullptr;
    CHECK(geodisk_farthest_order(shared_sampler(), mesh.get(), &params, nullptr, nullptr, order,
                                 nullptr, nullptr, &error) == GEODISK_INVALID_ARGUMENT);
    CHECK(std::string(error.message) == "params->samples is NULL");
}

} // namespace geodisk::test
