// The waves of a surface: eigenfunctions of its Laplacian.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include <Eigen/Core>

#include "analysis/laplacian.hpp"
#include "program/batches.hpp"

namespace geodisk::tools::analysis {

/// Eigenfunctions one after the other in frequency, the columns of `functions`: their values at the
/// nodes, such that the integral of the square is 1. `first` counts those of lower frequency.
struct HarmonicBand {
    std::size_t first = 0;
    Eigen::VectorXd eigenvalues; ///< Ascending: squares of 2 pi times the frequency.
    Eigen::MatrixXd functions;
};

/// Cost of computing them.
struct HarmonicCost {
    double seconds, bytes;
};

/// Manifold harmonics (Vallet and Levy, "Spectral geometry processing with manifold harmonics",
/// 2008), found band by band as proposed there. That none is missed in a band is certified: the
/// factors of stiffness - s mass have as many negative pivots as there are eigenvalues below s
/// (Sylvester's law of inertia). Those whose wave is much longer than the surface is wide, one
/// constant function per component above all, are not among them.
class ManifoldHarmonics {
  public:
    /// Throws std::bad_alloc.
    explicit ManifoldHarmonics(const Laplacian& laplacian);
    ~ManifoldHarmonics();
    ManifoldHarmonics(ManifoldHarmonics&&) noexcept;

    /// Returns the number of harmonics. Those of the finest waves hardly resemble those of the
    /// smooth surface.
    std::size_t count() const { return count_; }

    /// A guess, from the time that solving once took.
    HarmonicCost cost(std::size_t harmonics) const;

    /// Calls `visit` with bands that together hold the first `harmonics`, at most count(), once
    /// each; bands in any order and on any of as many threads as the machine has cores. `tell` is
    /// called on the calling thread. Throws UserError(no_result) naming a band where an
    /// eigenfunction cannot be found, and what `tell` throws.
    void compute(std::size_t harmonics, const std::function<void(const HarmonicBand&)>& visit,
                 const PartDone& tell) const;

  private:
    struct Probe;
    std::unique_ptr<Probe> probe_;
    std::size_t count_ = 0;
};

} // namespace geodisk::tools::analysis
