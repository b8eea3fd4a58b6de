// Triangles that are split: what they cover, and samples on them and on the faces before.
#include "geometry/bisected_mesh.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include "geometry/mesh.hpp"

using namespace geodisk::tools;
using geodisk::Sample;

namespace {

/// Four triangles, of which three share an edge, and one that repeats a vertex.
MeshFile book() {
    MeshFile mesh;
    mesh.positions = {0, 0, 0, 1, 0, 0, 0.3, 1, 0, 0.4, -0.7, 0, 0.5, 0, 2, 3, 0.1, 0};
    mesh.triangles = {0, 1, 2, 1, 0, 3, 0, 1, 4, 1, 5, 2, 2, 2, 0};
    return mesh;
}

double area2(const std::array<std::array<std::uint16_t, 2>, 3>& at) {
    const auto side = [&](std::size_t k, std::size_t i) {
        return static_cast<double>(at[k][i]) - static_cast<double>(at[0][i]);
    };
    return side(1, 0) * side(2, 1) - side(1, 1) * side(2, 0);
}

/// Splits around a corner of the first face, again and again.
BisectedMesh split_at_corner(const MeshFile& mesh, int passes) {
    BisectedMesh split(mesh);
    for (int pass = 0; pass < passes; ++pass) {
        std::vector<bool> wanted(split.triangle_count(), false);
        wanted[0] = true;
        if (!split.split(wanted, 100000)) {
            break;
        }
    }
    return split;
}

} // namespace

TEST_CASE("parts of split faces cover them, and share whole edges") {
    const MeshFile mesh = book();
    const BisectedMesh split = split_at_corner(mesh, 12);
    REQUIRE(split.is_split());
    CHECK(split.triangle_count() > 20);
    std::vector<double> areas(mesh.triangle_count(), 0);
    std::map<std::array<std::uint32_t, 2>, int> edges;
    for (std::size_t t = 0; t < split.triangle_count(); ++t) {
        const FacePart& part = split.parts()[t];
        CHECK((t == 0 || split.parts()[t - 1].face <= part.face));
        CHECK(area2(part.corners) > 0);
        areas[part.face] += area2(part.corners);
        const double w1 = part.corners[1][0] / 256.0, w2 = part.corners[1][1] / 256.0;
        for (std::size_t k = 0; k < 3 && part.face != 4; ++k) {
            const std::uint32_t a = split.triangles()[3 * t + k],
                                b = split.triangles()[3 * t + (k + 1) % 3];
            ++edges[{std::min(a, b), std::max(a, b)}];
            const auto position = [&](std::uint32_t corner) {
                return mesh.positions[3 * mesh.triangles[3 * part.face + corner]];
            };
            if (k == 1) {
                CHECK(split.positions()[std::size_t{3} * a] ==
                      doctest::Approx((1 - w1 - w2) * position(0) + w1 * position(1) +
                                      w2 * position(2)));
            }
        }
    }
    CHECK(std::ranges::all_of(areas, [](double area) { return area == 256.0 * 256.0; }));
    // An edge between parts of a face, or between faces, has two parts or three on it.
    std::map<int, int> counts;
    for (const auto& [edge, count] : edges) {
        ++counts[count];
    }
    CHECK(counts.rbegin()->first == 3);
    CHECK(std::ranges::is_sorted(split.parts(), {}, &FacePart::face));
    const std::vector<double> x = split.extended(std::vector<double>{0, 1, 0.3, 0.4, 0.5, 3});
    REQUIRE(x.size() == split.vertex_count());
    for (std::size_t v = 0; v < x.size(); ++v) {
        CHECK(x[v] == split.positions()[3 * v]);
    }
}

TEST_CASE("faces are split down to steps of weights, and no further than there is room") {
    const MeshFile mesh = book();
    BisectedMesh split = split_at_corner(mesh, 1000);
    CHECK(split.triangle_count() < 1000);
    std::vector<bool> all(split.triangle_count(), true);
    CHECK_FALSE(split.split(all, split.triangle_count()));
    const auto before = split.split(all, 100000);
    REQUIRE(before);
    CHECK(before->size() == split.triangle_count());
    CHECK_FALSE(split.split(std::vector<bool>(split.triangle_count(), false), 100000));
}

TEST_CASE("samples go from parts to faces and back") {
    const BisectedMesh split = split_at_corner(book(), 30);
    std::mt19937_64 random(7);
    const auto draw = [&](std::uint32_t count) {
        return static_cast<std::int64_t>(random() % count);
    };
    const auto weight = [](std::int64_t steps) {
        return static_cast<float>(static_cast<double>(steps) * 0x1p-24);
    };
    const auto sample_of = [&](std::uint32_t face, std::int64_t second, std::int64_t third) {
        return Sample{face, {weight(16777216 - second - third), weight(second), weight(third)}};
    };
    std::size_t wrong = 0, far = 0, outside = 0;
    for (int i = 0; i < 20000; ++i) {
        std::int64_t second = draw(16777217), third = draw(16777217);
        if (second + third > 16777216) {
            second = 16777216 - second;
            third = 16777216 - third;
        }
        const Sample on_face = sample_of(static_cast<std::uint32_t>(draw(4)), second, third);
        const Sample there = split.whole(split.part(on_face));
        wrong += there.face != on_face.face || there.weights[0] != on_face.weights[0] ||
                 there.weights[1] != on_face.weights[1] || there.weights[2] != on_face.weights[2];
        const auto part =
            static_cast<std::uint32_t>(draw(static_cast<std::uint32_t>(split.triangle_count())));
        const Sample on_part = sample_of(part, second, third);
        const Sample moved = split.whole(on_part);
        const auto& at = split.parts()[part].corners;
        for (std::size_t axis = 0; axis < 2; ++axis) {
            double exact = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                exact += static_cast<double>(on_part.weights[k]) * at[k][axis] / 256;
            }
            far += std::abs(exact - static_cast<double>(moved.weights[axis + 1])) > 0x1p-23;
        }
        const Sample back = split.part(moved);
        // On an edge it may be of a lower part.
        outside += back.face > part;
    }
    CHECK(wrong == 0);
    CHECK(far == 0);
    CHECK(outside == 0);
}
