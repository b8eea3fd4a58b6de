// Context with a given loader: lets tests replace the loader and the drivers.
#pragma once

#include <vector>

#include <geodisk/context.hpp>

#include "owned/loader.hpp"

namespace geodisk {

struct ContextAccess {
    /// Creates a Context, as Context::create.
    static Result<Context> create(Loader loader, const ContextOptions& options) noexcept;
    /// Lists devices, as list_devices.
    static Result<std::vector<DeviceReport>> list(Loader loader) noexcept;
};

} // namespace geodisk
