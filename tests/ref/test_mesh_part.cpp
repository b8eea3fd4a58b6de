// PreparedMesh::part and RadiusField::on_part: some faces as they are in the whole, to the bit.
#include <algorithm>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "support/meshes.hpp"
#include "support/radius_fields.hpp"
#include "support/same_mesh.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

/// Every face but each fourth, which leaves borders and vertices of some faces only.
std::vector<std::uint32_t> some_faces(std::uint32_t count) {
    std::vector<std::uint32_t> faces;
    for (std::uint32_t f = 0; f < count; ++f) {
        if (f % 4 != 1) {
            faces.push_back(f);
        }
    }
    return faces;
}

/// A mesh of these faces, whose vertices keep their order.
TestMesh cut_out(const TestMesh& whole, const std::vector<std::uint32_t>& faces) {
    std::vector<bool> is_used(whole.vertex_count());
    for (const std::uint32_t f : faces) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            is_used[whole.triangles[std::size_t{3} * f + k]] = true;
        }
    }
    TestMesh cut;
    cut.dimension = whole.dimension;
    std::vector<std::uint32_t> numbers(whole.vertex_count());
    std::uint32_t next = 0;
    for (std::uint32_t v = 0; v < whole.vertex_count(); ++v) {
        if (is_used[v]) {
            numbers[v] = next++;
            const auto first =
                whole.positions.begin() + static_cast<std::ptrdiff_t>(v * whole.dimension);
            cut.positions.insert(cut.positions.end(), first, first + whole.dimension);
        }
    }
    for (const std::uint32_t f : faces) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            cut.triangles.push_back(numbers[whole.triangles[std::size_t{3} * f + k]]);
        }
    }
    return cut;
}

PreparedMesh part_of(const PreparedMesh& mesh, const std::vector<std::uint32_t>& faces) {
    auto part = mesh.part(faces);
    REQUIRE_MESSAGE(part, part.error().message);
    return std::move(*part);
}

std::string refusal(const PreparedMesh& mesh, const std::vector<std::uint32_t>& faces) {
    const auto part = mesh.part(faces);
    REQUIRE_FALSE(part);
    CHECK(part.error().status == Status::invalid_argument);
    return part.error().message;
}

} // namespace

TEST_CASE("mesh part: all faces are the mesh, some are the mesh of these faces") {
    for (const TestMesh& shape :
         {builtin("torus-knot", 6), builtin("moebius", 20), tetrahedra(2, 0.1), needle_disk(50)}) {
        const PreparedMesh whole = prepared(shape);
        std::vector<std::uint32_t> all(shape.face_count());
        std::iota(all.begin(), all.end(), 0u);
        const PreparedMesh same = part_of(whole, all);
        CHECK(std::ranges::equal(same.corners(), whole.corners()));
        CHECK(same_mesh(part_of(same, all), same));
        const std::vector<std::uint32_t> faces = some_faces(shape.face_count());
        const PreparedMesh part = part_of(whole, faces);
        CHECK(part.statistics().diagonal == whole.statistics().diagonal);
        CHECK(same_surface(part, prepared(cut_out(shape, faces))));
        const auto saved = part.save();
        REQUIRE(saved);
        const auto loaded = PreparedMesh::load(*saved);
        REQUIRE_MESSAGE(loaded, loaded.error().message);
        CHECK(same_mesh(*loaded, part));
    }
}

TEST_CASE("mesh part: radii are those of the whole") {
    const TestMesh shape = builtin("torus-knot", 6);
    const PreparedMesh whole = prepared(shape);
    const std::vector<std::uint32_t> faces = some_faces(shape.face_count());
    const PreparedMesh part = part_of(whole, faces);
    for (const RadiusField& field : {radius_field(whole, wavy_factors(shape, 0.3)),
                                     density_field(whole, rough_density(shape))}) {
        const RadiusField some = field.on_part(part, faces);
        CHECK(some.largest_density() == field.largest_density());
        CHECK(some.packing().empty() == field.packing().empty());
        CHECK(some.effective_area() < field.effective_area());
        std::size_t wrong = 0;
        for (std::size_t h = 0; h < some.factors().size(); ++h) {
            const std::size_t there = 3 * std::size_t{faces[h / 3]} + h % 3;
            wrong += some.factors()[h] != field.factors()[there] ||
                     some.spreads()[h] != field.spreads()[there] ||
                     some.share_at(h) != field.share_at(there) ||
                     some.densities()[h / 3] != field.densities()[faces[h / 3]];
        }
        CHECK(wrong == 0);
        std::vector<std::uint32_t> all(shape.face_count());
        std::iota(all.begin(), all.end(), 0u);
        CHECK(field.on_part(whole, all).effective_area() ==
              doctest::Approx(field.effective_area()));
    }
}

TEST_CASE("mesh part: radii are the same after they were saved") {
    const TestMesh shape = builtin("torus-knot", 6);
    const PreparedMesh mesh = prepared(shape);
    for (const RadiusField& field : {radius_field(mesh, wavy_factors(shape, 0.3)),
                                     density_field(mesh, rough_density(shape))}) {
        auto bytes = field.save();
        REQUIRE(bytes);
        const auto loaded = RadiusField::load(*bytes);
        REQUIRE_MESSAGE(loaded, loaded.error().message);
        CHECK(std::ranges::equal(loaded->factors(), field.factors()));
        CHECK(std::ranges::equal(loaded->spreads(), field.spreads()));
        CHECK(std::ranges::equal(loaded->packing(), field.packing()));
        CHECK(std::ranges::equal(loaded->densities(), field.densities()));
        CHECK(loaded->largest_density() == field.largest_density());
        CHECK(loaded->effective_area() == field.effective_area());
        for (const std::size_t size : {std::size_t{0}, std::size_t{7}, bytes->size() - 4}) {
            CHECK_FALSE(RadiusField::load(std::span(*bytes).first(size)));
        }
        const auto is_refused_with = [&](std::size_t at, float value) {
            std::vector<std::byte> changed = *bytes;
            std::memcpy(changed.data() + 48 + at * sizeof value, &value, sizeof value);
            return !RadiusField::load(changed);
        };
        const std::size_t faces = mesh.face_count();
        CHECK_FALSE(is_refused_with(0, field.factors()[0]));
        CHECK(is_refused_with(0, -1)); // The first factor.
        if (field.packing().empty()) {
            CHECK(is_refused_with(3 * faces, 0)); // A spread without proposals.
        } else {
            CHECK(is_refused_with(6 * faces, 0.5f)); // A radius larger than the largest.
            CHECK(is_refused_with(6 * faces, 1000)); // A packing of other radii.
        }
        // Far more candidates than the area tells.
        CHECK(is_refused_with(bytes->size() / 4 - 48 / 4 - 1, field.largest_density() * 1000));
    }
}

TEST_CASE("mesh part: faces that are no part are refused") {
    const PreparedMesh cube = prepared(builtin("cube", 1));
    CHECK(refusal(cube, {}) == "a part of a mesh has at least one face");
    CHECK(refusal(cube, {0, 12}) == "face 12 of the part does not exist; the mesh has 12");
    CHECK(refusal(cube, {0, 2, 1}) == "the faces of a part must ascend, but 1 follows 2");
    CHECK(refusal(cube, {3, 3}) == "the faces of a part must ascend, but 3 follows 3");
}
