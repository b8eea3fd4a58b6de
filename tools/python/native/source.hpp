// The sources of meshes of the Python package.
#pragma once

#include "geodisk_python.h"
#include "geometry/mesh.hpp"

struct geodisk_source {
    geodisk::tools::MeshFile mesh;
};
