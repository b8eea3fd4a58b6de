// Report of `cells`: to people and to programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geodisk/cell_run.hpp"
#include "geodisk/options/mesh_options.hpp"
#include "geodisk/outputs/scene_frame.hpp"

namespace geodisk::tools {

/// Cells that are found, for write_outputs().
struct CellReport {
    const MeshInput& mesh;
    const std::vector<MeshWarning>& warnings; ///< Warnings about mesh and samples.
    const CellResult& result;
    const std::string& output;
    const std::string& dual;             ///< File of the dual graph, or "".
    const std::string& labels;           ///< File of the labels of vertices, or "".
    const std::string &split, &outlines; ///< Files of cells as geometry, or "".
    std::optional<SceneFrame> scene;

    std::string json(double write_seconds) const;
    std::string summary(double write_seconds) const;
};

} // namespace geodisk::tools
