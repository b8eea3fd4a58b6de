// Samplers of the C API.
#pragma once

#include <atomic>
#include <memory>
#include <optional>

#include <geodisk/geodisk.h>
#include <geodisk/runner.hpp>

#include "c/c_device.hpp"
#include "c/c_domain.hpp"

namespace geodisk::c {

struct SamplerState {
    SamplerState(std::shared_ptr<const Device> on, Runner made)
        : device(std::move(on)), runner(std::move(made)) {}

    std::shared_ptr<const Device> device;
    Runner runner;
    std::atomic<bool> is_held = false; ///< True while a call uses it.
    std::atomic<bool> is_cancelled = false;
    std::shared_ptr<const DomainState> running; ///< Domain of the run in progress, if one was
                                                ///< started.
};

} // namespace geodisk::c

struct geodisk_sampler {
    std::shared_ptr<geodisk::c::SamplerState> shared;
};
