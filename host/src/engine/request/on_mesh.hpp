// Errors of one of several requests.
#pragma once

#include <cstddef>
#include <string>

#include <geodisk/status.hpp>

namespace geodisk {

/// Names the mesh of an error, unless there is only one.
inline Error on_mesh(std::size_t mesh, std::size_t meshes, Error error) {
    if (meshes > 1) {
        error.message = "mesh " + std::to_string(mesh) + ": " + error.message;
    }
    return error;
}

} // namespace geodisk
