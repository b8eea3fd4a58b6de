// Cells by the C API are those of the C++ API.
#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <geodisk/cells.hpp>
#include <geodisk/nearest.hpp>
#include <geodisk/runner.hpp>

#include "c/api.hpp"
#include "device_run.hpp"

namespace geodisk::test {
namespace {

struct Release {
    void operator()(geodisk_cells* cells) const { geodisk_cells_release(cells); }
    void operator()(geodisk_nearest* nearest) const { geodisk_nearest_release(nearest); }
};
using Cells = std::unique_ptr<geodisk_cells, Release>;
using Nearest = std::unique_ptr<geodisk_nearest, Release>;

geodisk_cell_params params_of(const std::vector<geodisk_surface_point>& samples) {
    geodisk_cell_params params{};
    params.struct_size = sizeof params;
    params.samples = samples.data();
    params.sample_count = samples.size();
    return params;
}

std::string refusal(const geodisk_mesh* mesh, const geodisk_cell_params& params,
                    geodisk_progress_fn progress = nullptr) {
    geodisk_cells* cells = nullptr;
    geodisk_error error{};
    error.struct_size = sizeof error;
    CHECK(geodisk_find_cells(shared_sampler(), mesh, &params, progress, nullptr, &cells, &error) !=
          GEODISK_OK);
    CHECK(cells == nullptr);
    return error.message;
}

} // namespace

TEST_CASE("cells are those of C++") {
    const TestMesh shape = builtin("torus-knot", 4);
    const PreparedMesh prepared_mesh = prepared(shape);
    std::vector<Sample> samples;
    std::vector<geodisk_surface_point> points;
    for (std::uint32_t face = 0; face < shape.face_count(); face += 20) {
        samples.push_back({face, {0.5f, 0.25f, 0.25f}});
        points.push_back({face, {0.5f, 0.25f, 0.25f}});
    }
    Runner runner = expect(Runner::create(shared_context().device(), shared_context().queue()));
    const SurfaceCells expected = expect(find_cells(runner, prepared_mesh, samples));

    const auto mesh = mesh_of(shape);
    geodisk_cell_params params = params_of(points);
    geodisk_cells* made = nullptr;
    REQUIRE(geodisk_find_cells(shared_sampler(), mesh.get(), &params, nullptr, nullptr, &made,
                               nullptr) == GEODISK_OK);
    const Cells cells(made);
    geodisk_cell_arrays arrays{};
    arrays.struct_size = sizeof arrays;
    REQUIRE(geodisk_cells_describe(cells.get(), &arrays, nullptr) == GEODISK_OK);
    REQUIRE(arrays.sample_count == samples.size());
    REQUIRE(arrays.edge_count == expected.edges.size());
    REQUIRE(arrays.triangle_count == expected.triangles.size());
    CHECK(std::vector(arrays.areas, arrays.areas + arrays.sample_count) == expected.areas);
    CHECK(std::ranges::equal(std::as_bytes(std::span(arrays.edges, 2 * arrays.edge_count)),
                             std::as_bytes(std::span(expected.edges))));
    CHECK(std::ranges::equal(std::as_bytes(std::span(arrays.triangles, 3 * arrays.triangle_count)),
                             std::as_bytes(std::span(expected.triangles))));
    CHECK(arrays.area_error == expected.area_error);
    CHECK(arrays.distance_error == expected.distance_error);
    CHECK(arrays.unreached == 0);
    CHECK(arrays.manifold_triangles == expected.dual.manifold);
    CHECK(arrays.euler == expected.dual.euler);
    CHECK(arrays.mesh_euler == 0);

    params.areas_only = 1;
    REQUIRE(geodisk_find_cells(shared_sampler(), mesh.get(), &params, nullptr, nullptr, &made,
                               nullptr) == GEODISK_OK);
    const Cells areas(made);
    REQUIRE(geodisk_cells_describe(areas.get(), &arrays, nullptr) == GEODISK_OK);
    CHECK(arrays.edge_count == 0);
    CHECK(arrays.triangles == nullptr);
}

TEST_CASE("cells of a mask are those of C++") {
    const TestMesh shape = builtin("cube", 2);
    std::vector<geodisk_surface_point> points;
    std::vector<Sample> samples;
    for (std::uint32_t face = 0; face < shape.face_count(); face += 5) {
        samples.push_back({face, {0.5f, 0.25f, 0.25f}});
        points.push_back({face, {0.5f, 0.25f, 0.25f}});
    }
    std::vector<std::uint8_t> mask(shape.face_count(), 0);
    mask[3] = mask[8] = 1;
    CellParams wanted;
    wanted.face_mask = mask;
    Runner runner = expect(Runner::create(shared_context().device(), shared_context().queue()));
    const SurfaceCells expected = expect(find_cells(runner, prepared(shape), samples, wanted));
    geodisk_cell_params params = params_of(points);
    params.face_mask = mask.data();
    geodisk_cells* made = nullptr;
    REQUIRE(geodisk_find_cells(shared_sampler(), mesh_of(shape).get(), &params, nullptr, nullptr,
                               &made, nullptr) == GEODISK_OK);
    const Cells cells(made);
    geodisk_cell_arrays arrays{};
    arrays.struct_size = sizeof arrays;
    REQUIRE(geodisk_cells_describe(cells.get(), &arrays, nullptr) == GEODISK_OK);
    CHECK(std::vector(arrays.areas, arrays.areas + arrays.sample_count) == expected.areas);
}

TEST_CASE("nearest samples are those of C++") {
    const TestMesh shape = builtin("torus-knot", 4);
    const PreparedMesh prepared_mesh = prepared(shape);
    std::vector<Sample> samples, places;
    std::vector<geodisk_surface_point> given, points;
    for (std::uint32_t face = 0; face < shape.face_count(); ++face) {
        places.push_back({face, {0.25f, 0.5f, 0.25f}});
        points.push_back({face, {0.25f, 0.5f, 0.25f}});
        if (face % 20 == 0) {
            samples.push_back({face, {0.5f, 0.25f, 0.25f}});
            given.push_back({face, {0.5f, 0.25f, 0.25f}});
        }
    }
    Runner runner = expect(Runner::create(shared_context().device(), shared_context().queue()));
    const NearestSamples disks = expect(NearestSamples::create(runner, prepared_mesh, samples));
    const std::vector<NearestSample> expected = expect(disks.of(places));

    auto mesh = mesh_of(shape);
    const geodisk_cell_params params = params_of(given);
    geodisk_nearest* made = nullptr;
    REQUIRE(geodisk_nearest_create(shared_sampler(), mesh.get(), &params, nullptr, nullptr, &made,
                                   nullptr) == GEODISK_OK);
    const Nearest nearest(made);
    mesh.reset();
    std::vector<std::uint32_t> found(points.size());
    std::vector<float> distances(points.size());
    REQUIRE(geodisk_nearest_find(nearest.get(), points.data(), points.size(), found.data(),
                                 distances.data(), nullptr) == GEODISK_OK);
    for (std::size_t i = 0; i < points.size(); ++i) {
        CAPTURE(i);
        CHECK(found[i] == expected[i].sample);
        CHECK(distances[i] == expected[i].distance);
    }
    CHECK(geodisk_nearest_error(nearest.get()) == disks.error());

    geodisk_cells* of_disks = nullptr;
    REQUIRE(geodisk_nearest_cells(nearest.get(), nullptr, nullptr, &of_disks, nullptr) ==
            GEODISK_OK);
    const Cells cells(of_disks);
    geodisk_cell_arrays arrays{};
    arrays.struct_size = sizeof arrays;
    REQUIRE(geodisk_cells_describe(cells.get(), &arrays, nullptr) == GEODISK_OK);
    const SurfaceCells expected_cells = expect(disks.cells());
    CHECK(std::vector(arrays.areas, arrays.areas + arrays.sample_count) == expected_cells.areas);
    CHECK(arrays.edge_count == expected_cells.edges.size());

    const auto stop = [](void*, const geodisk_progress*) { return 1; };
    CHECK(geodisk_nearest_cells(nearest.get(), stop, nullptr, &of_disks, nullptr) ==
          GEODISK_CANCELLED);
    points[1].face = shape.face_count();
    CHECK(geodisk_nearest_find(nearest.get(), points.data(), points.size(), found.data(), nullptr,
                               nullptr) == GEODISK_INVALID_ARGUMENT);
    CHECK(geodisk_nearest_find(nearest.get(), nullptr, 1, found.data(), nullptr, nullptr) ==
          GEODISK_INVALID_ARGUMENT);
    CHECK(geodisk_nearest_error(nullptr) == 0);
}

TEST_CASE("samples that cannot be nearest are refused") {
    const auto mesh = mesh_of(builtin("cube", 2));
    const std::vector<geodisk_surface_point> points{{0, {1, 0, 0}}, {48, {0, 1, 0}}};
    const geodisk_cell_params params = params_of(points);
    geodisk_nearest* made = nullptr;
    geodisk_error error{};
    error.struct_size = sizeof error;
    CHECK(geodisk_nearest_create(shared_sampler(), mesh.get(), &params, nullptr, nullptr, &made,
                                 &error) == GEODISK_INVALID_ARGUMENT);
    CHECK(std::string(error.message) == "sample 1 is in face 48, but there are 48");
    CHECK(geodisk_nearest_create(shared_sampler(), nullptr, &params, nullptr, nullptr, &made,
                                 nullptr) == GEODISK_INVALID_ARGUMENT);
    CHECK(made == nullptr);
    CHECK(geodisk_nearest_find(nullptr, nullptr, 0, nullptr, nullptr, nullptr) ==
          GEODISK_INVALID_ARGUMENT);
}

TEST_CASE("cells that cannot be found are refused") {
    const auto mesh = mesh_of(builtin("cube", 2));
    std::vector<geodisk_surface_point> points{{0, {1, 0, 0}}, {9, {0, 1, 0}}};
    geodisk_cell_params params = params_of(points);
    const auto stop = [](void*, const geodisk_progress*) { return 1; };
    CHECK(refusal(mesh.get(), params, stop) == "cancelled");
    params.max_records = 3;
    CHECK(refusal(mesh.get(), params).find("more than the 3 that are allowed") !=
          std::string::npos);
    params = params_of(points);
    params.samples = nullptr;
    CHECK(refusal(mesh.get(), params) == "params->samples is NULL");
    params.sample_count = 0;
    CHECK(refusal(mesh.get(), params) == "there is no sample");
    points[1].face = 48;
    CHECK(refusal(mesh.get(), params_of(points)) == "sample 1 is in face 48, but there are 48");
    CHECK(geodisk_cells_describe(nullptr, nullptr, nullptr) == GEODISK_INVALID_ARGUMENT);
}

} // namespace geodisk::test
