// Bounds on the part of a disk that one dispatch of detect may compute.
#pragma once

#include <cstdint>

#include <geodisk/device.hpp>

#include "engine/kernels/kernel_table.hpp"

namespace geodisk {

/// Returns the maximum of steps that one dispatch of detect may safely take. llvmpipe ends long
/// loops silently, and other devices have watchdogs.
std::uint32_t max_steps(const DeviceReport& report, const KernelVariant& variant) noexcept;

} // namespace geodisk
