// Checks of the buffers that callers lend.
#pragma once

#include <string>

#include <geodisk/device.hpp>
#include <geodisk/sampler.hpp>
#include <geodisk/status.hpp>

#include "engine/job/sampler_impl.hpp"

namespace geodisk {

/// What offsets of ranges must be a multiple of, to be bound as storage and texel buffers.
VkDeviceSize range_alignment(const DeviceLimits& limits);

/// Cuts one buffer into ranges, from its start on.
class RangeCutter {
  public:
    explicit RangeCutter(VkDeviceSize alignment) : alignment_(alignment) {}

    /// Returns the offset of the next range, of so many bytes.
    VkDeviceSize cut(VkDeviceSize bytes);
    /// Size of the buffer so far.
    VkDeviceSize end() const { return end_; }

  private:
    VkDeviceSize alignment_;
    VkDeviceSize end_ = 0;
};

/// Whether the device can bind a range of at least so many bytes, which its buffer has. Errors name
/// the range: `invalid_argument`, or `workspace_too_small`.
Result<Done> check_range(const BufferRange& range, const std::string& name, VkDeviceSize needed,
                         const Sampler::Impl& sampler);

/// Ranges of no bytes overlap nothing.
bool overlap(const BufferRange& a, const BufferRange& b);

/// What is wrong with a range that overlaps another.
Error overlap_error(const std::string& name, const std::string& other);

} // namespace geodisk
