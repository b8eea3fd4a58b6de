// Maximal sets without a device: the cells of faces, and the sequential twin.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "coverage.hpp"
#include "engine/maximal/gap_cell.hpp"
#include "lib/frame.hpp"
#include "maximal.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {
namespace {

double area_of(const std::array<FaceWeights, 3>& c) {
    return std::abs((c[1].second - c[0].second) * (c[2].third - c[0].third) -
                    (c[2].second - c[0].second) * (c[1].third - c[0].third)) /
           2;
}

bool holds(const std::array<FaceWeights, 3>& cell, FaceWeights point) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        sum += area_of({cell[k], cell[(k + 1) % 3], point});
    }
    return sum <= area_of(cell) * (1 + 1e-12);
}

ref::MaximalSet double_set(const PreparedMesh& mesh, const SampleParams& params) {
    const double bound = ref::frame_of(mesh, params).first_error();
    return ref::maximal_set<double>(mesh, params, bound);
}

} // namespace

TEST_SUITE("maximal") {
    TEST_CASE("a cell splits into four that tile it") {
        std::vector<GapCell> cells{{0, 0, 0, 0, false}};
        for (int depth = 0; depth < 4; ++depth) {
            std::vector<GapCell> next;
            for (const GapCell& cell : cells) {
                double area = 0;
                for (const GapCell& part : cell.children()) {
                    area += area_of(part.corners());
                    CHECK(holds(cell.corners(), part.centroid()));
                    CHECK(holds(part.corners(), part.centroid()));
                    for (const FaceWeights corner : part.corners()) {
                        CHECK(holds(cell.corners(), corner));
                    }
                    next.push_back(part);
                }
                CHECK(area == doctest::Approx(area_of(cell.corners())));
            }
            cells = next;
        }
        CHECK(cells.size() == 256);
    }

    TEST_CASE("the twin leaves no gap, and keeps the distance of the pool") {
        const PreparedMesh knot = prepared(builtin("torus-knot", 6));
        SampleParams params;
        params.min_distance = distance_for_count(knot.statistics().area, 60);
        const ref::MaximalSet set = double_set(knot, params);
        CHECK(set.is_complete);
        CHECK(set.rounds > 0);
        const ref::Tolerances tolerances = ref::frame_of(knot, params).tolerances();
        ref::Surface<double> surface(knot, params.min_distance);
        ref::CoverageCheck check(surface, {}, 1 + 2 * tolerances.guard);
        for (const auto& sample : set.samples) {
            check.add_sample(sample, 0.5);
        }
        check.sort();
        for (std::uint32_t face = 0; face < knot.face_count(); ++face) {
            check.test(face);
        }
        CHECK_FALSE(check.result().uncovered.has_value());
        // Without the last sample there is a gap where it was.
        ref::CoverageCheck without(surface, {}, 1 + 2 * tolerances.guard);
        for (std::size_t i = 0; i + 1 < set.samples.size(); ++i) {
            without.add_sample(set.samples[i], 0.5);
        }
        without.sort();
        without.test(set.samples.back().face);
        CHECK(without.result().uncovered.has_value());
    }

    TEST_CASE("four samples saturate a sphere at a quarter of its girth, in double precision") {
        const PreparedMesh sphere = prepared(builtin("icosphere", 3));
        SampleParams params;
        params.min_distance = 1.5707 * std::sqrt(sphere.statistics().area / 12.566370614359172);
        for (params.seed = 1; params.seed <= 4; ++params.seed) {
            CHECK(double_set(sphere, params).samples.size() == 4);
        }
    }
}

} // namespace geodisk::test
