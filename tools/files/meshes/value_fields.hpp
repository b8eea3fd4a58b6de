// Values of vertices in files beside a mesh, as attributes of the mesh.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/meshes/mesh_fields.hpp"
#include "files/meshes/polygon_mesh.hpp"

namespace geodisk::tools {

/// Begins the name of a file of values, where an attribute of the mesh may stand: "file:lh.curv".
inline constexpr std::string_view kValueFile = "file:";

/// Returns the file that `name` means; nothing for an attribute of the mesh.
std::optional<std::string> value_file(std::string_view name);

/// Returns a list of attributes with `place(file)` for each file of values.
std::string with_files_at(const std::string& attributes,
                          const std::function<std::string(const std::string&)>& place);

/// Returns the files among the names and numbers of `wanted`.
std::vector<std::string> value_files(const WantedFields& wanted);

/// Adds the values that the files among `wanted` have for the vertices of `polygons`. Those that
/// are asked for as attributes are called as their file without its folder, and the result asks for
/// them by that name.
/// Throws UserError(bad_input) for a file that cannot be read, or of another number of vertices.
WantedFields add_value_files(const WantedFields& wanted, PolygonMesh& polygons);

} // namespace geodisk::tools
