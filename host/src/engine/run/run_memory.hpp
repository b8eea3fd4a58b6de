// The memory of runs: their buffers, and the staging buffer through which the host reaches them. It
// is kept from run to run.
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

/// Once a submission was given up, what it may still use is never freed. All that it is made of
/// must outlive it.
class RunMemory {
  public:
    RunMemory(const Sampler::Impl& sampler, Submitter& submitter,
              const VkPhysicalDeviceMemoryProperties& memory)
        : sampler_(sampler), submitter_(submitter), memory_(memory) {}
    RunMemory(const RunMemory&) = delete;
    RunMemory& operator=(const RunMemory&) = delete;
    ~RunMemory();

    /// Of the staging, for uploads of so many bytes.
    static std::uint64_t staging_bytes(std::uint64_t upload_bytes);

    /// Buffers for the needs, those there are where they are large enough, and for uploads of so
    /// many bytes at once, if that is not too much. Where memory is short, or larger ones of before
    /// would make it more than `most` bytes, all others are freed before.
    Result<Done> allocate(const WorkspaceNeeds& needs, std::uint64_t upload_bytes,
                          std::uint64_t most);
    Workspace workspace() const;
    BufferRange range(BufferRole role) const;
    /// Of all buffers and the staging.
    std::uint64_t bytes() const;
    /// Counts the buffers made so far: descriptors of before are stale where it has changed.
    std::uint32_t made() const { return made_; }
    /// Whether memory was short for one.
    bool was_short() const { return was_short_; }

    /// Whether a buffer holds what follows from these meshes, by PreparedMesh::identity(); and says
    /// that it does, now or with the next record_uploads.
    bool holds(BufferRole role, const std::vector<std::uint64_t>& meshes) const;
    void set_held(BufferRole role, const std::vector<std::uint64_t>& meshes);
    /// Where to write what is to be uploaded from a byte of the buffer on; empty where there is no
    /// room. It is up to the next record_uploads to do so.
    std::span<std::byte> stage(BufferRole role, VkDeviceSize to, std::size_t size);
    void record_uploads(VkCommandBuffer commands);
    /// In as many parts as it takes, at once.
    Task<Result<Done>> upload(BufferRole role, VkDeviceSize to, std::span<const std::byte> bytes);

    /// Records that the host gets the control record.
    void record_control(VkCommandBuffer commands) const;
    gpu::ControlRec control() const;
    /// Records that it gets so many bytes of the samples, unless they are too many.
    void record_samples(VkCommandBuffer commands, VkDeviceSize bytes);
    /// What it got since the last record_uploads.
    std::span<const std::byte> samples() const;
    Task<Result<Done>> read(BufferRole role, std::span<std::byte> bytes);

    /// A pool of at least so many bytes; it loses what it held.
    Result<Done> enlarge_pool(VkDeviceSize bytes);
    /// The buffers of samples, as Job::sample_bytes has them; the first `kept` samples stay. They
    /// go by way of the host where old and new ones together would make it more than `most` bytes.
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
    /// That it would be once there is so much.
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
    std::array<std::vector<std::uint64_t>, kBufferRoles> held_; ///< Meshes.
    DeviceBuffer staging_; ///< The control record, then whatever comes or goes.
    std::vector<Upload> uploads_;
    VkDeviceSize staged_ = 0;
    VkDeviceSize samples_ = 0; ///< Bytes of them that were read.
    std::uint32_t made_ = 0;
    bool was_short_ = false;
};

} // namespace geodisk
