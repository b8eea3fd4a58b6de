// Checks of buffers that callers provide.
#pragma once

#include <string>

#include <geodisk/device.hpp>
#include <geodisk/sampler.hpp>
#include <geodisk/status.hpp>

#include "engine/job/sampler_impl.hpp"

namespace geodisk {

/// Returns the alignment of offsets of ranges that are bound as storage, texel or uniform buffers.
VkDeviceSize range_alignment(const DeviceLimits& limits);

/// Cuts one buffer into ranges, from its start.
class RangeCutter {
  public:
    explicit RangeCutter(VkDeviceSize alignment) : alignment_(alignment) {}

    /// Returns the offset of the next range of this size.
    VkDeviceSize cut(VkDeviceSize bytes);
    /// Returns the size of the buffer so far.
    VkDeviceSize end() const { return end_; }

  private:
    VkDeviceSize alignment_;
    VkDeviceSize end_ = 0;
};

/// Checks that the device can bind a range of at least this many bytes, and that the buffer has
/// them. Errors name the range: `invalid_argument` or `workspace_too_small`.
Result<Done> check_range(const BufferRange& range, const std::string& name, VkDeviceSize needed,
                         const Sampler::Impl& sampler);

/// Returns true if two ranges overlap. Empty ranges overlap nothing.
bool overlap(const BufferRange& a, const BufferRange& b);

/// Makes the error for a range that overlaps another.
Error overlap_error(const std::string& name, const std::string& other);

} // namespace geodisk
