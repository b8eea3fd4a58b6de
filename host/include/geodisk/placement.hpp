// Placement: the samples of a job where a caller draws them, without a way through the host.
#pragma once

#include <cstdint>
#include <memory>

#include <vulkan/vulkan_core.h>

#include <geodisk/domain.hpp>
#include <geodisk/export.hpp>
#include <geodisk/sampler.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// The caller's vertex and index buffers of what is sampled, as it draws them: storage buffers,
/// ranges aligned as BufferRange asks. Strides and offsets are in bytes, multiples of 4.
struct PlacementSource {
    static constexpr std::uint32_t kNoNormals = 0xffffffff;

    BufferRange vertices;       ///< With three floats of a position for each vertex.
    std::uint32_t stride = 12;  ///< From vertex to vertex.
    std::uint32_t position = 0; ///< Where a vertex has its position.
    std::uint32_t normal =
        kNoNormals; ///< Three floats of a normal; else normals are those of faces.
    /// Three for each face, in the order that the domain has them in: of several surfaces those of
    /// each follow those of the one before, and name vertices of `vertices`.
    BufferRange indices;
    std::uint32_t index_bytes = 4; ///< 2 or 4.
};

/// Where the samples go. Ranges as above, and of nothing else.
struct PlacementTarget {
    BufferRange placed; ///< gpu::PlacedRec of each sample, RunPlan::sample_capacity of them.
    /// 16 bytes: VkDrawIndirectCommand with `vertices_each` vertices and an instance per sample, so
    /// the second word is how many there are.
    BufferRange arguments;
    std::uint32_t vertices_each = 1;
};

/// Of one job and its buffers. Movable. The Sampler must outlive it, and the job's buffers must be
/// there while its commands run.
class GEODISK_API Placement {
  public:
    /// Errors: `invalid_argument` for a domain that is no surface with geodesic distance, strides,
    /// offsets or index sizes that cannot be, and ranges that are null, off alignment or overlap;
    /// `workspace_too_small` for one that holds fewer vertices than the mesh (of several surfaces,
    /// none), indices than its faces have, or samples than the plan; as Vulkan fails.
    static Result<Placement> create(const Sampler& sampler, const Domain& domain, const Job& job,
                                    const PlacementSource& source,
                                    const PlacementTarget& target) noexcept;
    Placement(Placement&&) noexcept;
    Placement& operator=(Placement&&) noexcept;
    ~Placement();

    /// Records that the samples in order so far (ControlRec::ready) are placed: after
    /// record_finish, in the same command buffer or a later one. Coordinates are rounded alike on
    /// all devices. Begins with a barrier behind what the job has recorded; Sampler::kLastUse has
    /// the access to wait for before `placed` and `arguments` are used. Errors: `invalid_argument`
    /// for another job, or one that has other buffers by now or was renewed.
    Result<Done> record(VkCommandBuffer commands, const Job& job) const noexcept;

    struct Impl; ///< Internal.

  private:
    explicit Placement(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

} // namespace geodisk
