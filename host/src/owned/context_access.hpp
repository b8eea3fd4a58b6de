// Context on a loader of the caller's choice: lets tests stand in for the loader and the drivers.
#pragma once

#include <vector>

#include <geodisk/context.hpp>

#include "owned/loader.hpp"

namespace geodisk {

struct ContextAccess {
    /// As Context::create.
    static Result<Context> create(Loader loader, const ContextOptions& options) noexcept;
    /// As list_devices.
    static Result<std::vector<DeviceReport>> list(Loader loader) noexcept;
};

} // namespace geodisk
