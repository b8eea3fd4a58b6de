// LitCells: the disks of samples, as large as their cells.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <geodisk/cells.hpp>
#include <geodisk/job_frame.hpp>

#include "engine/cells/near_lights.hpp"
#include "engine/maximal/lit_faces.hpp"
#include "engine/run/mesh_parts.hpp"
#include "engine/run/runner_impl.hpp"
#include "engine/run/task.hpp"
#include "parts/near_part.hpp"

namespace geodisk {

class LitCells {
  public:
    /// Samples must be checked. All arguments must outlive it.
    LitCells(Runner::Impl& runner, const PreparedMesh& mesh, std::span<const Sample> samples,
             const SampleParams& params, const JobFrame& frame, const CellParams& cells);

    /// Computes the disks, and larger ones where cells may be larger. `whole` gets the progress,
    /// with twice as many candidates as there are samples.
    Task<Result<Done>> light(WholeProgress whole);

    const LitFaces& faces() const { return lit_; }
    Closeness closeness() const;
    double largest_radius() const;
    double smallest_radius() const;
    const RunReport& report() const { return report_; }

  private:
    /// Makes disks smaller until so many as there are may be expected to have few enough records.
    Task<Result<Done>> choose_radii();
    using TakeLights = std::function<void(std::span<const gpu::LitRec>)>;
    /// Computes the disks of the first samples, as many as have room at once. Returns their number,
    /// or 0 if they had more records than expected. `near` is the part of the mesh that holds them,
    /// or null for the whole.
    Task<Result<std::size_t>> some_disks(std::span<const std::uint32_t> samples,
                                         const NearPart* near, const TakeLights& take);
    /// Computes the disks of all.
    Task<Result<Done>> disks_on(const NearPart* near, std::span<const std::uint32_t> samples,
                                const TakeLights& take);
    /// Does so by parts of the mesh, where the device does not hold the whole.
    Task<Result<Done>> all_disks(std::span<const std::uint32_t> samples, const TakeLights& take);
    Task<Result<Done>> disks_in_parts(std::span<const std::uint32_t> samples,
                                      const TakeLights& take);
    Error too_many(double records) const;
    /// Returns the progress of all disks, from that of the ones at hand.
    Progress so_far(const Progress& now) const;

    Runner::Impl& runner_;
    const PreparedMesh& mesh_;
    std::span<const Sample> samples_;
    const SampleParams& params_;
    const JobFrame& frame_;
    const CellParams& cells_;
    LitFaces lit_;
    std::vector<double> radii_; ///< In units of the frame.
    double records_per_disk_;
    std::size_t left_;       ///< Samples whose disks are still to be computed, or larger ones.
    std::size_t wanted_ = 0; ///< Samples whose disks all_disks() computes.
    MeshParts parts_;
    RunReport report_;
};

} // namespace geodisk
