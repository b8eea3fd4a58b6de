// Surfaces with geodesic distances.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/domain/device_mesh.hpp"
#include "engine/domain/domain_impl.hpp"
#include "engine/domain/listed.hpp"
#include "engine/domain/placed_surface.hpp"
#include "engine/domain/tolerances.hpp"

namespace geodisk {

/// Meshes and what is asked of each, which pool_size() finds no fault with; all must outlive it.
class SurfaceDomain : public Domain::Impl {
  public:
    SurfaceDomain(std::vector<PlacedSurface> surfaces, FaceCells cells);
    static Result<std::unique_ptr<const Impl>> make(std::vector<PlacedSurface> surfaces);
    /// Implements listed_domain(), for candidates that are checked.
    static Result<Domain> listed(const PreparedMesh& mesh, const SampleParams& params,
                                 const JobFrame& frame, std::span<const ListedCandidate> candidates,
                                 bool may_divide = false,
                                 std::span<const std::uint8_t> classes = {});

    /// Makes the domain of the existing samples and points to avoid of `params`, whose disks record
    /// what `ending` says, at most so many times. To record what they reach is for these targets,
    /// or without any for vertices. `bounds` as for set_bounds(), if there are any.
    static Result<Domain> recording(const PreparedMesh& mesh, const SampleParams& params,
                                    const JobFrame& frame, Ending ending,
                                    std::span<const ListedCandidate> targets,
                                    std::uint32_t max_records, std::span<const double> bounds = {});
    /// Makes the domain of a surface whose parameters are checked.
    static Result<Domain> plain(const PreparedMesh& mesh, const SampleParams& params,
                                const JobFrame& frame);

    /// Returns the number of the target at each place, of recording() with targets.
    std::span<const std::uint32_t> target_numbers() const { return listed_.numbers; }

    std::uint64_t max_candidates(const DeviceLimits& limits, std::uint32_t slots) const override;
    void plan_disks(RunPlan& plan, std::uint32_t candidates,
                    const DeviceReport& report) const override;
    double disk_steps(const RunPlan& plan, std::uint32_t candidates) const override;
    double all_steps(const RunPlan& plan) const override;
    double detect_passes(const RunPlan& plan, std::uint32_t candidates) const override;
    std::uint64_t cells(std::uint32_t candidates, double error_bound) const override;
    void add_needs(WorkspaceNeeds& needs, std::uint32_t candidates,
                   const RunPlan& plan) const override;
    std::string beside_candidates() const override;
    void set_constants(gpu::JobRec& job, const RunPlan& plan) const override;
    std::size_t upload_size(BufferRole role) const override;
    std::size_t mesh_bytes(BufferRole role) const override;
    Result<UploadParts> upload_parts(const RunPlan& plan, BufferRole role) const override;
    double guard_for(double error_bound) const override { return error.guard_for(error_bound); }
    std::optional<Sharing> sharing() const override;

  private:
    /// Ends the disks of existing samples at vertices that are farther than this, in mesh units:
    /// only where something else is nearer, whatever is behind. For one surface whose radii do not
    /// vary.
    void set_bounds(std::span<const double> bounds);
    /// Sets those by which the disks of existing samples, if they overlap a lot, end where another
    /// of them is nearer.
    void bound_existing();
    /// Returns what the host gives of a buffer of candidates.
    std::span<const std::uint32_t> listed_words(BufferRole role) const;
    double faces_per_disk() const { return 2.0 * face_count(surfaces_) / whole_; }

    std::vector<PlacedSurface> surfaces_;
    double first_error_ = 0;
    FaceCells cells_;
    std::uint64_t record_bytes_ = 0; ///< Bytes of recording(): the head, weights and records.
    std::vector<float> bounds_;      ///< In units of the frame, whole rows.
    ListedBuffers listed_;           ///< Empty unless the host gives the candidates.
    double full_ = 0;                ///< Samples that full surfaces hold, at least two each.
    double whole_ = 0; ///< The same without masks: no disk covers more than all faces.
};

} // namespace geodisk
