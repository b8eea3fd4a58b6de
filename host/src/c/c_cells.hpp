// Nearest samples of the C API.
#pragma once

#include <memory>

#include <geodisk/geodisk.h>
#include <geodisk/nearest.hpp>

#include "c/c_mesh.hpp"

/// Immutable.
struct geodisk_nearest {
    std::shared_ptr<const geodisk::c::Mesh> mesh; ///< Which outlives the disks.
    geodisk::NearestSamples disks;
};
