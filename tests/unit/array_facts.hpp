// Attributes of meshes read from bytes.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "files/meshes/mesh_file.hpp"
#include "test_files.hpp"

namespace geodisk::tools {

/// Reads a mesh with the attributes of these names, or "all".
inline MeshFile mesh_and_fields(std::string_view name, std::string_view bytes,
                                const std::string& fields) {
    const TemporaryFolder folder;
    MeshSources sources;
    sources.mesh = folder.write(name, bytes).string();
    sources.fields = parse_fields(fields);
    return read_mesh(sources);
}

/// Returns the values of an attribute that the mesh must have.
inline std::vector<double> values_of(const MeshFile& mesh, std::string_view name) {
    const auto found = std::ranges::find(mesh.fields, name, &MeshField::name);
    REQUIRE(found != mesh.fields.end());
    return found->values;
}

} // namespace geodisk::tools
