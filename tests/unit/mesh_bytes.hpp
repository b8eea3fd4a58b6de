// Meshes read from bytes.
#pragma once

#include <string_view>

#include "files/meshes/mesh_file.hpp"
#include "test_files.hpp"

namespace geodisk::tools {

/// read_mesh() of a file with these bytes.
inline MeshFile mesh_of(std::string_view name, std::string_view bytes) {
    const TemporaryFolder folder;
    return read_mesh(folder.write(name, bytes).string());
}

inline void check_refused(std::string_view name, std::string_view bytes, std::string_view part) {
    CAPTURE(bytes);
    check_fails(ExitCode::bad_input, part, [&] { mesh_of(name, bytes); });
}

} // namespace geodisk::tools
