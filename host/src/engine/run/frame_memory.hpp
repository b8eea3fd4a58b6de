// FrameMemory: buffers, job and samples of one attempt of a FrameSampler.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <geodisk/frame_sampler.hpp>
#include <geodisk/placement.hpp>
#include <geodisk/sampler.hpp>

#include "engine/run/frame_buffers.hpp"
#include "records.h"
#include "vk/buffer.hpp"

namespace geodisk {

/// Vertices and faces of all surfaces, in the form that Placement reads.
struct FrameMesh {
    std::vector<float> positions;       ///< Three floats per vertex.
    std::vector<std::uint32_t> indices; ///< Three indices per face.

    /// Copies the meshes. Errors: `invalid_argument` for a mesh that does not fit the domain.
    static Result<FrameMesh> copy(const Domain& domain, std::span<const MeshView> meshes);
};

/// Not movable, since the job's commands refer to it. Destroy it when none of them is pending.
class FrameMemory {
  public:
    /// Allocates the memory of the plan and stages all uploads. Errors: those of
    /// FrameSampler::create().
    static Result<std::unique_ptr<FrameMemory>> create(const Sampler& sampler, const Domain& domain,
                                                       const FrameMesh& mesh, const RunPlan& plan,
                                                       const FrameSamplerOptions& options);

    Job& job() { return *job_; }
    const Placement& placement() const { return *placement_; }
    const RunPlan& plan() const { return plan_; }
    /// Returns handles, offsets and capacity, without the progress of the run.
    FrameSamples samples() const;
    std::uint64_t device_bytes() const { return buffer_.size(); }

    /// Records the uploads, once.
    void record_upload(const DeviceTable& vk, VkCommandBuffer commands);
    /// Frees the staging memory, after the uploads have completed.
    void free_staging() { uploads_.free(); }

    /// Records a copy of the control record to the host, to place `turn`, 0 to `frames` - 1.
    void record_control(const DeviceTable& vk, VkCommandBuffer commands, std::uint32_t turn) const;
    gpu::ControlRec control(std::uint32_t turn) const;

  private:
    Result<Done> allocate(const Sampler& sampler, const Domain& domain, const FrameMesh& mesh,
                          const FrameSamplerOptions& options);
    Result<Done> stage(const Sampler& sampler, const Domain& domain, const FrameMesh& mesh);
    BufferRange range(VkDeviceSize offset, VkDeviceSize bytes) const {
        return {buffer_.handle(), offset, bytes};
    }

    DeviceBuffer buffer_, controls_;
    FrameUploads uploads_;
    WorkspaceLayout layout_;
    VkDeviceSize vertices_ = 0, indices_ = 0, placed_ = 0, arguments_ = 0; ///< Offsets.
    RunPlan plan_;
    // Declared last: destroyed before the buffers.
    std::optional<Job> job_;
    std::optional<Placement> placement_;
};

} // namespace geodisk
