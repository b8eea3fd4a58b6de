#include "geometry/weld_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <geodisk/weld.hpp>

#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

/// Of the bounding box of all vertices in faces.
double diagonal_of(const MeshFile& mesh) {
    double diagonal = 0;
    for (std::size_t axis = 0; axis < mesh.dimension; ++axis) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (const std::uint32_t v : mesh.triangles) {
            const double x = mesh.positions[std::size_t{v} * mesh.dimension + axis];
            low = std::min(low, x);
            high = std::max(high, x);
        }
        diagonal = std::hypot(diagonal, high - low);
    }
    return diagonal;
}

} // namespace

void weld_mesh(const std::string& path, MeshFile& mesh, const Length& distance) {
    const double epsilon =
        distance.is_percent ? distance.in_mesh_units(diagonal_of(mesh)) : distance.value;
    WeldedMesh welded = take(weld({mesh.positions, mesh.triangles, mesh.dimension}, epsilon), path);
    mesh.triangles = std::move(welded.triangles);
    mesh.weld = {welded.merged_vertices, welded.degenerate_faces};
    for (VertexUv& uv : mesh.uvs) {
        uv.vertex = welded.vertices[uv.vertex];
    }
    std::sort(mesh.uvs.begin(), mesh.uvs.end());
    mesh.uvs.erase(std::unique(mesh.uvs.begin(), mesh.uvs.end()), mesh.uvs.end());
}

} // namespace geodisk::tools
