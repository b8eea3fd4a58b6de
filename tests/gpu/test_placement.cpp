// Samples where a caller draws them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <geodisk/placement.hpp>

#include "device_run.hpp"
#include "kernels/place.hpp"
#include "sets.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {
namespace {

/// A caller's vertex: as engines interleave them, with words of no concern between.
struct Vertex {
    float color;
    float position[3];
    float uv[2];
    float normal[3];
};

std::vector<Vertex> placed_vertices(const TestMesh& mesh) {
    std::vector<Vertex> vertices(mesh.vertex_count());
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        vertices[v] = {7, {}, {8, 9}, {}};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            vertices[v].position[axis] =
                static_cast<float>(mesh.positions[std::size_t{3} * v + axis]);
            // Any vector will do.
            vertices[v].normal[axis] = std::sin(static_cast<float>(v + 5 * axis));
        }
    }
    return vertices;
}

/// The bytes of a caller's array; whole words of them.
template <class T>
std::vector<std::byte> bytes_of(const std::vector<T>& array) {
    std::vector<std::byte> bytes((array.size() * sizeof(T) + 3) / 4 * 4);
    std::memcpy(bytes.data(), array.data(), array.size() * sizeof(T));
    return bytes;
}

/// A run to its end, and a caller who draws its samples.
struct DrawnScene {
    Domain domain;
    DeviceRun run;
    DeviceBuffer vertices, indices, placed, arguments;
    PlacementSource source;
    PlacementTarget target;

    DrawnScene(Domain of, const std::vector<Vertex>& vertex_array,
               const std::vector<std::byte>& index, const SamplerOptions& options = {})
        : domain(std::move(of)), run(domain, {}, options) {
        const auto vertex_bytes = bytes_of(vertex_array);
        vertices = run.make_buffer(vertex_bytes.size());
        std::copy(vertex_bytes.begin(), vertex_bytes.end(), vertices.bytes().begin());
        indices = run.make_buffer(index.size());
        std::copy(index.begin(), index.end(), indices.bytes().begin());
        placed = run.make_buffer(run.plan().sample_capacity * sizeof(gpu::PlacedRec));
        arguments = run.make_buffer(16);
        source.vertices = {vertices.handle(), 0, vertices.size()};
        source.stride = sizeof(Vertex);
        source.position = offsetof(Vertex, position);
        source.indices = {indices.handle(), 0, indices.size()};
        target.placed = {placed.handle(), 0, placed.size()};
        target.arguments = {arguments.handle(), 0, arguments.size()};
        target.vertices_each = 6;
    }

    void decide() {
        run.begin();
        while (decide_batch(run)) {
        }
        run.finish();
    }

    Result<Placement> place() {
        return Placement::create(run.sampler(), domain, run.job(), source, target);
    }

    /// Returns what is there once the samples are placed.
    std::vector<gpu::PlacedRec> points() {
        const Placement placement = expect(place());
        run.submit(
            [&](VkCommandBuffer commands) { expect(placement.record(commands, run.job())); });
        VkDrawIndirectCommand draw;
        std::memcpy(&draw, arguments.bytes().data(), sizeof draw);
        CHECK(draw.vertexCount == 6);
        CHECK(draw.firstVertex == 0);
        CHECK(draw.firstInstance == 0);
        REQUIRE(draw.instanceCount == run.control().ready);
        std::vector<gpu::PlacedRec> points(draw.instanceCount);
        const auto bytes = std::as_writable_bytes(std::span(points));
        std::copy_n(placed.bytes().begin(), bytes.size(), bytes.begin());
        return points;
    }

    std::string refusal() {
        const auto placement = place();
        REQUIRE_FALSE(placement);
        return placement.error().message;
    }
};

bool is_near(const ref::Vec& wanted, float x, float y, float z) {
    const double scale = std::hypot(wanted[0], wanted[1], wanted[2]);
    return std::hypot(wanted[0] - x, wanted[1] - y, wanted[2] - z) <= 1e-6 * (1 + scale);
}

/// Against the twin, sample by sample.
void check_points(const std::vector<gpu::PlacedRec>& points, const DeviceRun& run,
                  const TestMesh& mesh, const std::vector<Vertex>& vertices, bool has_normals) {
    const auto samples = run.read<gpu::SampleRec>(BufferRole::samples, points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const gpu::PlacedRec& point = points[i];
        const gpu::SampleRec& sample = samples[i];
        CHECK(point.face == sample.face);
        CHECK(point.weight1 == sample.weight1);
        CHECK(point.weight2 == sample.weight2);
        CHECK(point.order == sample.order);
        CHECK(point.part == 0);
        std::array<ref::Vec, 3> corners, normals;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vertex& vertex = vertices[mesh.triangles[std::size_t{3} * sample.face + k]];
            corners[k] = {vertex.position[0], vertex.position[1], vertex.position[2]};
            normals[k] = {vertex.normal[0], vertex.normal[1], vertex.normal[2]};
        }
        CHECK(is_near(ref::weighed(corners, sample.weight1, sample.weight2), point.x, point.y,
                      point.z));
        const ref::Vec normal =
            has_normals ? ref::normalized(ref::weighed(normals, sample.weight1, sample.weight2))
                        : ref::face_normal(corners);
        CHECK(is_near(normal, point.normal_x, point.normal_y, point.normal_z));
    }
}

} // namespace

TEST_SUITE("placement") {
    TEST_CASE("samples get position, normal and radius, rounded alike everywhere") {
        const TestMesh mesh = builtin("torus-knot", 8);
        const PreparedMesh surface = prepared(mesh);
        const SampleParams params = params_for(surface, 300);
        const auto vertices = placed_vertices(mesh);
        const auto indices = bytes_of(mesh.triangles);
        DrawnScene scene(expect(Domain::surface(surface, params)), vertices, indices);
        scene.decide();
        const auto points = scene.points();
        CHECK(points.size() == float_set(surface, params, scene.run.plan().error_bound).size());
        check_points(points, scene.run, mesh, vertices, false);
        CHECK(std::all_of(points.begin(), points.end(), [&](const gpu::PlacedRec& point) {
            return point.radius == static_cast<float>(params.min_distance / 2);
        }));
        scene.source.normal = offsetof(Vertex, normal);
        const auto shaded = scene.points();
        check_points(shaded, scene.run, mesh, vertices, true);
        SUBCASE("whatever rounds") {
            SamplerOptions options;
            options.rounding = Rounding::emulated;
            DrawnScene other(expect(Domain::surface(surface, params)), vertices, indices, options);
            other.decide();
            other.source.normal = offsetof(Vertex, normal);
            const auto same = other.points();
            REQUIRE(same.size() == shaded.size());
            CHECK(std::memcmp(same.data(), shaded.data(), same.size() * sizeof same[0]) == 0);
        }
        SUBCASE("by storage buffers alone, and 16-bit indices") {
            std::vector<std::uint16_t> short_indices(mesh.triangles.begin(), mesh.triangles.end());
            SamplerOptions options;
            options.tuning.reads = Reads::storage;
            DrawnScene other(expect(Domain::surface(surface, params)), vertices,
                             bytes_of(short_indices), options);
            other.source.index_bytes = 2;
            other.source.normal = offsetof(Vertex, normal);
            other.decide();
            const auto same = other.points();
            REQUIRE(same.size() == shaded.size());
            CHECK(std::memcmp(same.data(), shaded.data(), same.size() * sizeof same[0]) == 0);
        }
    }

    TEST_CASE("what is in order so far is placed after every finish") {
        const TestMesh mesh = builtin("icosphere", 3);
        const PreparedMesh surface = prepared(mesh);
        DrawnScene scene(expect(Domain::surface(surface, params_for(surface, 200))),
                         placed_vertices(mesh), bytes_of(mesh.triangles));
        scene.run.begin();
        std::size_t before = 0;
        for (bool is_left = true; is_left;) {
            is_left = decide_batch(scene.run);
            scene.run.finish();
            const auto points = scene.points();
            CHECK(points.size() >= before);
            before = points.size();
            check_points(points, scene.run, mesh, placed_vertices(mesh), false);
        }
        CHECK(before > 100);
    }

    TEST_CASE("radii that vary are those at the samples") {
        const TestMesh mesh = builtin("torus-knot", 8);
        const PreparedMesh surface = prepared(mesh);
        const RadiusField radii = radius_field(surface, wavy_factors(mesh, 0.2));
        const SampleParams params = params_for(surface, 300, 1, &radii);
        DrawnScene scene(expect(Domain::surface(surface, params)), placed_vertices(mesh),
                         bytes_of(mesh.triangles));
        scene.decide();
        const auto points = scene.points();
        check_points(points, scene.run, mesh, placed_vertices(mesh), false);
        for (const gpu::PlacedRec& point : points) {
            const float* const g = &radii.factors()[std::size_t{3} * point.face];
            const double factor = (1.0 - point.weight1 - point.weight2) * g[0] +
                                  point.weight1 * double{g[1]} + point.weight2 * double{g[2]};
            CHECK(point.radius == doctest::Approx(factor * params.min_distance / 2).epsilon(1e-6));
        }
    }

    TEST_CASE("of several surfaces, each sample tells which it is on") {
        const TestMesh mesh = builtin("icosphere", 2);
        const PreparedMesh surface = prepared(mesh);
        const SurfacePart parts[] = {{&surface, params_for(surface, 60, 1)},
                                     {&surface, params_for(surface, 30, 2), 2}};
        // An instance names the same vertices again.
        std::vector<std::uint32_t> indices = mesh.triangles;
        indices.insert(indices.end(), mesh.triangles.begin(), mesh.triangles.end());
        DrawnScene scene(expect(Domain::surfaces(parts)), placed_vertices(mesh), bytes_of(indices));
        scene.decide();
        for (const SurfacePart& part : parts) {
            const auto index = static_cast<std::uint32_t>(&part - parts);
            SampleParams params = part.params;
            params.min_distance /= part.scale;
            Points points;
            for (const gpu::PlacedRec& point : scene.points()) {
                if (point.part == index) {
                    points.push_back({point.face, point.weight1, point.weight2});
                    CHECK(point.radius == static_cast<float>(params.min_distance / 2));
                    CHECK(std::hypot(point.x, point.y, point.z) == doctest::Approx(1).epsilon(0.1));
                }
            }
            CHECK(points == float_set(surface, params, scene.run.plan().error_bound));
        }
    }

    TEST_CASE("buffers that cannot be are refused") {
        const TestMesh mesh = builtin("icosphere", 1);
        const PreparedMesh surface = prepared(mesh);
        const SampleParams params = params_for(surface, 30);
        DrawnScene scene(expect(Domain::surface(surface, params)), placed_vertices(mesh),
                         bytes_of(mesh.triangles));
        const auto source = scene.source;
        const auto target = scene.target;
        scene.source.vertices.buffer = VK_NULL_HANDLE;
        CHECK(scene.refusal() == "the buffer range vertices is null");
        scene.source = source;
        scene.source.vertices.size -= sizeof(Vertex);
        CHECK(scene.refusal() == "the buffer range vertices has 1476 bytes and needs 1492");
        scene.source = source;
        scene.source.indices.size -= 4;
        CHECK(scene.refusal() == "the buffer range indices has 956 bytes and needs 960");
        scene.source = source;
        scene.source.stride = 10;
        CHECK(scene.refusal().find("a stride is at least 12 bytes") == 0);
        scene.source = source;
        scene.source.index_bytes = 3;
        CHECK(scene.refusal() == "an index has 2 bytes or 4, not 3");
        scene.source = source;
        scene.target.placed = scene.source.vertices;
        CHECK_FALSE(scene.place());
        scene.target = target;
        scene.target.arguments = scene.target.placed;
        CHECK(scene.refusal().find("overlaps the range") != std::string::npos);
        scene.target = target;
        scene.target.placed.size -= 1;
        CHECK_FALSE(scene.place());
        scene.target = target;
        CHECK(scene.place());
        const PreparedMesh other = prepared(builtin("icosphere", 2));
        const Domain foreign = expect(Domain::surface(other, params_for(other, 30)));
        CHECK_FALSE(
            Placement::create(scene.run.sampler(), foreign, scene.run.job(), source, target));
        const Placement of_before = expect(scene.place());
        expect(scene.run.job().renew(scene.domain, scene.run.plan()));
        scene.run.submit([&](VkCommandBuffer commands) {
            const auto recorded = of_before.record(commands, scene.run.job());
            REQUIRE_FALSE(recorded);
            CHECK(recorded.error().message ==
                  "the job is another, or was renewed: make a new placement");
        });
        const Placement stale = expect(scene.place());
        scene.run.begin();
        scene.run.enlarge_samples(scene.run.plan().sample_capacity * 2);
        scene.run.submit([&](VkCommandBuffer commands) {
            const auto recorded = stale.record(commands, scene.run.job());
            REQUIRE_FALSE(recorded);
            CHECK(recorded.error().message ==
                  "the job's buffer samples is another by now: make a new placement");
        });
    }
}

} // namespace geodisk::test
