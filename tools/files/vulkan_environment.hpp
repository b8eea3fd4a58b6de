// Settings of the environment for Vulkan devices and drivers. The library itself never reads it.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/device.hpp>
#include <geodisk/status.hpp>

#include "program/failure.hpp"

namespace geodisk::tools {

/// The variable that chooses a device where no option does.
inline constexpr const char* kDeviceVariable = "GEODISK_DEVICE";

/// Returns its value, or "".
std::string device_of_environment();

/// Returns what is wrong with the drivers that variables of the Vulkan loader name
/// (VK_DRIVER_FILES, VK_ICD_FILENAMES, VK_ADD_DRIVER_FILES, VK_LOADER_DRIVERS_SELECT and _DISABLE),
/// and what to do; "" where nothing is. Only of use where no driver was found.
std::string driver_fault();

/// Returns the drivers that the Vulkan loader looks for and leaves out, each with its reason:
/// "/a.json, whose library b.so does not load (...)". Those of the system and of variables. Empty
/// on Windows, where they are in the registry.
std::vector<std::string> left_out_drivers();

/// Returns the warning of a driver of left_out_drivers(), where the CPU is used.
std::string left_out_warning(const std::string& driver);

/// Returns left_out_drivers() if all of these devices are CPUs, where a driver may be missing.
std::vector<std::string> missing_drivers(std::span<const DeviceReport> devices);

/// Returns `message`, of an error `no_device`, with driver_fault() in place of the advice to
/// install a driver.
std::string with_driver_fault(const std::string& message);

/// Does the same as take(), for calls that look for devices. Loaders answer a file that is no
/// driver file with a lack of memory.
template <class T>
T take_device(Result<T>&& result, const std::string& prefix = {}) {
    const auto is_of_drivers = [](Status status) {
        return status == Status::no_device ||
               (status == Status::out_of_host_memory && !driver_fault().empty());
    };
    if (!result && is_of_drivers(result.error().status)) {
        Error error = result.error();
        error.status = Status::no_device;
        error.message = with_driver_fault(error.message);
        return take(Result<T>(std::move(error)), prefix);
    }
    return take(std::move(result), prefix);
}

} // namespace geodisk::tools
