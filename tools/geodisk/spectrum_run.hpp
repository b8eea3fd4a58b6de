// Spectra of samples on a surface, for the commands that tell of them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "analysis/surface_spectrum.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geometry/mesh_warning.hpp"

namespace geodisk::tools {

struct SpectrumRun {
    analysis::SurfaceSpectrum spectrum;
    double seconds = 0;
    double expected_seconds = 0, expected_bytes = 0; ///< As told before.
};

/// "" for what is usual. Throws UserError(usage).
std::size_t parse_harmonics(const std::string& text);

/// Returns the spectrum of sets on the mesh, by as many harmonics as
/// --harmonics says. If that is "" and there are fewer than usual, uses all. Warns if the mesh is
/// coarse for them. Throws UserError.
SpectrumRun compute_spectrum_on(const MeshInput& mesh,
                                std::span<const analysis::PlacedSamples> sets,
                                const std::string& harmonics, std::vector<MeshWarning>& warnings,
                                ProgressLine& progress);

} // namespace geodisk::tools
