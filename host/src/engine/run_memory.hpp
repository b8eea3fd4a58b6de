// The memory of one run: its buffers, and the staging buffer through which the host reaches them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/runner_impl.hpp"

namespace geodisk {

/// Once a submission was given up, what it may still use is never freed.
class RunMemory {
  public:
    explicit RunMemory(Runner::Impl& runner) : runner_(runner) {}
    RunMemory(const RunMemory&) = delete;
    RunMemory& operator=(const RunMemory&) = delete;
    ~RunMemory();

    Result<Done> allocate(const WorkspaceNeeds& needs);
    Workspace workspace() const;
    BufferRange range(BufferRole role) const;
    /// Of all buffers and the staging.
    std::uint64_t bytes() const;

    Result<Done> upload(BufferRole role, std::span<const std::byte> bytes);
    Result<Done> read(BufferRole role, std::span<std::byte> bytes);
    /// Records that the staging gets the control record, for once the submission is done.
    void record_control(VkCommandBuffer commands) const;
    gpu::ControlRec control() const;

    /// A pool of at least so many bytes; it loses what it held.
    Result<Done> enlarge_pool(VkDeviceSize bytes);
    /// The buffers of samples, as Job::sample_bytes has them; the first `kept` samples stay.
    Result<Done> enlarge_samples(const std::array<VkDeviceSize, 3>& bytes, std::uint32_t kept);

  private:
    DeviceBuffer& buffer(BufferRole role) { return buffers_[static_cast<std::size_t>(role)]; }
    const DeviceBuffer& buffer(BufferRole role) const {
        return buffers_[static_cast<std::size_t>(role)];
    }

    Runner::Impl& runner_;
    std::array<DeviceBuffer, kBufferRoles> buffers_;
    DeviceBuffer staging_;
};

} // namespace geodisk
