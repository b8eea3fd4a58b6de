// RunMemory: buffers of runs, and the staging buffer for the host. Kept from run to run.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/job/sampler_impl.hpp"
#include "engine/run/submitter.hpp"
#include "engine/run/task.hpp"
#include "records.h"
#include "vk/buffer.hpp"

namespace geodisk {

/// After a submission is given up, memory that it may still use is never freed. Everything that
/// RunMemory is made of must outlive it.
class RunMemory {
  public:
    RunMemory(const Sampler::Impl& sampler, Submitter& submitter,
              const VkPhysicalDeviceMemoryProperties& memory)
        : sampler_(sampler), submitter_(submitter), memory_(memory) {}
    RunMemory(const RunMemory&) = delete;
    RunMemory& operator=(const RunMemory&) = delete;
    ~RunMemory();

    /// Returns the bytes of the staging, for uploads of this size.
    static std::uint64_t staging_bytes(std::uint64_t upload_bytes);

    /// Allocates buffers for the needs, reusing those that are large enough, and staging for
    /// uploads of this many bytes, if that is not too much. Frees all other buffers first if memory
    /// is short, or if larger old ones would exceed `most` bytes.
    Result<Done> allocate(const WorkspaceNeeds& needs, std::uint64_t upload_bytes,
                          std::uint64_t most);
    Workspace workspace() const;
    BufferRange range(BufferRole role) const;
    /// Returns the bytes of all buffers and the staging.
    std::uint64_t bytes() const;
    /// Returns the number of buffers made so far. If it has changed, old descriptors are stale.
    std::uint32_t made() const { return made_; }
    /// Returns true if memory was short for a buffer.
    bool was_short() const { return was_short_; }

    /// Returns true if a buffer holds the data of these meshes, by PreparedMesh::identity().
    bool holds(BufferRole role, const std::vector<std::uint64_t>& meshes) const;
    /// Notes that a buffer holds the data of these meshes, now or after the next record_uploads.
    void set_held(BufferRole role, const std::vector<std::uint64_t>& meshes);
    /// Returns the bytes that stage() has room for.
    std::size_t room() const { return stage_bytes_ - staged_; }
    /// Returns where to write data to upload from a byte of the buffer on; there must be room. The
    /// next record_uploads uploads it.
    std::span<std::byte> stage(BufferRole role, VkDeviceSize to, std::size_t size);
    /// Records the upload of what is staged. Where the uploads of a run do not fit the staging,
    /// stage() then fills its other half, and this submission must end before the next but one.
    void record_uploads(VkCommandBuffer commands);
    /// Uploads data at once, in as many parts as necessary.
    Task<Result<Done>> upload(BufferRole role, VkDeviceSize to, std::span<const std::byte> bytes);

    /// Records a copy of the control record to the host.
    void record_control(VkCommandBuffer commands) const;
    gpu::ControlRec control() const;
    /// Records a copy of this many bytes of the samples to the host, unless they are too many.
    void record_samples(VkCommandBuffer commands, VkDeviceSize bytes);
    /// Returns the samples read since the last record_uploads.
    std::span<const std::byte> samples() const;
    /// Reads bytes of a buffer, from byte `from` on.
    Task<Result<Done>> read(BufferRole role, std::span<std::byte> bytes, VkDeviceSize from = 0);

    /// Replaces the pool by one of at least this many bytes; its contents are lost.
    Result<Done> enlarge_pool(VkDeviceSize bytes);
    /// Replaces the buffers of samples by ones with these sizes, see Job::sample_bytes; the first
    /// `kept` samples stay. They are copied through the host if old and new buffers together would
    /// exceed `most` bytes.
    Task<Result<Done>> enlarge_samples(std::array<VkDeviceSize, 3> bytes, std::uint32_t kept,
                                       std::uint64_t most);

  private:
    struct Upload {
        BufferRole role;
        VkDeviceSize from, to, size;
    };

    Result<DeviceBuffer> create(const char* name, VkDeviceSize bytes,
                                VkBufferUsageFlags usage = kWorkspaceUsage,
                                MemoryKind kind = MemoryKind::device);
    Result<Done> reserve(const WorkspaceNeeds& needs, VkDeviceSize staging_bytes);
    void free_all();
    /// Returns the total bytes with these needs and staging.
    std::uint64_t bytes_with(const WorkspaceNeeds& needs, VkDeviceSize staging_bytes) const;
    Result<Done> reserve_staging(VkDeviceSize bytes);
    DeviceBuffer& buffer(BufferRole role) { return buffers_[static_cast<std::size_t>(role)]; }
    const DeviceBuffer& buffer(BufferRole role) const {
        return buffers_[static_cast<std::size_t>(role)];
    }

    const Sampler::Impl& sampler_;
    Submitter& submitter_;
    const VkPhysicalDeviceMemoryProperties& memory_;
    std::array<DeviceBuffer, kBufferRoles> buffers_;
    std::array<std::vector<std::uint64_t>, kBufferRoles> held_; ///< Meshes whose data each buffer
                                                                ///< holds.
    DeviceBuffer staging_; ///< The control record, then uploads or samples.
    std::vector<Upload> uploads_;
    VkDeviceSize stage_begin_ = 0, stage_bytes_ = 0; ///< Part of the staging that stage() fills.
    VkDeviceSize staged_ = 0;                        ///< Bytes in it.
    VkDeviceSize samples_ = 0;                       ///< Bytes of samples that were read.
    std::uint32_t made_ = 0;
    bool was_short_ = false;
};

} // namespace geodisk
