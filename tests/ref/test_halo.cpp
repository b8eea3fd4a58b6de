// HaloSearch: lower bounds on the distance from some faces, and the faces around them.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include <geodisk/geodesics.hpp>

#include "parts/halo.hpp"
#include "support/meshes.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

/// Returns the exact distance of each vertex from the nearest corner of some faces.
std::vector<double> from_corners(const PreparedMesh& mesh,
                                 const std::vector<std::uint32_t>& faces) {
    std::vector<Sample> corners;
    for (const std::uint32_t face : faces) {
        for (std::size_t k = 0; k < 3; ++k) {
            Sample corner{face, {0, 0, 0}};
            corner.weights[k] = 1;
            corners.push_back(corner);
        }
    }
    DistanceQuery query;
    query.sources = corners;
    auto found = geodesic_distances(mesh, query);
    REQUIRE_MESSAGE(found, found.error().message);
    return std::move(found->distances);
}

/// Returns some faces, each so many after the one before.
std::vector<std::uint32_t> some_faces(std::uint32_t count, std::uint32_t begin, std::uint32_t step,
                                      std::uint32_t size) {
    std::vector<std::uint32_t> faces;
    for (std::uint32_t i = 0; i < size && begin + i * step < count; ++i) {
        faces.push_back(begin + i * step);
    }
    return faces;
}

} // namespace

TEST_CASE("halo: no vertex is nearer than its bound, and no face within reach is missing") {
    for (const TestMesh& shape : {builtin("torus-knot", 6), builtin("terrain", 40),
                                  builtin("moebius", 20), needle_disk(50), tetrahedra(2, 0.1)}) {
        const PreparedMesh mesh = prepared(shape);
        HaloSearch halo(mesh); // Searched with again and again.
        const double length = mesh.statistics().longest_edge;
        for (const auto& from : {some_faces(mesh.face_count(), 0, 1, 60),
                                 some_faces(mesh.face_count(), mesh.face_count() / 2, 7, 3),
                                 some_faces(mesh.face_count(), 1, 1, 1)}) {
            const std::vector<double> exact = from_corners(mesh, from);
            for (const double reach : {0.5 * length, 4 * length}) {
                const std::vector<std::uint32_t> faces = halo.search(from, reach);
                CHECK(std::ranges::is_sorted(faces));
                CHECK(std::ranges::includes(faces, from));
                HaloSearch fresh(mesh);
                CHECK(fresh.search(from, reach) == faces);
                std::size_t wrong = 0, missing = 0;
                for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
                    wrong += halo.distance(v) > exact[v] + 1e-12 * length;
                    wrong += halo.distance(v) != fresh.distance(v);
                }
                for (std::uint32_t h = 0; h < 3 * mesh.face_count(); ++h) {
                    missing += exact[mesh.half_edges()[h].origin] <= reach &&
                               !std::ranges::binary_search(faces, h / 3);
                }
                CHECK(wrong == 0);
                CHECK(missing == 0);
            }
        }
    }
}
