// Distances and paths by the C API are those of the C++ API.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <geodisk/geodesics.hpp>
#include <geodisk/neighbours.hpp>

#include "c/api.hpp"
#include "device_run.hpp"

namespace geodisk::test {
namespace {

const std::vector<geodisk_surface_point> kPoints{{3, {0.5f, 0.25f, 0.25f}}, {77, {0, 1, 0}}};

std::vector<Sample> samples_of(const std::vector<geodisk_surface_point>& points) {
    std::vector<Sample> samples;
    for (const geodisk_surface_point& p : points) {
        samples.push_back({p.face, {p.weights[0], p.weights[1], p.weights[2]}});
    }
    return samples;
}

geodisk_distance_params from_points() {
    geodisk_distance_params params = GEODISK_INIT(geodisk_distance_params);
    params.sources = kPoints.data();
    params.source_count = kPoints.size();
    return params;
}

std::string refusal(const geodisk_mesh* mesh, const geodisk_distance_params& params,
                    geodisk_progress_fn progress = nullptr) {
    std::vector<double> distances(10000, -7);
    geodisk_error error = GEODISK_INIT(geodisk_error);
    CHECK(geodisk_geodesic_distances(mesh, &params, progress, nullptr, distances.data(), nullptr,
                                     &error) != GEODISK_OK);
    CHECK(std::ranges::count(distances, -7) == 10000); // Nothing was written.
    return error.message;
}

} // namespace

TEST_CASE("geodesic distances are those of C++") {
    const TestMesh shape = builtin("torus-knot", 8);
    const PreparedMesh prepared_mesh = prepared(shape);
    const auto mesh = mesh_of(shape);
    const std::vector<Sample> samples = samples_of(kPoints);
    DistanceQuery query;
    query.sources = samples;
    const GeodesicDistances expected = expect(geodesic_distances(prepared_mesh, query));

    geodisk_distance_params params = from_points();
    std::vector<double> distances(shape.vertex_count());
    std::vector<std::uint32_t> nearest(shape.vertex_count());
    REQUIRE(geodisk_geodesic_distances(mesh.get(), &params, nullptr, nullptr, distances.data(),
                                       nearest.data(), nullptr) == GEODISK_OK);
    CHECK(distances == expected.distances);
    CHECK(nearest == expected.nearest);

    // From each of two vertices to points, within a distance.
    const std::vector<std::uint32_t> vertices{5, 40};
    const VertexPoints all = expect(vertex_points(prepared_mesh));
    const std::vector<Sample> sources{all.points[5], all.points[40]};
    query.sources = sources;
    query.targets = samples;
    query.each = true;
    query.within = 1.5;
    params.sources = nullptr;
    params.source_vertices = vertices.data();
    params.targets = kPoints.data();
    params.target_count = kPoints.size();
    params.each = 1;
    params.within = 1.5;
    params.max_threads = 2;
    std::vector<double> rows(4);
    REQUIRE(geodisk_geodesic_distances(mesh.get(), &params, nullptr, nullptr, rows.data(), nullptr,
                                       nullptr) == GEODISK_OK);
    CHECK(rows == expect(geodesic_distances(prepared_mesh, query)).distances);
}

TEST_CASE("geodesic distances refuse what they cannot measure, and write nothing then") {
    const auto mesh = mesh_of(builtin("cube", 1));
    geodisk_distance_params params = from_points();
    CHECK(refusal(nullptr, params) == "mesh or distances is NULL");
    CHECK(refusal(mesh.get(), params).find("source 1") == 0); // A cube has no face 77.
    params.sources = nullptr;
    CHECK(refusal(mesh.get(), params) == "params->sources and params->source_vertices are NULL");
    const std::uint32_t none = 99;
    params.source_vertices = &none;
    params.source_count = 1;
    CHECK(refusal(mesh.get(), params) == "source 0 is vertex 99, which no face uses");
    const std::uint32_t vertex = 0;
    params.source_vertices = &vertex;
    params.within = -1;
    CHECK(refusal(mesh.get(), params).find("the limit of distances is -1") == 0);
    params.within = 0;
    params.target_count = 1;
    CHECK(refusal(mesh.get(), params) == "params->targets is NULL");

    params.target_count = 0;
    const auto stop = [](void*, const geodisk_progress*) -> std::int32_t { return 1; };
    CHECK(refusal(mesh_of(builtin("icosphere", 4)).get(), params, stop) == "cancelled");
}

TEST_CASE("a geodesic path is that of C++") {
    const TestMesh shape = builtin("torus-knot", 8);
    const auto mesh = mesh_of(shape);
    const PreparedMesh prepared_mesh = prepared(shape);
    geodisk_path_params params = GEODISK_INIT(geodisk_path_params);
    params.from = kPoints.data();
    params.to_vertex = 60;
    geodisk_path* path = nullptr;
    REQUIRE(geodisk_geodesic_path(mesh.get(), &params, &path, nullptr) == GEODISK_OK);
    const Sample to = expect(vertex_points(prepared_mesh)).points[60];
    const GeodesicPath expected = expect(geodesic_path(prepared_mesh, samples_of(kPoints)[0], to));
    CHECK(geodisk_path_length(path) == expected.length);
    std::size_t count = 0;
    const geodisk_path_point* const points = geodisk_path_points(path, &count);
    REQUIRE(count == expected.points.size());
    for (std::size_t i = 0; i < count; ++i) {
        CHECK(points[i].face == expected.points[i].face);
        CHECK(std::ranges::equal(points[i].weights, expected.points[i].weights));
    }
    geodisk_path_release(path);

    geodisk_error error = GEODISK_INIT(geodisk_error);
    params.to_vertex = 1u << 30;
    CHECK(geodisk_geodesic_path(mesh.get(), &params, &path, &error) == GEODISK_INVALID_ARGUMENT);
    CHECK(error.message == std::string("vertex 1073741824, an end, is used by no face"));
    geodisk_path_release(nullptr);
}

} // namespace geodisk::test
