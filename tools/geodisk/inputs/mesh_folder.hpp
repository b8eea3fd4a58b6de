// The mesh files of a folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "program/path.hpp"

namespace geodisk::tools {

/// Returns true if the file is to be read as a mesh: by its extension, or as a binary surface of
/// FreeSurfer.
bool is_mesh_file(const std::filesystem::path& path);

/// Returns the endings of names that only meshes have, behind `before`: ".obj", ".surf.gii".
std::vector<std::string> mesh_endings(const std::string& before = ".");

/// Relative paths of all files in `folder`, and in folders in it, that have one of mesh_endings(),
/// in the order of their names. What begins with a dot is passed over, and so is the folder
/// `without`, where results may be. Throws UserError(bad_input) for a folder that cannot be read.
std::vector<std::filesystem::path> mesh_files_in(const Path& folder, const Path& without);

} // namespace geodisk::tools
