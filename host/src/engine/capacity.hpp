// Sizes of buffers that domains and plans share.
#pragma once

#include <array>
#include <cstdint>

#include <vulkan/vulkan_core.h>

#include <geodisk/device.hpp>
#include <geodisk/params.hpp>

namespace geodisk {

/// Returns the number of candidates to allocate for, if this many stages are drawn at once.
std::uint32_t capacity_for(const Stages& stages, std::uint32_t at_once) noexcept;

/// Returns the number of stages that fit this many candidates; at least one.
std::uint32_t stages_at_once(const Stages& stages, std::uint64_t max_candidates) noexcept;

/// Returns the words of states in the orders buffer, behind the orders; see lib/states.glsl.
std::uint64_t state_words(std::uint32_t candidates) noexcept;

/// Returns the number of ranges of orders by which samples are sorted, a power of two.
std::uint32_t bucket_count(std::uint32_t capacity) noexcept;

/// Returns the bytes of the buffers samples, accepted and buckets.
std::array<VkDeviceSize, 3> sample_bytes(std::uint32_t capacity, std::uint32_t buckets) noexcept;

/// Returns the number of threads that a CPU runs at the same time.
std::uint32_t cpu_threads() noexcept;

/// Returns the number of invocations that a CPU runs at the same time.
std::uint32_t cpu_lanes(const DeviceReport& report);

/// Returns `full`, limited by the number of darts and the stop count unless they are 0.
double samples_to_expect(double full, std::uint32_t darts, std::uint32_t stop_count) noexcept;

/// Returns the smallest power of two of at least x, up to 2^25.
std::uint32_t pow2_at_least(double x);

} // namespace geodisk
