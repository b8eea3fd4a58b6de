// Abilities that tests may ask of the device that they run on, whichever it is.
#pragma once

#include <vector>

#include <geodisk/device.hpp>
#include <geodisk/sampler.hpp>

namespace geodisk::test {

/// Reads::storage, and Reads::texels where the device's texel buffers reach as far.
std::vector<Reads> reads_of(const DeviceReport& report);

/// Rounding::emulated, and Rounding::native where the device is known to round correctly.
std::vector<Rounding> roundings_of(const DeviceReport& report);

/// Returns false for SwiftShader, which does not end compiling group_detect.
bool compiles_groups(const DeviceReport& report);

/// For tests of what only Mesa's lavapipe does; others need not ask.
bool is_lavapipe(const DeviceReport& report);

} // namespace geodisk::test
