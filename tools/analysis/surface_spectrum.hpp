// Power spectra of samples on a surface.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "analysis/manifold_harmonics.hpp"
#include "analysis/spectrum_rings.hpp"
#include "lib/surface.hpp"
#include "program/batches.hpp"

namespace geodisk::tools::analysis {

/// Samples by their places, of which the first coordinates are faces of the Laplacian's triangles
/// that are part of the surface.
using PlacedSamples = std::vector<ref::FacePoint<double>>;

/// As Bowers, Wang, Wei and Maletz, "Parallel Poisson disk sampling with spectrum analysis on
/// surfaces", 2010, with the waves of the surface in place of those of the plane: the power of a
/// set in a harmonic is the square of its sum over the samples, times area / samples, which is 1 on
/// average where samples know nothing of each other.
struct SurfaceSpectrum {
    double area;
    std::vector<double> frequencies; ///< Ascending, in waves per unit of length.
    /// By set, then harmonic.
    std::vector<std::vector<double>> powers;

    /// Returns the rings of the power averaged over `sets`, numbers of them, as wide as the rings
    /// of a square of the same area. The anisotropy is 2 / sets.size() if no direction is another
    /// than the others, twice as much as in the plane: the waves are real ones.
    std::vector<SpectrumRing> rings(std::span<const std::size_t> sets) const;
    /// Returns the rings of all sets.
    std::vector<SpectrumRing> rings() const;
};

/// Returns the spectrum by the first so many of `harmonics`, at most their count. Sets are not
/// empty. Works on as many threads as there are cores, and the result does not depend on them.
/// Throws as ManifoldHarmonics::compute().
SurfaceSpectrum compute_spectrum(const Laplacian& laplacian, const ManifoldHarmonics& harmonics,
                                 std::size_t count, std::span<const PlacedSamples> sets,
                                 const PartDone& tell);

} // namespace geodisk::tools::analysis
