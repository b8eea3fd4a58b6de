// Tells how many sources per second CGAL's exact distances take on a mesh.
//
// usage: geodisk_time_oracle MESH SECONDS VERTEX...
//
// Prints a line for each vertex, until the time is up: its number and the distances of all
// vertices. The last line is the rate. The test data that it is linked with reports through
// doctest.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <vector>

#include "files/meshes/mesh_file.hpp"
#include "support/meshes.hpp"
#include "support/oracle_geodesic.hpp"

namespace {

using namespace geodisk::test;

/// Each vertex as a point of a face.
std::vector<Point> vertices_of(const TestMesh& mesh) {
    std::vector<Point> points(mesh.vertex_count());
    for (std::uint32_t corner = 0; corner < mesh.triangles.size(); ++corner) {
        const std::uint32_t k = corner % 3;
        points[mesh.triangles[corner]] = {corner / 3, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
    }
    return points;
}

void run(const char* path, double max_seconds, char** begin, char** end) {
    const geodisk::tools::MeshFile file = geodisk::tools::read_mesh(path);
    const TestMesh mesh{file.positions, file.triangles};
    const std::vector<Point> points = vertices_of(mesh);
    GeodesicOracle oracle(mesh);
    double seconds = 0;
    int count = 0;
    for (; begin != end && seconds < max_seconds; ++begin, ++count) {
        const auto source = static_cast<std::size_t>(std::atoll(*begin));
        const auto start = std::chrono::steady_clock::now();
        const std::vector<double> distances = oracle.distances(points.at(source), points);
        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        std::printf("%zu", source);
        for (const double distance : distances) {
            std::printf(" %.17g", distance);
        }
        std::printf("\n");
    }
    std::printf("%.17g\n", count / seconds);
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 4) {
        std::fprintf(stderr, "usage: geodisk_time_oracle MESH SECONDS VERTEX...\n");
        return 2;
    }
    try {
        run(argv[1], std::atof(argv[2]), argv + 3, argv + argc);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "geodisk_time_oracle: %s\n", error.what());
        return 1;
    }
    return 0;
}
