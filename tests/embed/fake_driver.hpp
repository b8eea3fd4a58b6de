// Stands between geodisk and the real loader: weakens the devices, hides functions, fails calls and
// counts what is created and destroyed.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <vulkan/vulkan_core.h>

#include "owned/loader.hpp"

namespace geodisk::test {

/// Everything is passed on to the real loader, except as set below. Since Vulkan's functions carry
/// no user pointer, one object may exist at a time, and must outlive what is made through it.
class FakeDriver {
  public:
    FakeDriver();
    ~FakeDriver();
    FakeDriver(const FakeDriver&) = delete;
    FakeDriver& operator=(const FakeDriver&) = delete;

    /// Edits what each device reports.
    std::function<void(VkPhysicalDeviceProperties&)> edit_properties;
    std::function<void(std::vector<VkQueueFamilyProperties>&)> edit_queue_families;
    std::function<void(VkPhysicalDeviceMemoryProperties&)> edit_memory;
    /// Functions of instance or device that cannot be found.
    std::set<std::string> missing;
    /// vkCreateInstance, vkEnumeratePhysicalDevices or vkCreateDevice, and what it fails with.
    std::map<std::string, VkResult> failing;
    bool hide_devices = false;
    bool hide_layers = false;
    bool answer_1_0 = false; ///< vkEnumerateInstanceVersion, as of Wine without an X display.

    int live_instances() const { return live_instances_; }
    int live_devices() const { return live_devices_; }

    /// A loader that leads here.
    Loader loader() const { return Loader(&FakeDriver::get_instance_proc_addr); }
    static PFN_vkVoidFunction VKAPI_CALL get_instance_proc_addr(VkInstance instance,
                                                                const char* name);

  private:
    struct Functions; // The replacements.

    Loader real_;
    VkInstance instance_ = VK_NULL_HANDLE; ///< Through which the real functions are found.
    int live_instances_ = 0;
    int live_devices_ = 0;
};

} // namespace geodisk::test
