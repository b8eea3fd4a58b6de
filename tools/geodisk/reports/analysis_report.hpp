// Report of `geodisk analyze`: to people and to programs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/evenness.hpp"
#include "analysis/surface_statistics.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/mesh_options.hpp"
#include "geodisk/reports/json_type.hpp"

namespace geodisk::tools {

/// Content of one file.
struct SetAnalysis {
    std::string path;
    std::size_t samples = 0;
    double min_distance = 0;   ///< Twice the largest radius, or the largest distance of classes.
    std::optional<double> rho; ///< Packing density, if radii do not vary.
    std::uint64_t bare_components = 0;
    analysis::SurfaceStatistics found;
    /// Each class alone, but for its room, which other classes take too. Without classes: none.
    std::vector<SetAnalysis> classes{};
};

/// Returns true if all sets have about the same minimum distance, so that means over them say
/// something.
bool are_alike(const std::vector<SetAnalysis>& sets);

/// All sets, on one mesh; what is borrowed must outlive it.
struct Analysis {
    const MeshInput& mesh;
    const std::vector<MeshWarning>& warnings;
    const std::vector<SetAnalysis>& sets;
    std::optional<analysis::Evenness> evenness; ///< Evenness of several sets that are alike.
};

/// Returns what was found of one set.
Json set_json(const SetAnalysis& set);

std::string report_text(const Analysis& analysis);

/// One JSON object and a line break.
std::string report_json(const Analysis& analysis);

} // namespace geodisk::tools
