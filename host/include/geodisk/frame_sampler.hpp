// FrameSampler: samples a surface in the frames of an engine and keeps the samples in one buffer to
// draw from.
//
// It is Sampler, Job and Placement in one object. It allocates one buffer for all that stays on the
// device, records a bounded amount of work into the caller's command buffers, and hands out where
// the samples lie. Use Sampler instead for full control over memory and the order of work.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <vulkan/vulkan_core.h>

#include <geodisk/domain.hpp>
#include <geodisk/export.hpp>
#include <geodisk/mesh_view.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/sampler.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// How a FrameSampler divides its work and who reads its samples.
struct FrameSamplerOptions {
    /// Memory for disks in progress, in bytes. More lets a wide device work on more disks.
    std::uint64_t pool_bytes = std::uint64_t{16} << 20;
    /// Frames in flight: record() may be called while this many command buffers recorded before are
    /// still pending, less one. From 1 to 16.
    std::uint32_t frames = 2;
    /// Most dispatches that one record() takes to draw candidates. More of them make a frame longer
    /// and the run shorter.
    std::uint32_t dispatches = 16;
    /// Rounds that one record() takes to decide candidates.
    std::uint32_t rounds = 2;
    /// Vertices of each instance of the indirect draw.
    std::uint32_t vertices_each = 1;
    /// Stages and accesses of the caller's commands that read the samples, on the same queue.
    /// record() waits for the ones before it and makes the samples visible to the ones after it. A
    /// queue without graphics has no vertex stages.
    SyncScope readers{VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT |
                          VK_PIPELINE_STAGE_TRANSFER_BIT,
                      VK_ACCESS_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_SHADER_READ_BIT |
                          VK_ACCESS_TRANSFER_READ_BIT};
};

/// Where the samples lie on the device.
struct FrameSamples {
    /// Has the usage of kWorkspaceUsage, and that of a vertex buffer.
    VkBuffer buffer = VK_NULL_HANDLE;
    /// First byte of the records: a gpu::PlacedRec for each sample, in dart order.
    VkDeviceSize placed_offset = 0;
    /// Records that there is room for.
    std::uint32_t capacity = 0;
    /// First byte of a VkDrawIndirectCommand with an instance for each sample. Its second word is
    /// the number of samples, as the device knows it.
    VkDeviceSize arguments_offset = 0;
    /// Number of samples in order and final, as far as the host knows; the device may have more.
    std::uint32_t ready = 0;
    /// True if these are all samples.
    bool is_complete = false;
};

/// Samples a domain over as many frames as it takes.
///
/// Movable, for one thread at a time. The sampler's device must outlive it. Destroy it only when no
/// command buffer that it recorded into is pending.
class GEODISK_API FrameSampler {
  public:
    /// Allocates all memory, through DeviceRefs::memory_hooks if set, and records nothing.
    ///
    /// `domain` is made by Domain::surface() or surfaces() and must outlive the sampling. `meshes`
    /// has the mesh of each surface, as it was prepared, with 2 or 3 coordinates per vertex; it is
    /// copied. The samples of a surface with a scale are in units of its mesh.
    ///
    /// Errors: `invalid_argument` for other domains, meshes that do not match the domain, or
    /// options out of range; `workspace_too_small` when pool_bytes holds no disk; as
    /// Sampler::workspace_needs() and Sampler::prepare(); or as Vulkan fails.
    static Result<FrameSampler> create(std::shared_ptr<const Sampler> sampler, const Domain& domain,
                                       std::span<const MeshView> meshes,
                                       const FrameSamplerOptions& options = {}) noexcept;
    /// Does the same for the mesh of one surface.
    static Result<FrameSampler> create(std::shared_ptr<const Sampler> sampler, const Domain& domain,
                                       const MeshView& mesh,
                                       const FrameSamplerOptions& options = {}) noexcept;
    FrameSampler(FrameSampler&&) noexcept;
    FrameSampler& operator=(FrameSampler&&) noexcept;
    ~FrameSampler();

    /// Records the next part of the work and returns true when all samples are there; it records
    /// nothing then. The command buffer must be in the recording state, outside a render pass, on a
    /// queue family with compute. Submit command buffers in the order of the calls, to one queue.
    ///
    /// Call it only when the command buffer recorded FrameSamplerOptions::frames calls ago has
    /// completed. Leaves the compute pipeline, descriptor set 0 and the push constants changed.
    ///
    /// Where disks or samples outgrow the buffer, a larger one takes its place and sampling begins
    /// again: read samples() after each call. The old buffer is freed when no frame uses it.
    ///
    /// Errors: `mesh_rejected`, `internal` and `job_too_large` as Job::advance(); out of memory; or
    /// as Vulkan fails. After an error, destroy the object.
    Result<bool> record(VkCommandBuffer commands) noexcept;

    /// Records, submits on the runner's queue and waits until all samples are there. No command
    /// buffer that record() was called for may be pending, and no run of the runner in progress.
    /// `progress` may stop it by returning false; it can go on later.
    ///
    /// Errors: as record(); `cancelled`; `device_lost`.
    Result<Done> sample_and_wait(Runner& runner, const ProgressCallback& progress = {}) noexcept;

    /// Returns where the samples are. Valid until the next call of record(), sample_and_wait() or
    /// set_seed().
    FrameSamples samples() const noexcept;

    /// Begins again with another seed. The mesh stays where it is.
    void set_seed(std::uint64_t seed) noexcept;

    /// Bytes allocated on the device.
    std::uint64_t device_bytes() const noexcept;

    struct Impl; ///< Internal.

  private:
    explicit FrameSampler(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

} // namespace geodisk
