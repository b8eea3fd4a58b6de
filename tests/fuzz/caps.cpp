// Small meshes with flat triangles of any height: distances of the reference, in double precision
// and in float, are those of unfolding alone, which is independent of it.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "fuzz/complex_input.hpp"
#include "kernels/windows.hpp"
#include "support/cap_distances.hpp"
#include "support/cap_meshes.hpp"

#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

using namespace geodisk;
using namespace geodisk::test;

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
        const double reach = (0.1 + choose(256) / 256.0) * surface->statistics().diagonal;
        for (const WrongDistance& wrong : wrong_distances(mesh, *surface, points, reach)) {
            std::fprintf(stderr, "%s\n", wrong.text().c_str());
            __builtin_trap();
        }
    } catch (const ref::EndlessDisk&) { // An error, not a wrong distance.
    }
    return 0;
}
