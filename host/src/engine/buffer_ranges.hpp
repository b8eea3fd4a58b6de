// Checks of the buffers that callers lend.
#pragma once

#include <string>

#include <geodisk/device.hpp>
#include <geodisk/sampler.hpp>
#include <geodisk/status.hpp>

#include "engine/sampler_impl.hpp"

namespace geodisk {

/// Whether the device can bind a range of at least so many bytes, which its buffer has. Errors name
/// the range: `invalid_argument`, or `workspace_too_small`.
Result<Done> check_range(const BufferRange& range, const std::string& name, VkDeviceSize needed,
                         const Sampler::Impl& sampler);

/// Ranges of no bytes overlap nothing.
bool overlap(const BufferRange& a, const BufferRange& b);

/// What is wrong with a range that overlaps another.
Error overlap_error(const std::string& name, const std::string& other);

} // namespace geodisk
