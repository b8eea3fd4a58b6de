// How large buffers must be: what domains and plans share.
#pragma once

#include <array>
#include <cstdint>

#include <vulkan/vulkan_core.h>

#include <geodisk/device.hpp>
#include <geodisk/params.hpp>

namespace geodisk {

/// Candidates to make room for, where so many stages are drawn at once.
std::uint32_t capacity_for(const Stages& stages, std::uint32_t at_once) noexcept;

/// As many stages as so many candidates allow; at least one.
std::uint32_t stages_at_once(const Stages& stages, std::uint64_t most_candidates) noexcept;

/// Words of the buffer of states before the weights of a surface's candidates, see lib/states.glsl.
std::uint64_t state_words(std::uint32_t candidates) noexcept;

/// Ranges of orders by which samples are put in order, a power of two.
std::uint32_t bucket_count(std::uint32_t capacity) noexcept;

/// Bytes of samples, accepted and buckets.
std::array<VkDeviceSize, 3> sample_bytes(std::uint32_t capacity, std::uint32_t buckets) noexcept;

/// Invocations that a CPU runs at a time.
std::uint32_t cpu_lanes(const DeviceReport& report);

/// Not more samples than are asked for, or thrown, unless those are 0.
double samples_to_expect(double full, std::uint32_t throws, std::uint32_t stop_count) noexcept;

/// The least power of two that is not less, up to 2^25.
std::uint32_t pow2_at_least(double x);

} // namespace geodisk
