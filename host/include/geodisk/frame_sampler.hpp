// FrameSampler: samples a surface in the frames of an engine and keeps the samples in one buffer to
// draw from.
//
// It combines Sampler, Job and Placement. It allocates one buffer for everything that stays on the
// device, records a bounded amount of work into the caller's command buffers, and returns where the
// samples are. Use Sampler instead for full control over memory and the order of work.
// Experimental.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <vulkan/vulkan_core.h>

#include <geodisk/domain.hpp>
#include <geodisk/export.hpp>
#include <geodisk/mesh_view.hpp>
#include <geodisk/request.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/sampler.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// How a FrameSampler divides its work and who reads its samples.
struct FrameSamplerOptions {
    /// Memory for disks in progress, in bytes. With more memory, a wide device computes more disks
    /// at once.
    std::uint64_t pool_bytes = std::uint64_t{16} << 20;
    /// Maximum of command buffers in flight, 1 to 16, including the one that record() is called
    /// for.
    std::uint32_t frames = 2;
    /// Maximum of dispatches that one record() uses to draw candidates. More dispatches make a
    /// frame longer and the run shorter.
    std::uint32_t dispatches = 16;
    /// Rounds that one record() uses to decide candidates.
    std::uint32_t rounds = 2;
    /// Vertices per instance of the indirect draw.
    std::uint32_t vertices_each = 1;
    /// Stages and accesses of the caller's commands that read the samples, on the same queue.
    /// record() waits for such commands before it, and makes the samples visible to those after it.
    /// A queue without graphics has no vertex stages.
    SyncScope readers{VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT |
                          VK_PIPELINE_STAGE_TRANSFER_BIT,
                      VK_ACCESS_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_SHADER_READ_BIT |
                          VK_ACCESS_TRANSFER_READ_BIT};
};

/// Location of the samples on the device.
struct FrameSamples {
    /// Buffer with the usage of kWorkspaceUsage and of a vertex buffer.
    VkBuffer buffer = VK_NULL_HANDLE;
    /// First byte of the records, one gpu::PlacedRec per sample in dart order.
    VkDeviceSize placed_offset = 0;
    /// Number of records that fit.
    std::uint32_t capacity = 0;
    /// First byte of a VkDrawIndirectCommand with one instance per sample. Its second word is the
    /// number of samples that the device has.
    VkDeviceSize arguments_offset = 0;
    /// Number of samples that are in order and final, as far as the host knows. The device may have
    /// more.
    std::uint32_t ready = 0;
    /// True if these are all samples.
    bool is_complete = false;
};

/// Samples a domain over as many frames as it takes.
///
/// Movable. Use it in one thread at a time. The sampler's device must outlive it. Destroy it only
/// when no command buffer that it recorded into is pending.
class GEODISK_API FrameSampler {
  public:
    /// Allocates all memory, through DeviceRefs::memory_hooks if set, and records nothing.
    ///
    /// The samples are those that the requests ask for, all in one run. Meshes and requests, with
    /// what they refer to, must outlive the sampling. `view` of each request must have 2 or 3
    /// coordinates per vertex. It is copied.
    ///
    /// Errors: `invalid_argument` for a request that takes several runs, naming the field; for
    /// requests that cannot share a run; for a request without `view`, or options out of range;
    /// `workspace_too_small` if pool_bytes holds no disk; those of RequestRuns,
    /// Sampler::workspace_needs(), Sampler::prepare() and Vulkan.
    static Result<FrameSampler> create(std::shared_ptr<const Sampler> sampler,
                                       std::span<const MeshRequest> requests,
                                       const FrameSamplerOptions& options = {}) noexcept;

    /// Creates a FrameSampler for a domain made otherwise.
    ///
    /// `domain` comes from Domain::surface() or surfaces() and must outlive the sampling. `meshes`
    /// has the mesh that each surface was prepared from, with 2 or 3 coordinates per vertex. It is
    /// copied. Positions on a surface with a scale are in units of its mesh.
    ///
    /// Errors: `invalid_argument` for other domains, meshes that do not match the domain, or
    /// options out of range; the rest as above.
    static Result<FrameSampler> create(std::shared_ptr<const Sampler> sampler, const Domain& domain,
                                       std::span<const MeshView> meshes,
                                       const FrameSamplerOptions& options = {}) noexcept;
    FrameSampler(FrameSampler&&) noexcept;
    FrameSampler& operator=(FrameSampler&&) noexcept;
    ~FrameSampler();

    /// Records the next part of the work. Returns true when all samples are complete; it then
    /// records nothing. The command buffer must be in the recording state, outside a render pass,
    /// on a queue family with compute. Submit command buffers in the order of the calls, to one
    /// queue.
    ///
    /// Call it only when the command buffer recorded FrameSamplerOptions::frames calls ago has
    /// completed. Changes the compute pipeline, descriptor set 0 and the push constants.
    ///
    /// If disks or samples outgrow the buffer, a larger one replaces it and sampling restarts. Call
    /// samples() again after each record(). The old buffer is freed when no frame uses it.
    ///
    /// Errors: `mesh_rejected`, `internal` and `job_too_large` as Job::advance(); out of memory;
    /// those of Vulkan. After an error, destroy the object.
    Result<bool> record(VkCommandBuffer commands) noexcept;

    /// Records and submits on the runner's queue, and waits until all samples are complete. No
    /// command buffer that record() was called for may be pending, and no run of the runner in
    /// progress. `progress` may return false to stop; a later call continues.
    ///
    /// Errors: those of record(); `cancelled`; `device_lost`.
    Result<Done> sample_and_wait(Runner& runner, const ProgressCallback& progress = {}) noexcept;

    /// Returns where the samples are. Valid until the next call of record(), sample_and_wait() or
    /// set_seed().
    FrameSamples samples() const noexcept;

    /// Restarts with another seed. The mesh stays on the device.
    void set_seed(std::uint64_t seed) noexcept;

    /// Returns the bytes allocated on the device.
    std::uint64_t device_bytes() const noexcept;

    struct Impl; ///< Internal.

  private:
    explicit FrameSampler(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

} // namespace geodisk
