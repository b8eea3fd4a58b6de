// SpaceRunner: samples a surface by distances through space, as other methods do, for comparison.
// It is not what geodesic distance gives: sheets that come near each other in space keep each
// other's samples away although the way along the surface is long (paper sections 5.6 and 6.1).
#pragma once

#include <memory>

#include <geodisk/device.hpp>
#include <geodisk/export.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Distances that do not go along the surface.
enum class Metric : std::uint32_t {
    euclidean,   ///< The straight line.
    approximate, ///< The closed form of Bowers, Wang, Wei and Maletz 2010 by positions and normals:
                 ///< d * (asin(a) - asin(b)) / (a - b), with the straight distance d and the
                 ///< cosines a and b of its angles with both normals. Exact on planes and spheres.
};

/// Not thread-safe; several runners may share a device, and a queue through QueueRef's lock.
class GEODISK_API SpaceRunner {
  public:
    /// Compiles the pipelines and checks the device's arithmetic. Errors: as Runner::create.
    static Result<SpaceRunner> create(const DeviceRefs& device, const QueueRef& queue,
                                      Metric metric, const RunnerOptions& options = {}) noexcept;
    SpaceRunner(SpaceRunner&&) noexcept;
    SpaceRunner& operator=(SpaceRunner&&) noexcept;
    ~SpaceRunner();

    /// Returns the set that sequential dart throwing by the metric returns over the candidates of
    /// Runner::sample_and_wait, whatever device, driver or plan. `view` is what
    /// `mesh` was prepared from.
    ///
    /// Candidates are placed to 2^-31 of the bounding box, so conflicts are tested against
    /// `min_distance * (1 + guard)` with RunReport::guard = 2^-20 + 2^-30 * box / D. No two samples
    /// are closer in space than D. Normals are those of the vertices, weighted by the areas of
    /// their faces, and interpolated.
    ///
    /// Errors: `invalid_argument` as pool_size(), for a view of another mesh, or one that has not
    /// three coordinates per vertex, or for `radii`; else as Runner::sample_and_wait.
    Result<SampleSet> sample_and_wait(const MeshView& view, const PreparedMesh& mesh,
                                      const SampleParams& params,
                                      const ProgressCallback& progress = {}) noexcept;

    /// The tuning that was chosen for the device.
    const Tuning& tuning() const noexcept;

  private:
    explicit SpaceRunner(std::unique_ptr<Runner::Impl> impl) noexcept;
    std::unique_ptr<Runner::Impl> impl_;
};

} // namespace geodisk
