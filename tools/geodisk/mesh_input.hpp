// The mesh of a command, read and prepared, with all that is odd about it told to the user.
#pragma once

#include <string>

#include <geodisk/mesh.hpp>

#include "common/mesh_file.hpp"
#include "common/vec3.hpp"

namespace geodisk::tools {

struct MeshInput {
    MeshFile file;
    PreparedMesh prepared;
    double load_seconds = 0;
    double prepare_seconds = 0;

    Vec3 vertex(std::uint32_t face, std::uint32_t corner) const {
        const double* p = &file.positions[3 * std::size_t{file.triangles[3 * face + corner]}];
        return {p[0], p[1], p[2]};
    }
    /// The point of `face` with the given weights of its corners.
    Vec3 point(std::uint32_t face, const float (&weights)[3]) const;
    /// Of unit length; zero for a face without area.
    Vec3 normal(std::uint32_t face) const;
};

class ProgressLine;

/// Reads and prepares MESH and writes warnings to standard error. Throws UserError as read_mesh(),
/// or bad_input when the mesh is rejected.
MeshInput load_mesh(const std::string& path, ProgressLine& progress);

/// "geodisk: warning: MESSAGE" on standard error.
void print_warning(const std::string& message);

} // namespace geodisk::tools
