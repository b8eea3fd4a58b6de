// Distances between samples, recomputed in double precision with the reference implementation.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/sample_file.hpp"
#include "geodisk/mesh_input.hpp"
#include "geodisk/progress.hpp"

namespace geodisk::tools {

/// Two rows of the sample file, the lower one first, and their geodesic distance.
struct ClosePair {
    std::uint32_t row_a, row_b;
    double distance;
    double ratio; ///< Of the distance to what it should be at least; of find_closest() itself.
};

struct SpacingResult {
    double cut = 0;                    ///< Pairs were looked at up to this ratio.
    std::optional<ClosePair> closest;  ///< By ratio; none if all are farther apart than the cut.
    std::vector<ClosePair> violations; ///< The closest pair first, by ratio.
    bool is_complete = true;           ///< False if the check stopped at too many violations.

    /// Samples in at least one violation.
    std::size_t violating_samples() const;
};

/// Computes the geodesic distances of all pairs that are not farther apart than a cut somewhat
/// beyond the sum of their radii, which are positive, one to a row. A pair violates it when it is
/// closer by more than a billionth.
///
/// Every row's face must be one of the mesh. Throws UserError when interrupted.
SpacingResult check_spacing(const MeshInput& mesh, std::span<const SampleRow> rows,
                            std::span<const double> radii, ProgressLine& progress);

/// The closest pair of all, by distance, however far apart; none if no path joins any two samples.
/// Conditions and errors are those of check_spacing().
std::optional<ClosePair> find_closest(const MeshInput& mesh, std::span<const SampleRow> rows,
                                      ProgressLine& progress);

} // namespace geodisk::tools
