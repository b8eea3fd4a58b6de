// Steps of `geodisk verify`, by one process or many.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <geodisk/box.hpp>

#include "files/samples/sample_file.hpp"
#include "geodisk/checks/near_pairs.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/checks/spacing.hpp"
#include "geodisk/checks/wanted_spacing.hpp"
#include "geodisk/inputs/line_input.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/verify_options.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geodisk/reports/verify_report.hpp"

namespace geodisk::tools {

/// Checks samples that are on their mesh, and `spacing`, what wanted_spacing() finds. Prints
/// nothing. Throws UserError.
SampleCheck check_samples(const VerifyOptions& options, const MeshInput& mesh,
                          const SampleFile& samples, std::vector<StrayRow> strays,
                          WantedSpacing spacing, const Avoided& avoided,
                          std::vector<MeshWarning> warnings, ProgressLine& progress,
                          const NotePairs& note = note_pairs);

/// Findings on samples in a box.
struct BoxCheck {
    BoxParams box;
    std::size_t outside; ///< Number of samples outside of it.
    SpacingResult spacing;
};

/// Checks samples in the box of their header, with `min_distance` as for box_of(). Throws
/// UserError.
BoxCheck check_box(const std::string& min_distance, const SampleFile& samples,
                   ProgressLine& progress);

/// One JSON object and a line break.
std::string report_json(const SampleFile& samples, const BoxCheck& check);

/// Checks samples and publishes what it finds; pairs of samples on a mesh are found by `note`.
/// Throws UserError, that of violations among them.
void verify_samples(const VerifyOptions& options, const NotePairs& note = note_pairs);

} // namespace geodisk::tools
