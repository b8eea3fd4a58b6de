// Neighbours by the C API are those of the C++ API.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include <geodisk/neighbours.hpp>
#include <geodisk/runner.hpp>

#include "c/api.hpp"
#include "c/lent.hpp"
#include "device_run.hpp"
#include "embed/workshop.hpp"

namespace geodisk::test {
namespace {

struct ReleaseSearch {
    void operator()(geodisk_neighbours* neighbours) const {
        geodisk_neighbours_release(neighbours);
    }
};
using Lists = std::unique_ptr<geodisk_neighbours, ReleaseSearch>;

geodisk_neighbour_params params_within(double within) {
    geodisk_neighbour_params params{};
    params.struct_size = sizeof params;
    params.within = within;
    return params;
}

Lists found(const geodisk_mesh* mesh, const geodisk_neighbour_params& params) {
    geodisk_neighbours* lists = nullptr;
    geodisk_error error{};
    error.struct_size = sizeof error;
    const geodisk_status status =
        geodisk_find_neighbours(shared_sampler(), mesh, &params, nullptr, nullptr, &lists, &error);
    INFO(error.message);
    REQUIRE(status == GEODISK_OK);
    return Lists(lists);
}

geodisk_neighbour_arrays arrays_of(const Lists& lists) {
    geodisk_neighbour_arrays arrays{};
    arrays.struct_size = sizeof arrays;
    REQUIRE(geodisk_neighbours_describe(lists.get(), &arrays, nullptr) == GEODISK_OK);
    return arrays;
}

std::string refusal(const geodisk_mesh* mesh, const geodisk_neighbour_params& params,
                    geodisk_progress_fn progress = nullptr) {
    geodisk_neighbours* lists = nullptr;
    geodisk_error error{};
    error.struct_size = sizeof error;
    CHECK(geodisk_find_neighbours(shared_sampler(), mesh, &params, progress, nullptr, &lists,
                                  &error) != GEODISK_OK);
    CHECK(lists == nullptr);
    return error.message;
}

} // namespace

TEST_CASE("neighbours are those of C++") {
    const TestMesh shape = builtin("torus-knot", 8);
    const PreparedMesh prepared_mesh = prepared(shape);
    const VertexPoints vertices = expect(vertex_points(prepared_mesh));
    NeighbourQuery query;
    query.sources = vertices.points;
    query.within = 0.3;
    Runner runner = expect(Runner::create(shared_context().device(), shared_context().queue()));
    const Neighbours expected = expect(find_neighbours(runner, prepared_mesh, query));

    const auto mesh = mesh_of(shape);
    const Lists lists = found(mesh.get(), params_within(0.3));
    const geodisk_neighbour_arrays arrays = arrays_of(lists);
    REQUIRE(arrays.source_count == vertices.points.size());
    REQUIRE(arrays.pair_count == expected.indices.size());
    CHECK(std::vector(arrays.vertices, arrays.vertices + arrays.source_count) == vertices.vertices);
    CHECK(std::vector(arrays.offsets, arrays.offsets + arrays.source_count + 1) ==
          expected.offsets);
    CHECK(std::vector(arrays.indices, arrays.indices + arrays.pair_count) == expected.indices);
    CHECK(std::vector(arrays.distances, arrays.distances + arrays.pair_count) ==
          expected.distances);
    CHECK(arrays.error == expected.error);

    geodisk_neighbour_params some = params_within(0.3);
    const std::uint32_t wanted[] = {7, 3};
    some.source_vertices = wanted;
    some.source_count = 2;
    some.kind = GEODISK_AMONG_SOURCES;
    CHECK(arrays_of(found(mesh.get(), some)).pair_count <= 2);
    some.kind = GEODISK_AMONG_VERTICES;
    some.nearest = 1; // Itself.
    const Lists few = found(mesh.get(), some);
    CHECK(arrays_of(few).indices[0] == 7);
    CHECK(arrays_of(few).indices[1] == 3);
    CHECK(arrays_of(few).distances[1] == 0);
}

TEST_CASE("a search goes on poll by poll, apart from what the caller gave") {
    const auto mesh = mesh_of(builtin("torus-knot", 8));
    geodisk_sampler* const sampler = shared_sampler();
    std::vector<geodisk_surface_point> points{{0, {1, 0, 0}}, {7, {0, 1, 0}}, {40, {0, 0, 1}}};
    std::vector<double> radii{0.5, 0.2, 1};
    geodisk_neighbour_params params = params_within(0);
    params.sources = points.data();
    params.source_count = points.size();
    params.radii = radii.data();
    const Lists expected = found(mesh.get(), params);
    REQUIRE(geodisk_start_neighbours(sampler, mesh.get(), &params, nullptr) == GEODISK_OK);
    std::fill(points.begin(), points.end(), geodisk_surface_point{});
    std::fill(radii.begin(), radii.end(), 0);
    CHECK(geodisk_start_neighbours(sampler, mesh.get(), &params, nullptr) == GEODISK_BUSY);
    geodisk_samples* samples = nullptr;
    CHECK(geodisk_poll(sampler, 0, &samples, nullptr) == GEODISK_INVALID_ARGUMENT);
    geodisk_progress progress{};
    progress.struct_size = sizeof progress;
    CHECK(geodisk_sampler_progress(sampler, &progress, nullptr) == GEODISK_OK);
    CHECK(progress.candidates == 3);
    geodisk_neighbours* lists = nullptr;
    while (lists == nullptr) {
        REQUIRE(geodisk_poll_neighbours(sampler, 10, &lists, nullptr) == GEODISK_OK);
    }
    const Lists polled(lists);
    const geodisk_neighbour_arrays one = arrays_of(expected), other = arrays_of(polled);
    REQUIRE(one.pair_count == other.pair_count);
    CHECK(std::equal(one.offsets, one.offsets + 4, other.offsets));
    CHECK(std::equal(one.indices, one.indices + one.pair_count, other.indices));
    CHECK(std::equal(one.distances, one.distances + one.pair_count, other.distances));
    CHECK(geodisk_poll_neighbours(sampler, 0, &lists, nullptr) == GEODISK_INVALID_ARGUMENT);

    params = params_within(0.3);
    REQUIRE(geodisk_start_neighbours(sampler, mesh.get(), &params, nullptr) == GEODISK_OK);
    geodisk_cancel(sampler);
    geodisk_status status = GEODISK_OK;
    while (status == GEODISK_OK) {
        status = geodisk_poll_neighbours(sampler, 10, &lists, nullptr);
    }
    CHECK(status == GEODISK_CANCELLED);
    CHECK(found(mesh.get(), params)); // It stays usable.
}

TEST_CASE("neighbours on the device, in the frames of an engine") {
    const auto device = borrowed(lent_device(shared_context().device(), shared_context().queue()));
    const auto mesh = mesh_of(builtin("torus-knot", 8));
    const geodisk_neighbour_params params = params_within(0.3);
    const Lists expected = found(mesh.get(), params);
    const geodisk_neighbour_arrays wanted = arrays_of(expected);
    const auto sampler = owned<geodisk_sampler>([&](auto** made, geodisk_error* error) {
        return geodisk_sampler_create(device.get(), nullptr, made, error);
    });
    Workshop workshop(shared_context());
    workshop.cut({});
    for (const bool waits : {false, true}) {
        auto options = sized<geodisk_frame_neighbour_options>();
        options.frames = 3;
        const auto frames = owned<geodisk_frame_neighbours>([&](auto** made, geodisk_error* error) {
            return geodisk_frame_neighbours_create(device.get(), mesh.get(), &params, &options,
                                                   made, error);
        });
        std::int32_t is_complete = 0;
        for (std::uint32_t frame = 0; !waits && is_complete == 0; ++frame) {
            REQUIRE(frame < 10'000);
            workshop.frame(frame, [&](VkCommandBuffer commands) {
                REQUIRE(geodisk_frame_neighbours_record(frames.get(), commands, &is_complete,
                                                        nullptr) == GEODISK_OK);
            });
        }
        if (waits) {
            REQUIRE(geodisk_frame_neighbours_wait(frames.get(), sampler.get(), nullptr) ==
                    GEODISK_OK);
        }
        auto lists = sized<geodisk_frame_neighbour_lists>();
        REQUIRE(geodisk_frame_neighbours_describe(frames.get(), &lists, nullptr) == GEODISK_OK);
        CHECK(lists.is_complete == 1);
        CHECK(lists.ready == wanted.source_count);
        CHECK(lists.error == wanted.error);
        REQUIRE(lists.pair_count == wanted.pair_count);
        const auto read = [&](std::uint64_t offset, std::size_t count, void* to) {
            workshop.frame(0, [&](VkCommandBuffer commands) {
                workshop.record_download(
                    commands, {handle_of<VkBuffer>(lists.buffer), offset, 4 * count}, 4 * count);
            });
            std::memcpy(to, workshop.download_bytes().data(), 4 * count);
        };
        std::vector<std::uint32_t> offsets(wanted.source_count + 2), indices(wanted.pair_count);
        std::vector<float> distances(wanted.pair_count);
        read(lists.offsets_offset, offsets.size(), offsets.data());
        read(lists.indices_offset, indices.size(), indices.data());
        read(lists.distances_offset, distances.size(), distances.data());
        CHECK(offsets.back() == wanted.source_count);
        CHECK(std::equal(offsets.begin(), offsets.end() - 1, wanted.offsets));
        CHECK(std::equal(indices.begin(), indices.end(), wanted.indices));
        CHECK(std::equal(distances.begin(), distances.end(), wanted.distances));
    }
    geodisk_frame_neighbours* made = nullptr;
    CHECK(geodisk_frame_neighbours_create(device.get(), nullptr, &params, nullptr, &made,
                                          nullptr) == GEODISK_INVALID_ARGUMENT);
    CHECK(geodisk_frame_neighbours_create(device.get(), mesh.get(), nullptr, nullptr, &made,
                                          nullptr) == GEODISK_INVALID_ARGUMENT);
    CHECK(geodisk_frame_neighbours_record(nullptr, nullptr, nullptr, nullptr) ==
          GEODISK_INVALID_ARGUMENT);
    CHECK(geodisk_frame_neighbours_wait(nullptr, nullptr, nullptr) == GEODISK_INVALID_ARGUMENT);
    CHECK(geodisk_frame_neighbours_describe(nullptr, nullptr, nullptr) == GEODISK_INVALID_ARGUMENT);
    CHECK(made == nullptr);
    geodisk_frame_neighbours_release(nullptr);
}

TEST_CASE("neighbours among points, with distances of their own") {
    const auto mesh = mesh_of(builtin("cube", 2));
    const geodisk_surface_point points[] = {{0, {1, 0, 0}}, {0, {0, 1, 0}}, {1, {0, 0, 1}}};
    const double radii[] = {0.01, 9, 9};
    geodisk_neighbour_params params = params_within(0);
    params.sources = params.points = points;
    params.source_count = params.point_count = 3;
    params.radii = radii;
    params.kind = GEODISK_AMONG_POINTS;
    const Lists lists = found(mesh.get(), params);
    const geodisk_neighbour_arrays arrays = arrays_of(lists);
    CHECK(arrays.vertices == nullptr);
    CHECK(arrays.offsets[1] >= 1);
    CHECK(arrays.offsets[2] - arrays.offsets[1] == 3);
    params.kind = GEODISK_AMONG_SOURCES;
    CHECK(arrays_of(found(mesh.get(), params)).offsets[3] <= 6);
}

TEST_CASE("neighbours that cannot be found are refused") {
    const auto mesh = mesh_of(builtin("cube", 2));
    geodisk_neighbour_params params = params_within(0);
    CHECK(refusal(mesh.get(), params).find("which is not positive and finite") !=
          std::string::npos);
    params = params_within(1);
    params.kind = 7;
    CHECK(refusal(mesh.get(), params) == "params->kind is no geodisk_neighbour_kind");
    params = params_within(1);
    const std::uint32_t vertex = 26;
    params.source_vertices = &vertex;
    params.source_count = 1;
    CHECK(refusal(mesh.get(), params) == "source 0 is vertex 26, which no face uses");
    const geodisk_surface_point point{};
    params.sources = &point;
    CHECK(refusal(mesh.get(), params) ==
          "params->sources and params->source_vertices contradict each other");
    params = params_within(1);
    params.point_count = 2;
    CHECK(refusal(mesh.get(), params) == "params->points is NULL");
    params = params_within(1);
    params.max_pairs = 3;
    CHECK(refusal(mesh.get(), params).find("pairs are to be expected") != std::string::npos);
    CHECK(refusal(nullptr, params_within(1)) == "mesh or neighbours is NULL");
    CHECK(refusal(mesh.get(), params_within(1), [](void*, const geodisk_progress*) { return 1; }) ==
          "cancelled");
    CHECK(geodisk_neighbours_describe(nullptr, nullptr, nullptr) == GEODISK_INVALID_ARGUMENT);
    geodisk_neighbours_release(nullptr);
}

} // namespace geodisk::test
