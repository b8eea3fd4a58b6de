// A program that has a Vulkan device of its own, made by plain Vulkan calls: what geodisk borrows.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include <geodisk/device.hpp>

namespace geodisk::test {

/// Messages of the validation layer, from whichever thread.
struct MessageLog {
    std::mutex mutex;
    std::vector<std::string> messages;
};

/// Instance with validation and synchronization validation, device and one compute queue. Every
/// failure throws std::runtime_error.
class AppDevice {
  public:
    explicit AppDevice(const VkAllocationCallbacks* host_allocator = nullptr);
    AppDevice(const AppDevice&) = delete;
    AppDevice& operator=(const AppDevice&) = delete;
    ~AppDevice();

    DeviceRefs refs() const;
    QueueRef queue() const;

    /// Destroys the device, upon which the layer reports what was left behind.
    void destroy_device();
    /// Returns the messages of the layer so far.
    std::vector<std::string> messages() const;

    /// A function of the device, `function<PFN_vkCreateBuffer>("vkCreateBuffer")`.
    template <class Function>
    Function function(const char* name) const {
        return reinterpret_cast<Function>(device_function(name));
    }

  private:
    void create_instance();
    void choose_family();
    void create_device();
    PFN_vkVoidFunction instance_function(const char* name) const;
    PFN_vkVoidFunction device_function(const char* name) const;
    void destroy() noexcept;

    const VkAllocationCallbacks* host_allocator_;
    void* library_ = nullptr;
    PFN_vkGetInstanceProcAddr get_instance_proc_addr_ = nullptr;
    mutable MessageLog log_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device_ = VK_NULL_HANDLE;
    std::uint32_t family_ = 0;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
};

} // namespace geodisk::test
