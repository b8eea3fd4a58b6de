// The sources of meshes of the Python package.
#pragma once

#include <cstdint>
#include <vector>

#include "geodisk_python.h"
#include "geometry/mesh.hpp"

struct geodisk_source {
    geodisk::tools::MeshFile mesh;
    std::vector<std::vector<std::uint32_t>> columns; ///< A value for each triangle.
    bool is_y_up = false;                            ///< Read from a format in which y points up.
};
