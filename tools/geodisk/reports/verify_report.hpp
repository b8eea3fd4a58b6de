// Report of `geodisk verify`: to people and to programs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "files/samples/sample_file.hpp"
#include "geodisk/checks/gaps.hpp"
#include "geodisk/checks/intrusions.hpp"
#include "geodisk/checks/level_checks.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/checks/spacing.hpp"
#include "geodisk/checks/wanted_spacing.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/verify_options.hpp"

namespace geodisk::tools {

/// Input of a check and its findings.
struct SampleCheck {
    const VerifyOptions& options;
    const SampleFile& samples;
    const MeshInput& mesh;
    std::vector<MeshWarning> warnings;
    WantedSpacing spacing;
    std::vector<StrayRow> strays;
    SpacingResult result;              ///< Result for all pairs but these:
    SpacingResult among_existing;      ///< Result for existing samples.
    std::vector<std::uint32_t> masked; ///< Samples on faces that take none.
    std::size_t avoided = 0;           ///< Number of points to avoid.
    double avoided_length = 0;         ///< Length of lines to avoid.
    std::vector<Intrusion> intrusions;
    std::optional<GapCheck> gaps;
    std::vector<LevelSpacing> levels; ///< Spacing of the levels of samples in progressive order.
    std::vector<std::uint32_t> wrong_features; ///< Samples whose mark as feature is wrong.

    /// Number of existing samples.
    std::size_t existing() const;
    /// Packing density, where a distance is known.
    double rho() const;
    /// Number of samples of each class.
    std::vector<std::size_t> class_counts() const;
    /// Returns true if there are points or lines to avoid.
    bool avoids() const { return avoided > 0 || avoided_length > 0; }
    /// Returns the distance that the distance of a pair is a part of.
    std::string min_text() const;
};

std::string report_text(const SampleCheck& check);

/// One JSON object and a line break.
std::string report_json(const SampleCheck& check);

/// Returns all that is wrong with the samples, as one sentence; empty if nothing is.
std::string fault_text(const SampleCheck& check);

} // namespace geodisk::tools
