#include "geometry/weld_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <geodisk/weld.hpp>

#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

/// Returns the diagonal of the bounding box of all vertices in faces.
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

/// Makes `mesh` the welded one.
void take_welded(WeldedMesh welded, MeshFile& mesh) {
    if (welded.merged_vertices == 0) {
        return;
    }
    mesh.file_triangles = std::exchange(mesh.triangles, std::move(welded.triangles));
    mesh.joined = std::move(welded.vertices);
}

} // namespace

void weld_mesh(const std::string& path, MeshFile& mesh, const Length& distance) {
    const double epsilon =
        distance.is_percent ? distance.in_mesh_units(diagonal_of(mesh)) : distance.value;
    WeldedMesh welded = take(weld({mesh.positions, mesh.triangles, mesh.dimension}, epsilon), path);
    const WeldCounts before = mesh.weld.value_or(WeldCounts{});
    mesh.weld = {before.merged_vertices + welded.merged_vertices,
                 before.degenerate_faces + welded.degenerate_faces, 0};
    take_welded(std::move(welded), mesh);
}

void join_mesh_seams(const std::string& path, MeshFile& mesh) {
    WeldedMesh welded = take(join_seams({mesh.positions, mesh.triangles, mesh.dimension}), path);
    if (welded.joined_edges > 0) {
        mesh.weld = {welded.merged_vertices, welded.degenerate_faces, welded.joined_edges};
        add_warning(mesh.warnings, "zero_area_faces", welded.degenerate_faces, "",
                    "triangle without area dropped: its sides are joined",
                    "triangles without area dropped: their sides are joined");
        take_welded(std::move(welded), mesh);
    }
}

std::vector<double> values_at_vertices(const MeshFile& mesh, std::vector<double> values) {
    if (!mesh.joined.empty()) {
        values = take(means_of_joined(std::span(mesh.joined).first(values.size()), values));
    }
    for (const std::uint32_t vertex : mesh.copied) {
        values.push_back(values[vertex]);
    }
    return values;
}

} // namespace geodisk::tools
