// Walls, what is seen from outside, and disks that hold an area, of the C API, beside C++.
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <geodisk/geodesics.hpp>
#include <geodisk/neighbours.hpp>
#include <geodisk/outside_faces.hpp>
#include <geodisk/walls.hpp>

#include "c/api.hpp"
#include "device_run.hpp"

namespace geodisk::test {
namespace {

geodisk_walls walls_of(const TestMesh& mesh) {
    auto walls = sized<geodisk_walls>();
    walls.indices = mesh.triangles.data();
    walls.face_count = mesh.face_count();
    walls.vertex_count = mesh.vertex_count();
    return walls;
}

std::string cut_refusal(const geodisk_walls* walls) {
    std::vector<std::uint32_t> indices(10000, 7);
    std::size_t count = 5;
    auto error = sized<geodisk_error>();
    CHECK(geodisk_cut(walls, indices.data(), nullptr, 0, &count, &error) != GEODISK_OK);
    CHECK(std::ranges::count(indices, 7u) == 10000); // Nothing was written.
    CHECK(count == 5);
    return error.message;
}

} // namespace

TEST_CASE("meshes are cut along walls as in C++") {
    const TestMesh shape = builtin("cube", 4);
    const std::vector<std::uint8_t> faces = [&] {
        std::vector<std::uint8_t> mask(shape.face_count(), 0);
        mask[3] = mask[17] = 9;
        return mask;
    }();
    const std::vector<std::array<std::uint32_t, 2>> edges{{shape.triangles[0], shape.triangles[1]},
                                                          {shape.triangles[1], shape.triangles[2]}};
    const CutMesh expected = expect(cut(shape.triangles, shape.vertex_count(), {faces, edges}));
    REQUIRE_FALSE(expected.copied.empty());
    geodisk_walls walls = walls_of(shape);
    walls.faces = faces.data();
    walls.edges = edges.front().data();
    walls.edge_count = edges.size();
    std::vector<std::uint32_t> indices(shape.triangles.size()), copied(indices.size());
    std::size_t count = 0;
    REQUIRE(geodisk_cut(&walls, indices.data(), nullptr, 0, &count, nullptr) == GEODISK_OK);
    CHECK(indices == expected.triangles);
    CHECK(count == expected.copied.size());
    REQUIRE(geodisk_cut(&walls, indices.data(), copied.data(), copied.size(), &count, nullptr) ==
            GEODISK_OK);
    copied.resize(count);
    CHECK(copied == expected.copied);
    CHECK(cut_refusal(nullptr) == "walls is NULL");
    CHECK(geodisk_cut(&walls, nullptr, nullptr, 0, &count, nullptr) == GEODISK_INVALID_ARGUMENT);
    walls.edges = nullptr;
    CHECK(cut_refusal(&walls) == "walls->edges is NULL");
    walls.edge_count = 0;
    walls.index_type = 99;
    CHECK(cut_refusal(&walls).find("index_type") != std::string::npos);
    walls.index_type = 0;
    walls.indices = nullptr;
    CHECK(cut_refusal(&walls) == "indices is NULL");
    walls.face_count = SIZE_MAX / 2;
    walls.indices = shape.triangles.data();
    CHECK(cut_refusal(&walls) == "face_count is too large");
}

TEST_CASE("faces seen from outside and radii of disks are those of C++") {
    TestMesh shape = builtin("icosphere", 2);
    const std::uint32_t own = shape.vertex_count();
    const std::size_t corners = shape.triangles.size(), numbers = shape.positions.size();
    for (std::size_t i = 0; i < numbers; ++i) {
        shape.positions.push_back(0.3 * shape.positions[i]);
    }
    for (std::size_t i = 0; i < corners; ++i) {
        shape.triangles.push_back(own + shape.triangles[i]);
    }
    const auto mesh = mesh_of(shape);
    std::vector<std::uint8_t> mask(shape.face_count(), 7);
    REQUIRE(geodisk_outside_faces(mesh.get(), 0.02, nullptr, nullptr, mask.data(), nullptr) ==
            GEODISK_OK);
    CHECK(mask == expect(outside_faces(shape.view())));
    CHECK(geodisk_outside_faces(mesh.get(), 2, nullptr, nullptr, mask.data(), nullptr) ==
          GEODISK_INVALID_ARGUMENT);
    CHECK(geodisk_outside_faces(nullptr, 0, nullptr, nullptr, mask.data(), nullptr) ==
          GEODISK_INVALID_ARGUMENT);

    const PreparedMesh prepared_mesh = prepared(shape);
    const VertexPoints all = expect(vertex_points(prepared_mesh));
    const std::vector<Sample> sources{all.points[3], all.points[50]};
    const std::vector<std::uint32_t> vertices{3, 50};
    auto params = sized<geodisk_distance_params>();
    params.source_vertices = vertices.data();
    params.source_count = vertices.size();
    std::vector<double> radii(2);
    REQUIRE(geodisk_disk_radii(mesh.get(), &params, 0.7, nullptr, nullptr, radii.data(), nullptr) ==
            GEODISK_OK);
    CHECK(radii == expect(disk_radii(prepared_mesh, sources, 0.7)));
    auto error = sized<geodisk_error>();
    CHECK(geodisk_disk_radii(mesh.get(), &params, -1, nullptr, nullptr, radii.data(), &error) ==
          GEODISK_INVALID_ARGUMENT);
    CHECK(std::string(error.message) == "the area of disks is -1, not positive and finite");
    const auto stop = [](void*, const geodisk_progress*) -> std::int32_t { return 1; };
    CHECK(geodisk_disk_radii(mesh.get(), &params, 0.7, stop, nullptr, radii.data(), nullptr) ==
          GEODISK_CANCELLED);
    CHECK(geodisk_outside_faces(mesh.get(), 0.02, stop, nullptr, mask.data(), nullptr) ==
          GEODISK_CANCELLED);
}

TEST_CASE("samples at vertices are those of C++") {
    const TestMesh shape = builtin("icosphere", 2);
    const auto mesh = mesh_of(shape);
    auto params = sized<geodisk_surface_params>();
    params.min_distance = 0.5;
    auto request = sized<geodisk_request>();
    request.params = &params;
    request.at_vertices = 1;
    geodisk_samples* made = nullptr;
    REQUIRE(geodisk_sample_request(shared_sampler(), mesh.get(), &request, nullptr, nullptr, &made,
                                   nullptr) == GEODISK_OK);
    const Owned<geodisk_samples> samples(made);
    const std::size_t count = geodisk_samples_count(samples.get());
    CHECK(count > 10);
    CHECK(count < shape.vertex_count());
    std::vector<double> weights(3 * count);
    REQUIRE(geodisk_samples_copy(samples.get(), GEODISK_BARYCENTRIC, GEODISK_FLOAT64,
                                 weights.data(), 0, count, nullptr) == GEODISK_OK);
    CHECK(std::ranges::count(weights, 1.0) == static_cast<std::ptrdiff_t>(count));
}

} // namespace geodisk::test
