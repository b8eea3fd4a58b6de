// A Vulkan instance of our own, with the loader it came from.
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

/// A physical device and what `query_device` says about it.
struct FoundDevice {
    VkPhysicalDevice handle = VK_NULL_HANDLE;
    DeviceReport report;
};

/// Owns an instance of Vulkan 1.1. Neither copied nor moved, since the validation log is registered
/// by its address. Functions returning a Result may throw std::bad_alloc.
class Instance {
  public:
    static constexpr std::uint32_t kApiVersion = VK_API_VERSION_1_1;

    /// Errors: `no_device` without driver, `device_lacks` without the validation layer asked for.
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
    /// Null without validation.
    const ValidationLog* validation_log() const noexcept { return log_.get(); }

    /// All devices in the order of the driver. Errors: `no_device` when there is none.
    Result<std::vector<FoundDevice>> find_devices() const;

  private:
    explicit Instance(Loader loader) noexcept : loader_(std::move(loader)) {}
    Result<Done> create_handle(bool validation);
    Result<Done> create_messenger();

    Loader loader_; // First, so that the library is closed last.
    std::unique_ptr<ValidationLog> log_;
    VkInstance handle_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    InstanceTable functions_;
    OwnerTable owner_functions_;
};

} // namespace geodisk
