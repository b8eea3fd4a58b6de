// Small meshes with flat triangles of any height: distances of the reference, in double precision
// and in float, are those of unfolding alone, which is independent of it.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "fuzz/complex_input.hpp"
#include "lib/frame.hpp"
#include "support/cap_meshes.hpp"
#include "support/geodesic_query.hpp"
#include "support/unfolding.hpp"

#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

using namespace geodisk;
using namespace geodisk::test;

namespace {

void require(bool holds, const char* what, double a, double b) {
    if (!holds) {
        std::fprintf(stderr, "%s: %.17g, %.17g\n", what, a, b);
        __builtin_trap();
    }
}

void compare(const char* kind, const std::vector<double>& found, const std::vector<double>& truth,
             double reach, double error) {
    for (std::size_t i = 0; i < truth.size(); ++i) {
        require(truth[i] >= reach - error || found[i] <= truth[i] + error, kind, found[i],
                truth[i]);
        require(found[i] >= truth[i] - error, kind, found[i], truth[i]);
    }
}

void check(const TestMesh& mesh, const PreparedMesh& surface, const std::vector<Point>& points,
           double reach) {
    const Unfolding unfolding(mesh);
    const ref::Tolerances tolerances = ref::frame_of(surface, reach).tolerances();
    GeodesicQuery<double> exact(surface, reach, points, ref::double_tolerances());
    GeodesicQuery<float> twin(surface, reach, points, tolerances);
    GeodesicQuery<float> trimming(surface, reach, points, tolerances);
    trimming.trim_all();
    const double guard = tolerances.guard * reach;
    for (const Point& source : points) {
        const std::vector<double> truth = unfolding.distances(source, points, 1.01 * reach);
        compare("double", exact.from(source), truth, reach, 2e-7 * reach);
        compare("float", twin.from(source), truth, reach, guard);
        compare("trimmed", trimming.from(source), truth, reach, guard);
        if (const auto found = twin.by_group_from(source)) {
            compare("by a group", *found, truth, reach, guard);
        }
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Input input({data, size});
    const Choose choose = [&](std::uint32_t below) { return input.next(below); };
    const TestMesh mesh = cap_mesh(choose);
    const auto surface = PreparedMesh::prepare(mesh.view(), ThreadOptions{1});
    if (!surface) {
        return 0; // No face has area.
    }
    std::vector<Point> points;
    for (int i = 0; i < 5; ++i) {
        points.push_back(point_of(mesh, choose));
    }
    try {
        check(mesh, *surface, points, (0.1 + choose(256) / 256.0) * surface->statistics().diagonal);
    } catch (const ref::EndlessDisk&) { // An error, not a wrong distance.
    }
    return 0;
}
