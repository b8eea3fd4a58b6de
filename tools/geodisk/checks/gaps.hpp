// Gaps that samples leave on a surface, found in double precision by the reference implementation.
#pragma once

#include <optional>
#include <span>

#include <geodisk/sample.hpp>

#include "coverage.hpp"
#include "files/samples/sample_file.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geodisk/reports/json_type.hpp"

namespace geodisk::tools {

/// Distances of the points of a surface from the nearest sample, as ratios to the minimum distance.
struct GapCheck {
    ref::Coverage found;
    double allowed;  ///< Covered points have lower ratios: 1 and twice the guard.
    double distance; ///< Length of ratio 1, in the unit of the user.
    bool radii_vary;

    bool is_maximal() const { return !found.uncovered; }
};

/// Looks for gaps between samples with these radii, and points to avoid, on the faces that take
/// samples. Radii vary if `mesh` has them. Throws UserError when interrupted.
GapCheck find_gaps(const MeshInput& mesh, std::span<const SampleRow> rows,
                   std::span<const double> radii, double min_distance,
                   std::span<const KeepOut> avoided, ProgressLine& progress);

/// Says where the largest gap is: "triangle 7, weights 0.2 0.3 0.5, position 1 2 3". There must be
/// one.
std::string uncovered_text(const GapCheck& gaps, const MeshInput& mesh);
/// Says how large the largest gap is, and where: "0.00185, every point is covered".
std::string gap_text(const GapCheck& gaps, const MeshInput& mesh);
Json gap_json(const std::optional<GapCheck>& gaps);

} // namespace geodisk::tools
