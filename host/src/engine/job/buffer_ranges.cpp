#include "engine/job/buffer_ranges.hpp"

#include <algorithm>

namespace geodisk {
namespace {

Error range_error(Status status, const std::string& name, const std::string& what) {
    return Error{status, "the buffer range " + name + ' ' + what};
}

} // namespace

VkDeviceSize range_alignment(const DeviceLimits& limits) {
    return std::max<VkDeviceSize>({limits.min_storage_buffer_offset_alignment,
                                   limits.min_texel_buffer_offset_alignment,
                                   limits.min_uniform_buffer_offset_alignment, 1});
}

VkDeviceSize RangeCutter::cut(VkDeviceSize bytes) {
    const VkDeviceSize start = (end_ + alignment_ - 1) / alignment_ * alignment_;
    end_ = start + bytes;
    return start;
}

Result<Done> check_range(const BufferRange& range, const std::string& name, VkDeviceSize needed,
                         const Sampler::Impl& sampler) {
    const DeviceLimits& limits = sampler.report.limits;
    if (range.buffer == VK_NULL_HANDLE) {
        return range_error(Status::invalid_argument, name, "is null");
    }
    if (range.size < needed) {
        return range_error(Status::workspace_too_small, name,
                           "has " + std::to_string(range.size) + " bytes and needs " +
                               std::to_string(needed));
    }
    if (range.size > limits.max_storage_buffer_range) {
        return range_error(Status::invalid_argument, name,
                           "has " + std::to_string(range.size) +
                               " bytes, but the device binds at "
                               "most " +
                               std::to_string(limits.max_storage_buffer_range));
    }
    const VkDeviceSize alignment = range_alignment(limits);
    if (range.offset % alignment != 0) {
        return range_error(Status::invalid_argument, name,
                           "starts at " + std::to_string(range.offset) +
                               ", off the device's alignment of " + std::to_string(alignment));
    }
    // The size is at least that of the buffer, and hardly more.
    VkMemoryRequirements requirements{};
    sampler.vk.vkGetBufferMemoryRequirements(sampler.device.device, range.buffer, &requirements);
    if (range.offset > requirements.size || range.size > requirements.size - range.offset) {
        return range_error(Status::invalid_argument, name,
                           "of " + std::to_string(range.size) + " bytes starts at " +
                               std::to_string(range.offset) + " and ends behind its VkBuffer of " +
                               std::to_string(requirements.size));
    }
    return Done{};
}

bool overlap(const BufferRange& a, const BufferRange& b) {
    return a.buffer == b.buffer && a.size > 0 && b.size > 0 && a.offset < b.offset + b.size &&
           b.offset < a.offset + a.size;
}

Error overlap_error(const std::string& name, const std::string& other) {
    return range_error(Status::invalid_argument, name, "overlaps the range " + other);
}

} // namespace geodisk
