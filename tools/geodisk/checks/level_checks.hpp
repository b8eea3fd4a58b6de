// Levels of samples in progressive order: each must keep its own distance.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "files/samples/sample_file.hpp"
#include "geodisk/checks/near_pairs.hpp"
#include "geodisk/checks/spacing.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geodisk/reports/json_type.hpp"

namespace geodisk::tools {

/// Result of checking one level.
struct LevelSpacing {
    double min_distance;  ///< As the header has it.
    std::size_t samples;  ///< Up to its end.
    SpacingResult result; ///< Result for all pairs but those of existing samples.
};

/// Checks the samples up to the end of each level whose distance the header has; none without such
/// distances. `radii` are those of the last level, and `last` is what a check with them found.
/// Pairs are found by `note`. Throws UserError(bad_input) where header and column contradict each
/// other, or samples are not in the order of their levels.
std::vector<LevelSpacing> check_levels(const SampleFile& samples, const MeshInput& mesh,
                                       std::span<const double> radii, const SpacingResult& last,
                                       ProgressLine& progress, const NotePairs& note);

/// A line for each level. `has_existing` tells whether pairs of existing samples were left out.
std::string level_lines(const std::vector<LevelSpacing>& levels, bool has_existing);

/// "3 pairs of samples up to level 1 are closer than 0.2"; empty without violations.
std::string level_fault(const std::vector<LevelSpacing>& levels);

/// An object for each level; null without levels.
Json levels_json(const std::vector<LevelSpacing>& levels);

} // namespace geodisk::tools
