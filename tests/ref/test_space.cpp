// Surfaces with distances through space: the reference's sets against brute force over double
// coordinates.
#include <vector>

#include <doctest/doctest.h>

#include "baselines/pool_darts.hpp"
#include "kernels/pool.hpp"
#include "kernels/space.hpp"
#include "ref/dart_check.hpp"

using namespace geodisk;
using namespace geodisk::test;

TEST_CASE("space: sets of straight distances are those of brute force") {
    for (const TestMesh& mesh : {builtin("icosphere", 3), builtin("plate", 4),
                                 flat_grid(3, 2, 1, 1), builtin("folded-sheet", 8)}) {
        const PreparedMesh surface = prepared(mesh);
        for (const double count : {1.0, 200.0}) {
            const SampleParams params = params_for(surface, count, 5);
            const ref::SpacePoints points = ref::draw_in_space(mesh.view(), surface, params);
            std::vector<Vec3> positions;
            for (const Point& p :
                 ref::draw_pool(ref::Surface<double>(surface, params), params).by_rank()) {
                positions.push_back(mesh.position(p));
            }
            const double limit = params.min_distance * (1 + points.guard);
            const auto brute =
                ref::throw_brute_force(static_cast<std::uint32_t>(positions.size()),
                                       [&](std::uint32_t a, std::uint32_t b) {
                                           return glm::length(positions[a] - positions[b]) < limit;
                                       });
            CHECK(ref::throw_darts(ref::space_pool<double>(points, false)) == brute);
            CHECK(ref::throw_darts(ref::space_pool<float>(points, false)) == brute);
            // Curves are no shorter, so they leave room for as many at least.
            CHECK(ref::throw_darts(ref::space_pool<double>(points, true)).size() >= brute.size());
        }
    }
}
