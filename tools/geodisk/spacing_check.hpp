// Distances between samples, recomputed in double precision with the reference implementation.
#pragma once

#include <optional>
#include <span>

#include "common/sample_file.hpp"
#include "geodisk/mesh_input.hpp"
#include "geodisk/progress.hpp"
#include "geodisk/spacing_result.hpp"

namespace geodisk::tools {

/// Computes the geodesic distances of all pairs that are not farther apart than a cut somewhat
/// beyond the sum of their radii, which are positive, one to a row.
///
/// Every row's face must be one of the mesh. Throws UserError when interrupted.
SpacingResult check_spacing(const MeshInput& mesh, std::span<const SampleRow> rows,
                            std::span<const double> radii, ProgressLine& progress);

/// The closest pair of all, by distance, however far apart; none if no path joins any two samples.
/// Conditions and errors are those of check_spacing().
std::optional<ClosePair> find_closest(const MeshInput& mesh, std::span<const SampleRow> rows,
                                      ProgressLine& progress);

} // namespace geodisk::tools
