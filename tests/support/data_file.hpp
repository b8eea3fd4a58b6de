// Files that tests read: the project's own in tests/data, real meshes outside the repository.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace geodisk::test {

/// "bad" or "cases", or "bad/NAME" or "cases/NAME", in tests/data; or "meshes/NAME" in the folder
/// GEODISK_SHARED_DATA. Where that folder is missing there is nothing and a doctest message says
/// so; in continuous integration (CI=true in the environment) the test fails, unless
/// GEODISK_NO_MESHES=true and tests/data/mesh_tests.txt has its name. A test that runs on a
/// stand-in as well (stand_in_meshes.hpp) says nothing, and needs no name there.
std::optional<std::filesystem::path> data_file(const std::string& name, bool has_stand_in = false);

} // namespace geodisk::test
