// Surfaces with geodesic distances, as a run takes them.
#pragma once

#include "engine/run_source.hpp"

namespace geodisk {

/// A mesh and what is asked of it; all must outlive the source.
class SurfaceSource : public RunSource {
  public:
    SurfaceSource(const Sampler& sampler, const PreparedMesh& mesh, const SampleParams& params)
        : sampler_(sampler), mesh_(mesh), params_(params), stages_(stages_of(mesh, params)) {}

    const Stages& stages() const override { return stages_; }
    std::uint64_t bytes_per_candidate() const override { return 16; }
    std::uint32_t stop_count() const override { return params_.stop_count; }
    Result<RunPlan> plan(std::uint64_t pool_bytes) const override {
        return sampler_.plan_run(mesh_, params_, pool_bytes);
    }
    Result<WorkspaceNeeds> needs(const RunPlan& plan) const override {
        return sampler_.workspace_needs(mesh_, params_, plan);
    }
    Result<Job> make_job(const RunPlan& plan, const Workspace& workspace) const override {
        return sampler_.make_job(mesh_, params_, plan, workspace);
    }
    Result<std::vector<std::byte>> bytes(BufferRole role) const override {
        std::vector<std::byte> bytes(sampler_.mesh_bytes_size(mesh_, params_, role));
        if (!bytes.empty()) {
            if (auto written = sampler_.mesh_bytes(mesh_, params_, role, bytes); !written) {
                return written.error();
            }
        }
        return bytes;
    }
    double guard(const RunPlan& plan) const override {
        return tolerances_for(mesh_, params_, plan.chain).guard;
    }

  private:
    const Sampler& sampler_;
    const PreparedMesh& mesh_;
    const SampleParams& params_;
    Stages stages_;
};

} // namespace geodisk
