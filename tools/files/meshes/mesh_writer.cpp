#include <span>
#include <string>

#include "files/byte_order.hpp"
#include "files/input_file.hpp"
#include "files/meshes/mesh_file.hpp"
#include "files/output/output_file.hpp"
#include "geometry/mesh.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

std::string header_of(const MeshFile& mesh, std::size_t vertices) {
    std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                         std::to_string(vertices) +
                         "\nproperty double x\nproperty double y\nproperty double z\n";
    for (std::uint32_t axis = 0; axis < mesh.dimension && mesh.dimension > 3; ++axis) {
        header += "property double x" + std::to_string(axis) + "\n";
    }
    return header + "element face " + std::to_string(mesh.triangles.size() / 3) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
}

} // namespace

void write_mesh(const Path& path, const MeshFile& mesh) {
    if (lower_extension(path) != ".ply" && !output_stream(path)) {
        fail_usage(path.string() + ": meshes are written as .ply only");
    }
    AtomicFile file(path);
    const std::size_t vertices = mesh.positions.size() / mesh.dimension;
    file.write(header_of(mesh, vertices));
    std::string record;
    for (std::size_t v = 0; v < vertices; ++v) {
        record.clear();
        const auto position = std::span(mesh.positions).subspan(v * mesh.dimension, mesh.dimension);
        for (const double x : position.first(3)) {
            append_little_endian(record, x);
        }
        for (std::size_t axis = 0; axis < position.size() && position.size() > 3; ++axis) {
            append_little_endian(record, position[axis]);
        }
        file.write(record);
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        record.assign(1, '\3');
        for (const std::uint32_t corner : std::span(mesh.triangles).subspan(i, 3)) {
            append_little_endian(record, corner);
        }
        file.write(record);
    }
    file.commit();
}

} // namespace geodisk::tools
