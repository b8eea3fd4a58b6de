#include "app_device.hpp"

#include <stdexcept>

#include <dlfcn.h>

namespace geodisk::test {
namespace {

void check(VkResult result, const char* call) {
    if (result != VK_SUCCESS) {
        throw std::runtime_error(std::string(call) + " failed with " + std::to_string(result));
    }
}

VKAPI_ATTR VkBool32 VKAPI_CALL keep_message(VkDebugUtilsMessageSeverityFlagBitsEXT /*severity*/,
                                            VkDebugUtilsMessageTypeFlagsEXT /*type*/,
                                            const VkDebugUtilsMessengerCallbackDataEXT* data,
                                            void* user) {
    MessageLog& log = *static_cast<MessageLog*>(user);
    const std::lock_guard lock(log.mutex);
    log.messages.emplace_back(data->pMessage);
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(MessageLog& log) {
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                       VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = keep_message;
    info.pUserData = &log;
    return info;
}

} // namespace

AppDevice::AppDevice(const VkAllocationCallbacks* host_allocator)
    : host_allocator_(host_allocator) {
    for (const char* name : {"libvulkan.so.1", "libvulkan.1.dylib"}) {
        library_ = library_ != nullptr ? library_ : dlopen(name, RTLD_NOW | RTLD_LOCAL);
    }
    if (library_ == nullptr) {
        throw std::runtime_error("there is no Vulkan loader");
    }
    get_instance_proc_addr_ =
        reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library_, "vkGetInstanceProcAddr"));
    try {
        create_instance();
        choose_family();
        create_device();
    } catch (...) {
        destroy();
        throw;
    }
}

AppDevice::~AppDevice() {
    destroy();
}

void AppDevice::create_instance() {
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "an engine";
    application.apiVersion = VK_API_VERSION_1_1;
    const VkValidationFeatureEnableEXT enable[] = {
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = enable;
    const VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(log_);
    const char* layers[] = {"VK_LAYER_KHRONOS_validation"};
    const char* extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME,
                                VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pNext = &features;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = layers;
    info.enabledExtensionCount = 2;
    info.ppEnabledExtensionNames = extensions;
    check(reinterpret_cast<PFN_vkCreateInstance>(instance_function("vkCreateInstance"))(
              &info, host_allocator_, &instance_),
          "vkCreateInstance");
    check(reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
              instance_function("vkCreateDebugUtilsMessengerEXT"))(instance_, &messenger,
                                                                   host_allocator_, &messenger_),
          "vkCreateDebugUtilsMessengerEXT");
}

void AppDevice::choose_family() {
    std::uint32_t count = 1;
    const VkResult listed = reinterpret_cast<PFN_vkEnumeratePhysicalDevices>(
        instance_function("vkEnumeratePhysicalDevices"))(instance_, &count, &physical_device_);
    if (listed != VK_INCOMPLETE || count == 0) {
        check(listed, "vkEnumeratePhysicalDevices");
    }
    const auto get = reinterpret_cast<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(
        instance_function("vkGetPhysicalDeviceQueueFamilyProperties"));
    get(physical_device_, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    get(physical_device_, &count, families.data());
    while (family_ < count && (families[family_].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0) {
        ++family_;
    }
    if (family_ == count) {
        throw std::runtime_error("the device does not compute");
    }
}

void AppDevice::create_device() {
    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = family_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    check(reinterpret_cast<PFN_vkCreateDevice>(instance_function("vkCreateDevice"))(
              physical_device_, &info, host_allocator_, &device_),
          "vkCreateDevice");
    function<PFN_vkGetDeviceQueue>("vkGetDeviceQueue")(device_, family_, 0, &queue_);
}

PFN_vkVoidFunction AppDevice::instance_function(const char* name) const {
    return get_instance_proc_addr_(instance_, name);
}

PFN_vkVoidFunction AppDevice::device_function(const char* name) const {
    return reinterpret_cast<PFN_vkGetDeviceProcAddr>(instance_function("vkGetDeviceProcAddr"))(
        device_, name);
}

DeviceRefs AppDevice::refs() const {
    DeviceRefs refs;
    refs.instance = instance_;
    refs.physical_device = physical_device_;
    refs.device = device_;
    refs.get_instance_proc_addr = get_instance_proc_addr_;
    refs.host_allocator = host_allocator_;
    return refs;
}

QueueRef AppDevice::queue() const {
    QueueRef queue;
    queue.queue = queue_;
    queue.family = family_;
    return queue;
}

std::vector<std::string> AppDevice::messages() const {
    const std::lock_guard lock(log_.mutex);
    return log_.messages;
}

void AppDevice::destroy_device() {
    if (device_ != VK_NULL_HANDLE) {
        function<PFN_vkDestroyDevice>("vkDestroyDevice")(device_, host_allocator_);
        device_ = VK_NULL_HANDLE;
    }
}

void AppDevice::destroy() noexcept {
    destroy_device();
    if (messenger_ != VK_NULL_HANDLE) {
        reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(instance_function(
            "vkDestroyDebugUtilsMessengerEXT"))(instance_, messenger_, host_allocator_);
    }
    if (instance_ != VK_NULL_HANDLE) {
        reinterpret_cast<PFN_vkDestroyInstance>(instance_function("vkDestroyInstance"))(
            instance_, host_allocator_);
    }
    dlclose(library_);
}

} // namespace geodisk::test
