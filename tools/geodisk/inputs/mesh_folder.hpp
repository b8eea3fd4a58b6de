// The mesh files of a folder.
#pragma once

#include <filesystem>
#include <vector>

#include "program/path.hpp"

namespace geodisk::tools {

/// Returns true if the extension is that of a mesh format.
bool is_mesh_file(const std::filesystem::path& path);

/// Relative paths of all files in `folder`, and in folders in it, whose extension is that of a mesh
/// format, in the order of their names. What begins with a dot is passed over, and so is the folder
/// `without`, where results may be. Throws UserError(bad_input) for a folder that cannot be read.
std::vector<std::filesystem::path> mesh_files_in(const Path& folder, const Path& without);

} // namespace geodisk::tools
