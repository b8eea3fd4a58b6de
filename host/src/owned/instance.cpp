#include "owned/instance.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <geodisk/version.hpp>

#include "vk/enumerate.hpp"
#include "vk/extensions.hpp"
#include "vk/result.hpp"

namespace geodisk {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

/// Functions that need no instance.
struct GlobalTable {
    PFN_vkEnumerateInstanceVersion vkEnumerateInstanceVersion = nullptr;
    PFN_vkEnumerateInstanceExtensionProperties vkEnumerateInstanceExtensionProperties = nullptr;
    PFN_vkEnumerateInstanceLayerProperties vkEnumerateInstanceLayerProperties = nullptr;
    PFN_vkCreateInstance vkCreateInstance = nullptr;
};

/// Layers and extensions for vkCreateInstance.
struct InstancePlan {
    std::vector<const char*> extensions;
    VkInstanceCreateFlags flags = 0;
    bool has_settings = false; // VK_EXT_layer_settings
};

template <class Function>
Function find(PFN_vkGetInstanceProcAddr get, VkInstance instance, const char* name) noexcept {
    return reinterpret_cast<Function>(get(instance, name));
}

Error no_driver() {
    return Error{Status::no_device,
                 "no Vulkan driver was found; install the driver of the graphics card or, to run "
                 "on the CPU, Mesa's lavapipe (Debian and Ubuntu: mesa-vulkan-drivers)"};
}

/// Makes the error for a failed call that creates an instance or lists devices: without a working
/// driver these fail in several ways.
Error driver_error(const char* call, VkResult result) {
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER || result == VK_ERROR_INITIALIZATION_FAILED) {
        Error error = no_driver();
        error.vk_result = result;
        return error;
    }
    return vk_error(call, result);
}

Result<GlobalTable> load_global_table(PFN_vkGetInstanceProcAddr get) {
    GlobalTable vk;
    // Only loaders of Vulkan 1.1 and later have it.
    vk.vkEnumerateInstanceVersion =
        find<PFN_vkEnumerateInstanceVersion>(get, VK_NULL_HANDLE, "vkEnumerateInstanceVersion");
    vk.vkEnumerateInstanceExtensionProperties = find<PFN_vkEnumerateInstanceExtensionProperties>(
        get, VK_NULL_HANDLE, "vkEnumerateInstanceExtensionProperties");
    vk.vkEnumerateInstanceLayerProperties = find<PFN_vkEnumerateInstanceLayerProperties>(
        get, VK_NULL_HANDLE, "vkEnumerateInstanceLayerProperties");
    vk.vkCreateInstance = find<PFN_vkCreateInstance>(get, VK_NULL_HANDLE, "vkCreateInstance");
    std::uint32_t version = VK_API_VERSION_1_0;
    if (vk.vkEnumerateInstanceVersion != nullptr)
        vk.vkEnumerateInstanceVersion(&version);
    if (version < Instance::kApiVersion) {
        // Wine's loader has the function, but returns 1.0 if it reaches no driver.
        if (vk.vkEnumerateInstanceVersion != nullptr)
            return Error{Status::no_device, "the Vulkan loader reaches no driver; install one or, "
                                            "under Wine, set DISPLAY to an X server (xvfb-run "
                                            "starts one)"};
        return Error{Status::no_device,
                     "the Vulkan loader is of version 1.0, but 1.1 is needed; update it"};
    }
    if (vk.vkEnumerateInstanceExtensionProperties == nullptr ||
        vk.vkEnumerateInstanceLayerProperties == nullptr || vk.vkCreateInstance == nullptr)
        return Error{Status::no_device, "the Vulkan loader lacks basic functions; reinstall it"};
    return vk;
}

/// Lists the extensions of `layer`, or for nullptr those of the loader and the drivers.
Result<std::vector<VkExtensionProperties>> list_extensions(const GlobalTable& vk,
                                                           const char* layer) {
    std::vector<VkExtensionProperties> extensions;
    const VkResult result = enumerate(extensions, [&](auto* count, auto* elements) {
        return vk.vkEnumerateInstanceExtensionProperties(layer, count, elements);
    });
    if (result != VK_SUCCESS)
        return vk_error("vkEnumerateInstanceExtensionProperties", result);
    return extensions;
}

/// Adds the layer and extensions for validation. The loader silently drops an unknown layer, so
/// check first.
Result<Done> plan_validation(const GlobalTable& vk, InstancePlan& plan) {
    std::vector<VkLayerProperties> layers;
    const VkResult result = enumerate(layers, [&](auto* count, auto* elements) {
        return vk.vkEnumerateInstanceLayerProperties(count, elements);
    });
    if (result != VK_SUCCESS)
        return vk_error("vkEnumerateInstanceLayerProperties", result);
    const bool installed = std::any_of(layers.begin(), layers.end(), [](const auto& layer) {
        return std::string_view(layer.layerName) == kValidationLayer;
    });
    if (!installed)
        return Error{Status::device_lacks,
                     std::string("validation needs the layer ") + kValidationLayer +
                         ", which is not installed (Debian and Ubuntu: vulkan-validationlayers)"};
    const auto offered = list_extensions(vk, kValidationLayer);
    if (!offered)
        return offered.error();
    for (const char* name :
         {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME}) {
        if (!contains_extension(*offered, name))
            return Error{Status::device_lacks, std::string("validation needs the extension ") +
                                                   name + ", which the installed layer lacks"};
        plan.extensions.push_back(name);
    }
#ifdef VK_EXT_layer_settings
    plan.has_settings = contains_extension(*offered, VK_EXT_LAYER_SETTINGS_EXTENSION_NAME);
    if (plan.has_settings) {
        plan.extensions.push_back(VK_EXT_LAYER_SETTINGS_EXTENSION_NAME);
    }
#endif
    return Done{};
}

Result<InstancePlan> plan_instance(const GlobalTable& vk, bool validation) {
    InstancePlan plan;
#ifdef VK_KHR_portability_enumeration
    const auto offered = list_extensions(vk, nullptr);
    if (!offered)
        return offered.error();
    // Otherwise drivers such as MoltenVK stay hidden.
    if (contains_extension(*offered, VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME)) {
        plan.extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
        plan.flags |= VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR;
    }
#endif
    if (validation) {
        const Result<Done> planned = plan_validation(vk, plan);
        if (!planned)
            return planned.error();
    }
    return plan;
}

} // namespace

Result<std::unique_ptr<Instance>> Instance::create(Loader loader, InstanceOptions options) {
    std::unique_ptr<Instance> instance(new Instance(std::move(loader)));
    if (options.validation)
        instance->log_ = std::make_unique<ValidationLog>(std::move(options.on_validation_message));
    const Result<Done> created = instance->create_handle(options.validation);
    if (!created)
        return created.error();
    if (options.validation) {
        const Result<Done> messenger = instance->create_messenger();
        if (!messenger)
            return messenger.error();
    }
    return instance;
}

Result<Done> Instance::create_handle(bool validation) {
    const PFN_vkGetInstanceProcAddr get = get_instance_proc_addr();
    const Result<GlobalTable> vk = load_global_table(get);
    if (!vk)
        return vk.error();
    const Result<InstancePlan> plan = plan_instance(*vk, validation);
    if (!plan)
        return plan.error();

    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pEngineName = "geodisk";
    application.engineVersion =
        VK_MAKE_VERSION(GEODISK_VERSION_MAJOR, GEODISK_VERSION_MINOR, GEODISK_VERSION_PATCH);
    application.apiVersion = kApiVersion;

    const VkValidationFeatureEnableEXT synchronization =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &synchronization;

    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.flags = plan->flags;
    info.pApplicationInfo = &application;
    info.enabledExtensionCount = static_cast<std::uint32_t>(plan->extensions.size());
    info.ppEnabledExtensionNames = plan->extensions.data();
    VkDebugUtilsMessengerCreateInfoEXT messenger{};
#ifdef VK_EXT_layer_settings
    // Newer layers check shader accesses only if told to.
    const VkBool32 on = VK_TRUE;
    const VkLayerSettingEXT shader_accesses{kValidationLayer, "syncval_shader_accesses_heuristic",
                                            VK_LAYER_SETTING_TYPE_BOOL32_EXT, 1, &on};
    VkLayerSettingsCreateInfoEXT settings{};
    settings.sType = VK_STRUCTURE_TYPE_LAYER_SETTINGS_CREATE_INFO_EXT;
    settings.settingCount = 1;
    settings.pSettings = &shader_accesses;
#endif
    if (validation) {
        messenger = log_->messenger_info(); // Reports messages about vkCreateInstance itself.
        features.pNext = &messenger;
        info.pNext = &features;
#ifdef VK_EXT_layer_settings
        settings.pNext = &features;
        info.pNext = plan->has_settings ? static_cast<const void*>(&settings) : &features;
#endif
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &kValidationLayer;
    }
    const VkResult result = vk->vkCreateInstance(&info, nullptr, &handle_);
    if (result != VK_SUCCESS) {
        handle_ = VK_NULL_HANDLE;
        return driver_error("vkCreateInstance", result);
    }
    // Loaded separately, so that a failure to load the table leaks nothing.
    owner_functions_.vkDestroyInstance =
        find<PFN_vkDestroyInstance>(get, handle_, "vkDestroyInstance");
    Result<InstanceTable> table = load_instance_table(get, handle_);
    if (!table)
        return table.error();
    functions_ = *table;
    Result<OwnerTable> owners = load_owner_table(get, handle_);
    if (!owners)
        return owners.error();
    owner_functions_ = *owners;
    return Done{};
}

Result<Done> Instance::create_messenger() {
    const auto create = find<PFN_vkCreateDebugUtilsMessengerEXT>(get_instance_proc_addr(), handle_,
                                                                 "vkCreateDebugUtilsMessengerEXT");
    if (create == nullptr)
        return Error{Status::device_lacks,
                     "the Vulkan instance does not provide vkCreateDebugUtilsMessengerEXT"};
    const VkDebugUtilsMessengerCreateInfoEXT info = log_->messenger_info();
    const VkResult result = create(handle_, &info, nullptr, &messenger_);
    if (result != VK_SUCCESS) {
        messenger_ = VK_NULL_HANDLE;
        return vk_error("vkCreateDebugUtilsMessengerEXT", result);
    }
    return Done{};
}

Instance::~Instance() {
    if (messenger_ != VK_NULL_HANDLE) {
        const auto destroy = find<PFN_vkDestroyDebugUtilsMessengerEXT>(
            get_instance_proc_addr(), handle_, "vkDestroyDebugUtilsMessengerEXT");
        if (destroy != nullptr)
            destroy(handle_, messenger_, nullptr);
    }
    if (handle_ != VK_NULL_HANDLE && owner_functions_.vkDestroyInstance != nullptr)
        owner_functions_.vkDestroyInstance(handle_, nullptr);
}

Result<std::vector<FoundDevice>> Instance::find_devices() const {
    std::vector<VkPhysicalDevice> handles;
    const VkResult result = enumerate(handles, [&](auto* count, auto* elements) {
        return owner_functions_.vkEnumeratePhysicalDevices(handle_, count, elements);
    });
    if (result != VK_SUCCESS)
        return driver_error("vkEnumeratePhysicalDevices", result);
    if (handles.empty())
        return no_driver();
    std::vector<FoundDevice> found;
    found.reserve(handles.size());
    for (const VkPhysicalDevice handle : handles) {
        Result<DeviceReport> report = query_device(get_instance_proc_addr(), handle_, handle);
        if (!report)
            return report.error();
        found.push_back({handle, std::move(report).value()});
    }
    return found;
}

} // namespace geodisk
