// Measuring how samples are spread, for the commands that do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geodisk/reports/analysis_report.hpp"
#include "geometry/surface_disk.hpp"

namespace geodisk::tools {

class Command;

/// Adds --probes.
void add_probes_option(Command command, std::string& probes);

/// Returns how many random places to look at: as --probes says, or if that is "", what suits so
/// many samples. Throws UserError(usage).
std::uint32_t probes_for(const std::string& probes, std::size_t samples);

/// Measures samples, not none, on the faces of `mesh` that its mask keeps, and those of each class.
/// Random places are drawn by `seed`. The path is left to the caller. Throws UserError.
SetAnalysis analyze_disks(const MeshInput& mesh, const SampleDisks& samples,
                          const std::string& probes, std::uint64_t seed, ProgressLine& progress);

} // namespace geodisk::tools
