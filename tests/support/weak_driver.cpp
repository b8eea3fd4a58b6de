// A Vulkan driver that passes every call on to the driver of GEODISK_TEST_DRIVER, but reports
// limits too small for geodisk, or does not even come to that, as GEODISK_TEST_CRASH says; or which
// reports what there is, and loses as many devices, one after the other, as GEODISK_TEST_LOSSES
// says; or which has no queue that draws, where GEODISK_TEST_NO_GRAPHICS is set; or which claims to
// be a GPU with subgroups of 32, where GEODISK_TEST_AS_GPU is set, so that it is tuned as one.
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

/// The driver's functions behind those below; they are the same for all instances.
PFN_vkGetPhysicalDeviceProperties real_properties = nullptr;
PFN_vkGetPhysicalDeviceProperties2 real_properties2 = nullptr;
PFN_vkGetPhysicalDeviceQueueFamilyProperties real_families = nullptr;
PFN_vkCreateDevice real_create_device = nullptr;
PFN_vkGetDeviceProcAddr real_device_function = nullptr;
PFN_vkQueueSubmit real_submit = nullptr;

/// Returns how many devices are to be lost.
int losses() {
    const char* const text = std::getenv("GEODISK_TEST_LOSSES");
    return text != nullptr ? std::atoi(text) : 0;
}

bool has_no_graphics() {
    return std::getenv("GEODISK_TEST_NO_GRAPHICS") != nullptr;
}

bool is_disguised() {
    return std::getenv("GEODISK_TEST_AS_GPU") != nullptr;
}

int devices = 0;
int submissions = 0; ///< To the last device; those of several threads are not told apart.

void weaken(VkPhysicalDeviceLimits& limits) {
    if (losses() > 0 || has_no_graphics() || is_disguised()) {
        return;
    }
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

/// A GPU whose texel buffers are too small to read through, so that kernels read storage. It keeps
/// the name of its driver, whose limits on loops hold.
void disguise(VkPhysicalDeviceProperties& properties) {
    if (is_disguised()) {
        properties.deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
        properties.limits.maxTexelBufferElements = 65536;
    }
}

/// Disguises what is asked for besides.
void disguise(void* chain) {
    constexpr std::uint32_t kSubgroup = 32;
    for (auto* next = static_cast<VkBaseOutStructure*>(chain); is_disguised() && next != nullptr;
         next = next->pNext) {
        if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES) {
            reinterpret_cast<VkPhysicalDeviceSubgroupProperties*>(next)->subgroupSize = kSubgroup;
        } else if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES) {
            reinterpret_cast<VkPhysicalDeviceVulkan11Properties*>(next)->subgroupSize = kSubgroup;
        }
    }
}

VKAPI_ATTR void VKAPI_CALL get_properties(VkPhysicalDevice device,
                                          VkPhysicalDeviceProperties* properties) {
    real_properties(device, properties);
    weaken(properties->limits);
    disguise(*properties);
}

VKAPI_ATTR void VKAPI_CALL get_properties2(VkPhysicalDevice device,
                                           VkPhysicalDeviceProperties2* properties) {
    real_properties2(device, properties);
    weaken(properties->properties.limits);
    disguise(properties->properties);
    disguise(properties->pNext);
}

VKAPI_ATTR void VKAPI_CALL get_queue_families(VkPhysicalDevice device, std::uint32_t* count,
                                              VkQueueFamilyProperties* families) {
    real_families(device, count, families);
    for (std::uint32_t i = 0; families != nullptr && has_no_graphics() && i < *count; ++i) {
        families[i].queueFlags &= ~VkQueueFlags{VK_QUEUE_GRAPHICS_BIT};
    }
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical,
                                             const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* allocator,
                                             VkDevice* device) {
    ++devices;
    submissions = 0;
    return real_create_device(physical, info, allocator, device);
}

VKAPI_ATTR VkResult VKAPI_CALL submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos,
                                      VkFence fence) {
    constexpr int kLast = 8; // Beyond the check of arithmetic, amid the first mesh.
    if (devices <= losses() && ++submissions >= kLast) {
        return VK_ERROR_DEVICE_LOST;
    }
    return real_submit(queue, count, infos, fence);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_function(VkDevice device, const char* name) {
    const PFN_vkVoidFunction real = real_device_function(device, name);
    if (std::strcmp(name, "vkQueueSubmit") == 0) {
        real_submit = reinterpret_cast<PFN_vkQueueSubmit>(real);
        return reinterpret_cast<PFN_vkVoidFunction>(submit);
    }
    return real;
}

/// Returns `mine`, and notes in `real` what it stands before.
template <class Function>
PFN_vkVoidFunction instead(PFN_vkVoidFunction function, Function& real, Function mine) {
    real = reinterpret_cast<Function>(function);
    return reinterpret_cast<PFN_vkVoidFunction>(mine);
}

} // namespace

extern "C" {

__attribute__((visibility("default"))) VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL
vk_icdGetInstanceProcAddr(VkInstance instance, const char* name) {
    const PFN_vkVoidFunction real = real_function(instance, name);
    const auto is = [&](const char* other) {
        return real != nullptr && std::strcmp(name, other) == 0;
    };
    if (is("vkGetPhysicalDeviceProperties")) {
        return instead(real, real_properties, &get_properties);
    }
    if (is("vkGetPhysicalDeviceProperties2") || is("vkGetPhysicalDeviceProperties2KHR")) {
        return instead(real, real_properties2, &get_properties2);
    }
    if (is("vkGetPhysicalDeviceQueueFamilyProperties")) {
        return instead(real, real_families, &get_queue_families);
    }
    if (losses() > 0 && is("vkCreateDevice")) {
        return instead(real, real_create_device, &create_device);
    }
    if (losses() > 0 && is("vkGetDeviceProcAddr")) {
        return instead(real, real_device_function, &get_device_function);
    }
    return real;
}

__attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
vk_icdNegotiateLoaderICDInterfaceVersion(std::uint32_t* version) {
    const auto negotiate = real_symbol<VkResult(VKAPI_PTR*)(std::uint32_t*)>(
        "vk_icdNegotiateLoaderICDInterfaceVersion");
    return negotiate != nullptr ? negotiate(version) : VK_ERROR_INCOMPATIBLE_DRIVER;
}

} // extern "C"
