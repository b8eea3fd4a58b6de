// Warnings that the program prints, for Python to show.
#pragma once

#include <vector>

#include "geodisk/reports/json_type.hpp"
#include "geodisk_python.h"
#include "geometry/mesh_warning.hpp"

namespace geodisk::tools {

/// Return what these commands of geodisk_run_command() list.
std::vector<MeshWarning> warnings_of_mesh(const geodisk_task& task);
std::vector<MeshWarning> warnings_of_set(const geodisk_task& task, const Json& options);
std::vector<MeshWarning> warnings_of_drivers();

} // namespace geodisk::tools
