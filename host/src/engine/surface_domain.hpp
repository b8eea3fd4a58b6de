// Surfaces with geodesic distances.
#pragma once

#include "engine/domain_impl.hpp"
#include "engine/tolerances.hpp"

namespace geodisk {

/// A mesh and what is asked of it, which pool_size() finds no fault with; all must outlive it.
class SurfaceDomain : public Domain::Impl {
  public:
    SurfaceDomain(const PreparedMesh& mesh, const SampleParams& params, std::uint32_t cells);

    std::uint64_t most_candidates(const DeviceLimits& limits, std::uint32_t slots) const override;
    void plan_disks(RunPlan& plan, std::uint32_t candidates,
                    const DeviceReport& report) const override;
    double disk_steps(const RunPlan& plan, std::uint32_t candidates) const override;
    double detect_passes(const RunPlan& plan, std::uint32_t candidates) const override;
    std::uint32_t most_steps(const DeviceReport& report,
                             const KernelVariant& variant) const override;
    std::uint64_t cells(std::uint32_t candidates, double error_bound) const override;
    void add_needs(WorkspaceNeeds& needs, std::uint32_t candidates,
                   const RunPlan& plan) const override;
    std::string beside_candidates() const override;
    void set_push(gpu::Push& push, const RunPlan& plan) const override;
    std::size_t upload_size(BufferRole role) const override;
    Result<Done> write_upload(const RunPlan& plan, BufferRole role,
                              std::span<std::byte> out) const override;
    double guard_for(double error_bound) const override { return error.guard_for(error_bound); }

  private:
    double faces_per_disk() const { return 2.0 * mesh_.face_count() / full_; }

    const PreparedMesh& mesh_;
    SampleParams params_;
    std::uint32_t cells_; ///< Of all faces; 0 where each has one.
    double full_;         ///< Samples that a full surface holds, at least two: no disk covers
                          ///< more than all faces.
};

} // namespace geodisk
