// NearestSamples: which sample is nearest to points of a surface, and how far it is along the
// surface.
// Experimental.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <geodisk/cells.hpp>
#include <geodisk/export.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/sample.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// The sample nearest to a point, by exact geodesic distance.
struct NearestSample {
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};

    /// Index of the sample; kNone where no path leads to one.
    std::uint32_t sample = kNone;
    float distance = std::numeric_limits<float>::infinity(); ///< In mesh units.
};

/// Finds the nearest sample of any point on the CPU, from the disks of the samples. Each disk is as
/// large as the geodesic Voronoi cell of its sample.
class GEODISK_API NearestSamples {
  public:
    /// Computes the disks on the device. `mesh` must outlive the result, and may not move. Takes 36
    /// bytes on the host for each record of a path, see CellParams::max_records. Progress counts
    /// samples as candidates; returns `cancelled` if it asks to stop.
    ///
    /// Errors: those of find_cells().
    static Result<NearestSamples> create(Runner& runner, const PreparedMesh& mesh,
                                         std::span<const Sample> samples,
                                         std::uint64_t max_records = std::uint64_t{1} << 27,
                                         const ProgressCallback& progress = {}) noexcept;
    NearestSamples(NearestSamples&&) noexcept;
    NearestSamples& operator=(NearestSamples&&) noexcept;
    ~NearestSamples();

    /// Returns the nearest sample of each point. Ties up to rounding go to the first sample, as for
    /// find_cells(). Weights are rounded to multiples of 2^-24. The result is
    /// the same on every device. Several threads may call it at a time.
    ///
    /// Errors: `invalid_argument` for a point, naming it, in a face that does not exist or repeats
    /// a vertex or with weights that are negative or do not sum to 1; `out_of_host_memory`.
    Result<std::vector<NearestSample>> of(std::span<const Sample> points) const noexcept;

    /// Returns the cells of the samples as find_cells() does, from the same disks: with the dual
    /// graph, and with the report of the run that computed the disks. Progress counts samples twice
    /// as candidates, and begins halfway. Several threads may call it at a time.
    ///
    /// Errors: `cancelled` if progress asks to stop; `out_of_host_memory`.
    Result<SurfaceCells> cells(const ProgressCallback& progress = {}) const noexcept;

    /// Returns a bound on the error of distances, in mesh units.
    double error() const noexcept;
    /// Returns statistics of the run that computed the disks.
    const RunReport& report() const noexcept;

    struct Impl; ///< Internal.

  private:
    explicit NearestSamples(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

} // namespace geodisk
