// Views that PreparedMesh takes as they are: float or double, packed or with strides, indices of 16
// or 32 bits; and layouts that it refuses.
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "support/meshes.hpp"
#include "support/same_mesh.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

/// As engines hold them.
struct EngineVertex {
    float normal[3];
    float position[3];
    float uv[2];
};
struct ExactVertex {
    float normal[2];
    double position[3];
};
struct ObjIndex {
    std::uint32_t position, normal, uv;
};
struct ShortIndex {
    std::uint16_t uv, position;
};

/// A mesh whose coordinates are floats.
TestMesh rounded(TestMesh mesh) {
    for (double& x : mesh.positions) {
        x = static_cast<float>(x);
    }
    return mesh;
}

std::vector<float> floats_of(const TestMesh& mesh) {
    return {mesh.positions.begin(), mesh.positions.end()};
}

Error rejection(const MeshView& view) {
    const auto result = PreparedMesh::prepare(view);
    REQUIRE(!result);
    CHECK(result.error().message.find('\n') == std::string::npos);
    return result.error();
}

} // namespace

TEST_CASE("views: any layout gives the same mesh to the bit") {
    for (const TestMesh& mesh :
         {rounded(builtin("torus-knot", 6)), rounded(flat_grid(4, 3, 1, 1))}) {
        const PreparedMesh expected = prepared(mesh);
        const auto check = [&](const PositionView& positions, const IndexView& triangles) {
            const auto found = PreparedMesh::prepare({positions, triangles, mesh.dimension});
            REQUIRE(found);
            REQUIRE(same_mesh(*found, expected));
        };
        const std::vector<float> floats = floats_of(mesh);
        const std::vector<std::uint16_t> shorts(mesh.triangles.begin(), mesh.triangles.end());
        check(floats, mesh.triangles);
        check(mesh.positions, shorts);
        check(std::span(floats), std::span(shorts));

        std::vector<EngineVertex> engine(mesh.vertex_count());
        std::vector<ExactVertex> exact(mesh.vertex_count());
        for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            // Values between the positions are not looked at.
            constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
            engine[v] = {{kNan, kNan, kNan}, {}, {kNan, kNan}};
            exact[v] = {{kNan, kNan}, {}};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                engine[v].position[axis] = floats[std::size_t{3} * v + axis];
                exact[v].position[axis] = mesh.positions[std::size_t{3} * v + axis];
            }
        }
        std::vector<ObjIndex> obj;
        std::vector<ShortIndex> narrow;
        for (const std::uint32_t v : mesh.triangles) {
            obj.push_back({v, 0xffffffffu, 7});
            narrow.push_back({0xffff, static_cast<std::uint16_t>(v)});
        }
        const IndexView obj_indices(&obj[0].position, obj.size(), sizeof(ObjIndex));
        const IndexView short_indices(&narrow[0].position, narrow.size(), sizeof(ShortIndex));
        check({engine[0].position, engine.size(), sizeof(EngineVertex)}, obj_indices);
        check({exact[0].position, exact.size(), sizeof(ExactVertex)}, short_indices);
    }
}

TEST_CASE("views: floats in R^5, and lengths with indices of 16 bits") {
    TestMesh mesh{{}, flat_grid(3, 3, 1, 1).triangles, 5};
    for (std::uint32_t i = 0; i < 16 * 5; ++i) {
        mesh.positions.push_back(static_cast<float>(0.37 * ((i * i * 31) % 101)));
    }
    const std::vector<float> floats = floats_of(mesh);
    const auto found = PreparedMesh::prepare({floats, mesh.triangles, 5});
    REQUIRE(found);
    CHECK(same_mesh(*found, prepared(mesh)));

    const std::vector<double> lengths{3, 4, 5, 5, 4, 3};
    const std::vector<std::uint32_t> wide{0, 1, 2, 0, 2, 3};
    const std::vector<std::uint16_t> narrow{0, 1, 2, 0, 2, 3};
    const auto from_narrow = PreparedMesh::prepare({narrow, lengths, 4});
    const auto from_wide = PreparedMesh::prepare({wide, lengths, 4});
    REQUIRE(from_narrow);
    REQUIRE(from_wide);
    CHECK(same_mesh(*from_narrow, *from_wide));
}

TEST_CASE("views: elements at fault are named, whatever the layout") {
    const std::vector<float> nan{0, 0, 0, 1, 0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0};
    const std::vector<std::uint16_t> face{0, 1, 2};
    const Error error = rejection({nan, face});
    CHECK(error.status == Status::mesh_rejected);
    CHECK(error.message == "vertex 2 is not finite");
    CHECK(error.element == 2);
    const std::vector<std::uint16_t> beyond{0, 1, 2, 0, 1, 3};
    const Error index = rejection({std::vector<float>(9, 0.f), beyond});
    CHECK(index.message == "face 1 names vertex 3, but there are only 3");
    CHECK(index.element == 1);
}

TEST_CASE("views: layouts that cannot be read are refused") {
    const float floats[12] = {0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const double doubles[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::uint32_t wide[3] = {0, 1, 2};
    const std::uint16_t narrow[4] = {0, 1, 2};
    REQUIRE(PreparedMesh::prepare({{floats, 3, 16}, wide}));
    const auto off = [](const auto* pointer, std::size_t bytes) {
        // NOLINTNEXTLINE(performance-no-int-to-ptr): an address alone, never read.
        return reinterpret_cast<decltype(pointer)>(reinterpret_cast<std::uintptr_t>(pointer) +
                                                   bytes);
    };
    const float* const no_floats = nullptr;
    const std::uint16_t* const no_indices = nullptr;
    const std::pair<MeshView, const char*> cases[] = {
        {{{no_floats, 3, 12}, wide}, "there are 3 positions, but no data"},
        {{doubles, {no_indices, 3, 2}}, "there are 3 indices, but no data"},
        {{{floats, 3, 8}, wide}, "the stride of positions is 8 bytes, less than the 12 of one"},
        {{{floats, 3, 0}, wide}, "the stride of positions is 0 bytes, less than the 12 of one"},
        {{{doubles, 3, 16}, wide}, "the stride of positions is 16 bytes, less than the 24 of one"},
        {{{floats, 3, 14}, wide}, "positions must lie at multiples of 4 bytes"},
        {{{off(floats, 2), 3, 16}, wide}, "positions must lie at multiples of 4 bytes"},
        {{{off(doubles, 4), 3, 24}, wide}, "positions must lie at multiples of 8 bytes"},
        {{{doubles, 3, 28}, wide}, "positions must lie at multiples of 8 bytes"},
        {{doubles, {wide, 3, 0}}, "the stride of indices is 0 bytes, less than the 4 of one"},
        {{doubles, {wide, 3, 6}}, "indices must lie at multiples of 4 bytes"},
        {{doubles, {off(wide, 1), 3, 4}}, "indices must lie at multiples of 4 bytes"},
        {{doubles, {narrow, 3, 3}}, "indices must lie at multiples of 2 bytes"},
        {{doubles, {narrow, 4, 2}},
         "positions must hold whole vertices and triangles whole faces"}};
    for (const auto& [view, message] : cases) {
        const Error error = rejection(view);
        CHECK(error.status == Status::invalid_argument);
        CHECK(error.message == message);
    }
    // No elements need no data.
    CHECK(rejection({{no_floats, 0, 12}, wide}).message ==
          "face 0 names vertex 0, but there are only 0");
    CHECK(rejection({doubles, {no_indices, 0, 2}}).message == "the mesh has no faces");
}
