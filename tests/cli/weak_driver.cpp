// A Vulkan driver that passes every call on to the driver of GEODISK_TEST_DRIVER, but reports
// limits too small for geodisk, or does not even come to that, as GEODISK_TEST_CRASH says.
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan_core.h>

namespace {

template <class Function>
Function real_symbol(const char* name) {
    static void* const kLibrary = dlopen(std::getenv("GEODISK_TEST_DRIVER"), RTLD_NOW);
    return kLibrary != nullptr ? reinterpret_cast<Function>(dlsym(kLibrary, name)) : nullptr;
}

PFN_vkVoidFunction real_function(VkInstance instance, const char* name) {
    const auto get = real_symbol<PFN_vkGetInstanceProcAddr>("vk_icdGetInstanceProcAddr");
    return get != nullptr ? get(instance, name) : nullptr;
}

VkInstance current_instance = VK_NULL_HANDLE; // The program under test makes one at a time.

void weaken(VkPhysicalDeviceLimits& limits) {
    const char* const crash = std::getenv("GEODISK_TEST_CRASH");
    if (crash != nullptr && std::strcmp(crash, "access") == 0) {
        std::raise(SIGSEGV);
    } else if (crash != nullptr && std::strcmp(crash, "abort") == 0) {
        std::abort();
    } else if (crash != nullptr) {
        std::exit(1);
    }
    limits.maxPerStageDescriptorStorageBuffers = 4;
    limits.maxComputeWorkGroupInvocations = 16;
}

VKAPI_ATTR void VKAPI_CALL get_properties(VkPhysicalDevice device,
                                          VkPhysicalDeviceProperties* properties) {
    reinterpret_cast<PFN_vkGetPhysicalDeviceProperties>(
        real_function(current_instance, "vkGetPhysicalDeviceProperties"))(device, properties);
    weaken(properties->limits);
}

VKAPI_ATTR void VKAPI_CALL get_properties2(VkPhysicalDevice device,
                                           VkPhysicalDeviceProperties2* properties) {
    reinterpret_cast<PFN_vkGetPhysicalDeviceProperties2>(
        real_function(current_instance, "vkGetPhysicalDeviceProperties2"))(device, properties);
    weaken(properties->properties.limits);
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info,
                                               const VkAllocationCallbacks* allocator,
                                               VkInstance* instance) {
    const VkResult result = reinterpret_cast<PFN_vkCreateInstance>(
        real_function(VK_NULL_HANDLE, "vkCreateInstance"))(info, allocator, instance);
    current_instance = result == VK_SUCCESS ? *instance : VK_NULL_HANDLE;
    return result;
}

} // namespace

extern "C" {

__attribute__((visibility("default"))) VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL
vk_icdGetInstanceProcAddr(VkInstance instance, const char* name) {
    if (std::strcmp(name, "vkCreateInstance") == 0) {
        return reinterpret_cast<PFN_vkVoidFunction>(create_instance);
    }
    if (std::strcmp(name, "vkGetPhysicalDeviceProperties") == 0) {
        return reinterpret_cast<PFN_vkVoidFunction>(get_properties);
    }
    if (std::strcmp(name, "vkGetPhysicalDeviceProperties2") == 0 ||
        std::strcmp(name, "vkGetPhysicalDeviceProperties2KHR") == 0) {
        return reinterpret_cast<PFN_vkVoidFunction>(get_properties2);
    }
    return real_function(instance, name);
}

__attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
vk_icdNegotiateLoaderICDInterfaceVersion(std::uint32_t* version) {
    const auto negotiate = real_symbol<VkResult(VKAPI_PTR*)(std::uint32_t*)>(
        "vk_icdNegotiateLoaderICDInterfaceVersion");
    return negotiate != nullptr ? negotiate(version) : VK_ERROR_INCOMPATIBLE_DRIVER;
}

} // extern "C"
