// Placement: writes the samples of a job into the caller's buffers to draw from, without the host.
// Experimental.
#pragma once

#include <cstdint>
#include <memory>

#include <vulkan/vulkan_core.h>

#include <geodisk/domain.hpp>
#include <geodisk/export.hpp>
#include <geodisk/sampler.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// The caller's vertex and index buffers of the sampled surfaces: storage buffers, aligned as in
/// BufferRange. Strides and offsets are in bytes, multiples of 4.
struct PlacementSource {
    static constexpr std::uint32_t kNoNormals = 0xffffffff;

    BufferRange vertices;       ///< Vertices with three floats of position each.
    std::uint32_t stride = 12;  ///< Distance from vertex to vertex.
    std::uint32_t position = 0; ///< Offset of the position in a vertex.
    /// Offset of the three floats of a normal in a vertex, or kNoNormals for normals of faces.
    std::uint32_t normal = kNoNormals;
    /// Three indices into `vertices` per face, in the order of the domain; those of several
    /// surfaces follow each other.
    BufferRange indices;
    std::uint32_t index_bytes = 4; ///< 2 or 4.
};

/// Destination of the samples. Ranges are aligned likewise and hold nothing else.
struct PlacementTarget {
    BufferRange placed; ///< A gpu::PlacedRec per sample, RunPlan::sample_capacity of them.
    /// 16 bytes for a VkDrawIndirectCommand with `vertices_each` vertices and an instance per
    /// sample. Its second word is the number of samples.
    BufferRange arguments;
    std::uint32_t vertices_each = 1;
};

/// Belongs to one job and its buffers. Movable. The Sampler must outlive it. The job's buffers must
/// exist while its commands run.
class GEODISK_API Placement {
  public:
    /// Makes a placement and records nothing. Errors: `invalid_argument` for a domain that is not a
    /// surface by geodesic distance, impossible strides, offsets or index sizes, and ranges that
    /// are null, not aligned or overlap; `workspace_too_small` for a range with fewer vertices than
    /// the mesh (none for several surfaces), indices than its faces, or samples than the plan;
    /// those of Vulkan.
    static Result<Placement> create(const Sampler& sampler, const Domain& domain, const Job& job,
                                    const PlacementSource& source,
                                    const PlacementTarget& target) noexcept;
    Placement(Placement&&) noexcept;
    Placement& operator=(Placement&&) noexcept;
    ~Placement();

    /// Records the placement of the samples that are in order so far (ControlRec::ready). Call it
    /// after Sampler::record_finish(), for the same command buffer or a later one. Coordinates are
    /// the same on all devices. Begins with a barrier after the job's commands; wait for
    /// Sampler::kLastUse before `placed` and `arguments` are used. Errors: `invalid_argument` for
    /// another job, or one that was renewed or has other buffers now.
    Result<Done> record(VkCommandBuffer commands, const Job& job) const noexcept;

    struct Impl; ///< Internal.

  private:
    explicit Placement(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

} // namespace geodisk
