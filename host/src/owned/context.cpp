#include <geodisk/context.hpp>

#include <mutex>
#include <utility>
#include <vector>

#include "owned/context_access.hpp"
#include "owned/instance.hpp"
#include "owned/pipeline_cache.hpp"
#include "support/guard.hpp"
#include "vk/extensions.hpp"
#include "vk/result.hpp"

namespace geodisk {
namespace {

// The header that defines it is still beta and not installed everywhere.
constexpr const char* kPortabilitySubset = "VK_KHR_portability_subset";

std::vector<DeviceReport> take_reports(std::vector<FoundDevice>&& found) {
    std::vector<DeviceReport> reports;
    reports.reserve(found.size());
    for (FoundDevice& device : found)
        reports.push_back(std::move(device.report));
    return reports;
}

/// Optional extensions to enable.
struct Extensions {
    bool memory_budget = false;
    bool pipeline_statistics = false;
};

/// Creates a device with one queue of `family` and the extensions in `enabled`. Enables no optional
/// features except theirs, not even robustBufferAccess: the kernels check their indices.
Result<VkDevice> create_device(const Instance& instance, VkPhysicalDevice physical_device,
                               std::uint32_t family, const Extensions& enabled) {
    const Result<bool> portability =
        has_device_extension(instance.functions(), physical_device, kPortabilitySubset);
    if (!portability)
        return portability.error();

    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    const VkPhysicalDeviceFeatures no_features{};
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.pEnabledFeatures = &no_features;
    std::vector<const char*> extensions;
    if (*portability) { // If it is listed, Vulkan requires that it be enabled.
        extensions.push_back(kPortabilitySubset);
    }
    if (enabled.memory_budget) {
        extensions.push_back(VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
    }
    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR statistics{};
    statistics.sType =
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR;
    statistics.pipelineExecutableInfo = VK_TRUE; // Every device with the extension supports it.
    if (enabled.pipeline_statistics) {
        extensions.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
        info.pNext = &statistics;
    }
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    VkDevice device = VK_NULL_HANDLE;
    const VkResult result =
        instance.owner_functions().vkCreateDevice(physical_device, &info, nullptr, &device);
    if (result != VK_SUCCESS)
        return vk_error("vkCreateDevice", result);
    return device;
}

} // namespace

struct Context::Impl {
    std::unique_ptr<Instance> instance;
    DeviceReport report;
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    std::uint32_t family = 0;
    Extensions extensions;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    PFN_vkDestroyDevice vkDestroyDevice = nullptr;
    std::mutex queue_mutex;
    PipelineCache cache;

    Impl() = default;
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() {
        cache.close();
        if (device != VK_NULL_HANDLE && vkDestroyDevice != nullptr)
            vkDestroyDevice(device, nullptr);
    }

    Result<Done> choose_family(bool graphics);
    Result<Done> choose_extensions(const ContextOptions& options);
    Result<Done> open_device();
    void open_cache();
};

Result<Done> Context::Impl::choose_family(bool graphics) {
    const auto& found = graphics ? report.graphics_queue_family : report.compute_queue_family;
    if (!found)
        return Error{Status::device_lacks,
                     report.name + " has no queue family for graphics and compute"};
    family = *found;
    return Done{};
}

/// Enables extensions that the device has. Fails if it lacks one that an option requires.
Result<Done> Context::Impl::choose_extensions(const ContextOptions& options) {
    const InstanceTable& vk = instance->functions();
    const Result<bool> budget =
        has_device_extension(vk, physical_device, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
    if (!budget)
        return budget.error();
    extensions.memory_budget = *budget;
    if (options.pipeline_statistics) {
        constexpr const char* kNeeded = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
        const Result<bool> statistics = has_device_extension(vk, physical_device, kNeeded);
        if (!statistics)
            return statistics.error();
        if (!*statistics)
            return Error{Status::device_lacks, report.name + " does not offer " + kNeeded +
                                                   ", which reports statistics of kernels"};
        extensions.pipeline_statistics = true;
    }
    return Done{};
}

/// Creates the device for `physical_device` and `report`.
Result<Done> Context::Impl::open_device() {
    const OwnerTable& vk = instance->owner_functions();
    const Result<VkDevice> created = create_device(*instance, physical_device, family, extensions);
    if (!created)
        return created.error();
    device = *created;
    vkDestroyDevice =
        reinterpret_cast<PFN_vkDestroyDevice>(vk.vkGetDeviceProcAddr(device, "vkDestroyDevice"));
    const auto get_queue =
        reinterpret_cast<PFN_vkGetDeviceQueue>(vk.vkGetDeviceProcAddr(device, "vkGetDeviceQueue"));
    if (vkDestroyDevice == nullptr || get_queue == nullptr)
        return Error{Status::device_lacks, "the Vulkan device does not provide basic functions"};
    get_queue(device, family, 0, &queue);
    return Done{};
}

/// Opens the pipeline cache of the user, if there is to be one.
void Context::Impl::open_cache() {
    const auto folder = cache_folder();
    if (!folder)
        return;
    VkPhysicalDeviceProperties properties{};
    instance->functions().vkGetPhysicalDeviceProperties(physical_device, &properties);
    cache.open(device, instance->owner_functions().vkGetDeviceProcAddr,
               PipelineFile(*folder, properties));
}

Result<Context> ContextAccess::create(Loader loader, const ContextOptions& options) noexcept {
    return guarded([&]() -> Result<Context> {
        Result<std::unique_ptr<Instance>> instance = Instance::create(
            std::move(loader), {options.validation, options.on_validation_message});
        if (!instance)
            return std::move(instance).error();
        Result<std::vector<FoundDevice>> found = (*instance)->find_devices();
        if (!found)
            return std::move(found).error();

        std::vector<VkPhysicalDevice> handles;
        for (const FoundDevice& device : *found)
            handles.push_back(device.handle);
        std::vector<DeviceReport> reports = take_reports(std::move(found).value());
        Result<std::size_t> chosen = select_device(reports, options.device);
        if (!chosen)
            return std::move(chosen).error();

        auto impl = std::make_unique<Context::Impl>();
        impl->instance = std::move(instance).value();
        impl->physical_device = handles[*chosen];
        impl->report = std::move(reports[*chosen]);
        Result<Done> family = impl->choose_family(options.graphics);
        if (!family)
            return std::move(family).error();
        Result<Done> extensions = impl->choose_extensions(options);
        if (!extensions)
            return std::move(extensions).error();
        Result<Done> opened = impl->open_device();
        if (!opened)
            return std::move(opened).error();
        if (options.keep_pipelines)
            impl->open_cache();
        return Context(std::move(impl));
    });
}

Result<std::vector<DeviceReport>> ContextAccess::list(Loader loader) noexcept {
    return guarded([&]() -> Result<std::vector<DeviceReport>> {
        Result<std::unique_ptr<Instance>> instance = Instance::create(std::move(loader), {});
        if (!instance)
            return std::move(instance).error();
        Result<std::vector<FoundDevice>> found = (*instance)->find_devices();
        if (!found)
            return std::move(found).error();
        return take_reports(std::move(found).value());
    });
}

Result<std::vector<DeviceReport>> list_devices() noexcept {
    Result<Loader> loader = Loader::open();
    if (!loader)
        return std::move(loader).error();
    return ContextAccess::list(std::move(loader).value());
}

Result<Context> Context::create(const ContextOptions& options) noexcept {
    Result<Loader> loader = Loader::open();
    if (!loader)
        return std::move(loader).error();
    return ContextAccess::create(std::move(loader).value(), options);
}

Context::Context(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;
Context::~Context() = default;

DeviceRefs Context::device() const noexcept {
    DeviceRefs refs;
    refs.instance = impl_->instance->handle();
    refs.physical_device = impl_->physical_device;
    refs.device = impl_->device;
    refs.get_instance_proc_addr = impl_->instance->get_instance_proc_addr();
    refs.api_version = Instance::kApiVersion;
    refs.pipeline_cache = impl_->cache.handle();
    refs.memory_budget = impl_->extensions.memory_budget;
    refs.pipeline_statistics = impl_->extensions.pipeline_statistics;
    refs.debug_utils = impl_->instance->validation_log() != nullptr;
    return refs;
}

QueueRef Context::queue() const noexcept {
    QueueRef ref;
    ref.queue = impl_->queue;
    ref.family = impl_->family;
    ref.lock_user = &impl_->queue_mutex;
    ref.lock = [](void* mutex) { static_cast<std::mutex*>(mutex)->lock(); };
    ref.unlock = [](void* mutex) { static_cast<std::mutex*>(mutex)->unlock(); };
    return ref;
}

const DeviceReport& Context::report() const noexcept {
    return impl_->report;
}

std::size_t Context::validation_message_count() const noexcept {
    const ValidationLog* log = impl_->instance->validation_log();
    return log != nullptr ? log->count() : 0;
}

Result<std::vector<std::string>> Context::validation_messages() const noexcept {
    return guarded([&]() -> Result<std::vector<std::string>> {
        const ValidationLog* log = impl_->instance->validation_log();
        return log != nullptr ? log->messages() : std::vector<std::string>{};
    });
}

} // namespace geodisk
