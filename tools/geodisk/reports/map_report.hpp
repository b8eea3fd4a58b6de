// Report of `bake`: to people and to programs.
#pragma once

#include <string>
#include <vector>

#include "geodisk/map_run.hpp"
#include "geodisk/options/mesh_options.hpp"

namespace geodisk::tools {

/// A map that is made, for write_outputs().
struct MapReport {
    const MeshInput& mesh;
    const std::vector<MeshWarning>& warnings; ///< Warnings about mesh and samples.
    const MapResult& result;
    std::size_t samples;
    const std::string& output;

    std::string json(double write_seconds) const;
    std::string summary(double write_seconds) const;
};

} // namespace geodisk::tools
