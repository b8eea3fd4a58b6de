// A Vulkan instance that geodisk owns, with its loader.
#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include <vulkan/vulkan_core.h>

#include <geodisk/device.hpp>
#include <geodisk/status.hpp>

#include "owned/loader.hpp"
#include "owned/validation_log.hpp"
#include "vk/dispatch.hpp"

namespace geodisk {

struct InstanceOptions {
    bool validation = false;
    std::function<void(std::string_view)> on_validation_message;
};

/// A physical device and its report.
struct FoundDevice {
    VkPhysicalDevice handle = VK_NULL_HANDLE;
    DeviceReport report;
};

/// Owns a Vulkan 1.1 instance. Not copyable or movable, since the validation log is registered by
/// its address. Functions that return a Result may throw std::bad_alloc.
class Instance {
  public:
    static constexpr std::uint32_t kApiVersion = VK_API_VERSION_1_1;

    /// Creates an instance. Errors: `no_device` without driver; `device_lacks` if the validation
    /// layer is requested but missing.
    static Result<std::unique_ptr<Instance>> create(Loader loader, InstanceOptions options);

    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;
    ~Instance();

    VkInstance handle() const noexcept { return handle_; }
    const InstanceTable& functions() const noexcept { return functions_; }
    const OwnerTable& owner_functions() const noexcept { return owner_functions_; }
    PFN_vkGetInstanceProcAddr get_instance_proc_addr() const noexcept {
        return loader_.get_instance_proc_addr();
    }
    /// Returns the log, or null without validation.
    const ValidationLog* validation_log() const noexcept { return log_.get(); }

    /// Returns all devices in the order of the driver. Errors: `no_device` if there is none.
    Result<std::vector<FoundDevice>> find_devices() const;

  private:
    explicit Instance(Loader loader) noexcept : loader_(std::move(loader)) {}
    Result<Done> create_handle(bool validation);
    Result<Done> create_messenger();

    Loader loader_; // First member, so that the library is closed last.
    std::unique_ptr<ValidationLog> log_;
    VkInstance handle_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    InstanceTable functions_;
    OwnerTable owner_functions_;
};

} // namespace geodisk
