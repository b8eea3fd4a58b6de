// What a sampler is built for, by the type and limits of its device.
#pragma once

#include <geodisk/sampler.hpp>

namespace geodisk {

/// `wanted` with all that it leaves open chosen. Errors as Sampler::create.
Result<Tuning> chosen_tuning(const Tuning& wanted, const DeviceReport& report);

} // namespace geodisk
