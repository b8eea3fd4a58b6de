// Report of `neighbours` on a search: to people and to programs.
#pragma once

#include <string>
#include <vector>

#include "geodisk/neighbour_run.hpp"
#include "geodisk/options/mesh_options.hpp"

namespace geodisk::tools {

/// A search that is done, for write_outputs().
struct NeighbourReport {
    const MeshInput& mesh;
    const std::vector<MeshWarning>& warnings; ///< Warnings about mesh and points.
    const NeighbourJob& job;
    const NeighbourResult& result;
    const std::string& output;
    bool has_points;     ///< Sources are points, else vertices.
    std::string targets; ///< Name of the targets.

    std::string json(double write_seconds) const;
    std::string summary(double write_seconds) const;
};

} // namespace geodisk::tools
