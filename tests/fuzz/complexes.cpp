// Small complexes of triangles: slivers, needles, triangles without area, bow-ties, one-sided ones,
// sources on vertices and edges. Distances of the reference must make a metric that no straight
// line undercuts, and those in float must keep to the guard.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "fuzz/complex_input.hpp"
#include "lib/frame.hpp"
#include "support/geodesic_query.hpp"

#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

using namespace geodisk;
using namespace geodisk::test;

namespace {

// Tolerance as a part of the reach. Slivers cost digits: with the tight tolerances of other tests,
// paths along them are lost.
constexpr double kExact = 1e-6;

std::vector<Point> points_of(Input& input, std::uint32_t faces) {
    std::vector<Point> points;
    for (int i = 0; i < 5; ++i) {
        const std::uint32_t face = input.next(faces);
        const double a = input.next(9) / 8.0, b = input.next(9) / 8.0;
        points.push_back(face_point(face, a + b > 1 ? 1 - a : a, a + b > 1 ? 1 - b : b));
    }
    return points;
}

bool takes_part(const TestMesh& mesh, const Point& point) {
    const std::uint32_t* const v = &mesh.triangles[std::size_t{3} * point.face];
    return v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
}

void require(bool holds, const char* what, double a, double b) {
    if (!holds) {
        std::fprintf(stderr, "%s: %.17g, %.17g\n", what, a, b);
        __builtin_trap();
    }
}

void check(const TestMesh& mesh, const PreparedMesh& surface, const std::vector<Point>& points) {
    const double reach = 3 * surface.statistics().diagonal;
    if (!(surface.statistics().longest_edge > 0) || !(reach < 1e6)) {
        return;
    }
    GeodesicQuery<double> exact(surface, reach, points, ref::frame_of(surface, reach).tolerances());
    GeodesicQuery<float> twin(surface, reach, points, ref::frame_of(surface, reach).tolerances());
    GeodesicQuery<float> trimming(surface, reach, points,
                                  ref::frame_of(surface, reach).tolerances());
    trimming.trim_all();
    const ref::Frame model = ref::frame_of(surface, reach);
    const double error = (kExact + model.guard_for(model.first_error())) * reach;
    std::vector<std::vector<double>> d;
    for (const Point& source : points) {
        d.push_back(exact.from(source));
        for (GeodesicQuery<float>* const query : {&twin, &trimming}) {
            const std::vector<double> t = query->from(source);
            const double chain_error = model.error_of(query->count().chain);
            const double guard =
                model.guard_for(std::max(model.first_error(), chain_error)) * reach;
            for (std::size_t i = 0; i < points.size(); ++i) {
                if (d.back()[i] < reach - error - guard || t[i] < reach - error - guard) {
                    require(std::abs(t[i] - d.back()[i]) <= guard + error,
                            query == &twin ? "float" : "trimmed", t[i], d.back()[i]);
                }
            }
        }
    }
    for (std::size_t a = 0; a < points.size(); ++a) {
        for (std::size_t b = 0; b < points.size(); ++b) {
            if (d[a][b] == kUnreachable) {
                require(d[b][a] == kUnreachable || d[b][a] > reach - error, "one way", d[a][b],
                        d[b][a]);
                continue;
            }
            const double line = glm::distance(mesh.position(points[a]), mesh.position(points[b]));
            require(d[a][b] >= line - error, "shorter than straight", d[a][b], line);
            require(std::abs(d[a][b] - d[b][a]) <= error, "not symmetric", d[a][b], d[b][a]);
            if (points[a].face == points[b].face) {
                require(d[a][b] <= line + error, "not straight in a face", d[a][b], line);
            }
            for (std::size_t c = 0; c < points.size(); ++c) {
                require(d[a][c] <= d[a][b] + d[b][c] + 2 * error ||
                            d[a][b] + d[b][c] > reach - error,
                        "triangle inequality", d[a][c], d[a][b] + d[b][c]);
            }
        }
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Input input({data, size});
    const TestMesh mesh = complex_of(input);
    const auto surface = PreparedMesh::prepare(mesh.view(), ThreadOptions{1});
    if (!surface) {
        return 0;
    }
    // A face at least, as one has an area.
    std::vector<Point> points = points_of(input, mesh.face_count());
    std::erase_if(points, [&](const Point& point) { return !takes_part(mesh, point); });
    try {
        check(mesh, *surface, points);
    } catch (const ref::EndlessDisk&) { // An error, not a wrong distance.
    }
    return 0;
}
