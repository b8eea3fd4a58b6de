#include "fake_driver.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace geodisk::test {
namespace {

FakeDriver* active_driver = nullptr;

Loader open_real_loader() {
    Result<Loader> loader = Loader::open();
    if (!loader)
        std::abort(); // The tests need a device; main() has reported the lack of one.
    return std::move(loader).value();
}

/// The second half of the two-call idiom.
template <class T>
void hand_out(const std::vector<T>& from, std::uint32_t* count, T* to) {
    if (to == nullptr) {
        *count = static_cast<std::uint32_t>(from.size());
        return;
    }
    *count = std::min(*count, static_cast<std::uint32_t>(from.size()));
    std::copy_n(from.begin(), *count, to);
}

} // namespace

struct FakeDriver::Functions {
    template <class Function>
    static Function real(const char* name) {
        return reinterpret_cast<Function>(
            active_driver->real_.get_instance_proc_addr()(active_driver->instance_, name));
    }

    /// Returns what `name` is set to fail with, or VK_SUCCESS.
    static VkResult failure_of(const char* name) {
        const auto found = active_driver->failing.find(name);
        return found != active_driver->failing.end() ? found->second : VK_SUCCESS;
    }

    static VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info,
                                                          const VkAllocationCallbacks* allocator,
                                                          VkInstance* instance) {
        if (const VkResult failure = failure_of("vkCreateInstance"); failure != VK_SUCCESS)
            return failure;
        const auto create = reinterpret_cast<PFN_vkCreateInstance>(
            active_driver->real_.get_instance_proc_addr()(VK_NULL_HANDLE, "vkCreateInstance"));
        const VkResult result = create(info, allocator, instance);
        active_driver->live_instances_ += result == VK_SUCCESS ? 1 : 0;
        return result;
    }

    static VKAPI_ATTR void VKAPI_CALL destroy_instance(VkInstance instance,
                                                       const VkAllocationCallbacks* allocator) {
        real<PFN_vkDestroyInstance>("vkDestroyInstance")(instance, allocator);
        --active_driver->live_instances_;
    }

    static VKAPI_ATTR VkResult VKAPI_CALL enumerate_layers(std::uint32_t* count,
                                                           VkLayerProperties* /*layers*/) {
        *count = 0;
        return VK_SUCCESS;
    }

    static VKAPI_ATTR VkResult VKAPI_CALL enumerate_version(std::uint32_t* version) {
        *version = VK_API_VERSION_1_0;
        return VK_SUCCESS;
    }

    static VKAPI_ATTR VkResult VKAPI_CALL enumerate_devices(VkInstance instance,
                                                            std::uint32_t* count,
                                                            VkPhysicalDevice* devices) {
        const VkResult failure = failure_of("vkEnumeratePhysicalDevices");
        if (failure != VK_SUCCESS || active_driver->hide_devices) {
            *count = 0;
            return failure;
        }
        return real<PFN_vkEnumeratePhysicalDevices>("vkEnumeratePhysicalDevices")(instance, count,
                                                                                  devices);
    }

    static VKAPI_ATTR void VKAPI_CALL get_properties(VkPhysicalDevice device,
                                                     VkPhysicalDeviceProperties* properties) {
        real<PFN_vkGetPhysicalDeviceProperties>("vkGetPhysicalDeviceProperties")(device,
                                                                                 properties);
        if (active_driver->edit_properties)
            active_driver->edit_properties(*properties);
    }

    static VKAPI_ATTR void VKAPI_CALL get_queue_families(VkPhysicalDevice device,
                                                         std::uint32_t* count,
                                                         VkQueueFamilyProperties* families) {
        const auto get = real<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(
            "vkGetPhysicalDeviceQueueFamilyProperties");
        std::uint32_t real_count = 0;
        get(device, &real_count, nullptr);
        std::vector<VkQueueFamilyProperties> edited(real_count);
        get(device, &real_count, edited.data());
        if (active_driver->edit_queue_families)
            active_driver->edit_queue_families(edited);
        hand_out(edited, count, families);
    }

    static VKAPI_ATTR void VKAPI_CALL get_memory(VkPhysicalDevice device,
                                                 VkPhysicalDeviceMemoryProperties* memory) {
        real<PFN_vkGetPhysicalDeviceMemoryProperties>("vkGetPhysicalDeviceMemoryProperties")(
            device, memory);
        if (active_driver->edit_memory)
            active_driver->edit_memory(*memory);
    }

    static VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical_device,
                                                        const VkDeviceCreateInfo* info,
                                                        const VkAllocationCallbacks* allocator,
                                                        VkDevice* device) {
        if (const VkResult failure = failure_of("vkCreateDevice"); failure != VK_SUCCESS)
            return failure;
        const VkResult result =
            real<PFN_vkCreateDevice>("vkCreateDevice")(physical_device, info, allocator, device);
        active_driver->live_devices_ += result == VK_SUCCESS ? 1 : 0;
        return result;
    }

    static VKAPI_ATTR void VKAPI_CALL destroy_device(VkDevice device,
                                                     const VkAllocationCallbacks* allocator) {
        real<PFN_vkDestroyDevice>("vkDestroyDevice")(device, allocator);
        --active_driver->live_devices_;
    }

    static PFN_vkVoidFunction VKAPI_CALL get_device_proc_addr(VkDevice device, const char* name) {
        if (active_driver->missing.contains(name))
            return nullptr;
        if (std::string_view(name) == "vkDestroyDevice")
            return reinterpret_cast<PFN_vkVoidFunction>(&destroy_device);
        return real<PFN_vkGetDeviceProcAddr>("vkGetDeviceProcAddr")(device, name);
    }

    static PFN_vkVoidFunction find(std::string_view name) {
        const std::pair<std::string_view, PFN_vkVoidFunction> replacements[] = {
            {"vkCreateInstance", reinterpret_cast<PFN_vkVoidFunction>(&create_instance)},
            {"vkDestroyInstance", reinterpret_cast<PFN_vkVoidFunction>(&destroy_instance)},
            {"vkEnumeratePhysicalDevices",
             reinterpret_cast<PFN_vkVoidFunction>(&enumerate_devices)},
            {"vkGetPhysicalDeviceProperties",
             reinterpret_cast<PFN_vkVoidFunction>(&get_properties)},
            {"vkGetPhysicalDeviceQueueFamilyProperties",
             reinterpret_cast<PFN_vkVoidFunction>(&get_queue_families)},
            {"vkGetPhysicalDeviceMemoryProperties",
             reinterpret_cast<PFN_vkVoidFunction>(&get_memory)},
            {"vkCreateDevice", reinterpret_cast<PFN_vkVoidFunction>(&create_device)},
            {"vkGetDeviceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(&get_device_proc_addr)},
        };
        for (const auto& [replaced, function] : replacements) {
            if (replaced == name)
                return function;
        }
        if (active_driver->hide_layers && name == "vkEnumerateInstanceLayerProperties")
            return reinterpret_cast<PFN_vkVoidFunction>(&enumerate_layers);
        if (active_driver->answer_1_0 && name == "vkEnumerateInstanceVersion")
            return reinterpret_cast<PFN_vkVoidFunction>(&enumerate_version);
        return nullptr;
    }
};

FakeDriver::FakeDriver() : real_(open_real_loader()) {
    active_driver = this;
}

FakeDriver::~FakeDriver() {
    active_driver = nullptr;
}

PFN_vkVoidFunction FakeDriver::get_instance_proc_addr(VkInstance instance, const char* name) {
    if (instance != VK_NULL_HANDLE)
        active_driver->instance_ = instance;
    if (active_driver->missing.contains(name))
        return nullptr;
    if (const PFN_vkVoidFunction replacement = Functions::find(name))
        return replacement;
    return active_driver->real_.get_instance_proc_addr()(instance, name);
}

} // namespace geodisk::test
