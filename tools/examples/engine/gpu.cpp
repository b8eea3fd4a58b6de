#include "gpu.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

namespace engine {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
// All ranges start at a multiple of it, which is a multiple of what any device asks for.
constexpr VkDeviceSize kAlignment = 256;

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data,
                                          void* count) {
    std::fprintf(stderr, "%s\n", data->pMessage);
    ++*static_cast<std::uint32_t*>(count);
    return VK_FALSE;
}

} // namespace

void check(VkResult result, const char* call) {
    if (result != VK_SUCCESS) {
        throw std::runtime_error(std::string(call) + " failed with " + std::to_string(result));
    }
}

Gpu::Gpu(bool validate) : validate_(validate) {
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pApplicationName = "geodisk engine example";
    application.apiVersion = VK_API_VERSION_1_1;
    VkDebugUtilsMessengerCreateInfoEXT messenger{
        VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                                VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messenger.pfnUserCallback = on_message;
    messenger.pUserData = &complaints_;
    const VkValidationFeatureEnableEXT synchronization =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    features.pNext = &messenger;
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &synchronization;
    const char* const extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME,
                                      VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &application;
    if (validate) {
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &kValidationLayer;
        info.enabledExtensionCount = 2;
        info.ppEnabledExtensionNames = extensions;
    }
    check(vkCreateInstance(&info, nullptr, &instance_), "vkCreateInstance");
    if (validate) {
        const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
        check(create(instance_, &messenger, nullptr, &messenger_),
              "vkCreateDebugUtilsMessengerEXT");
    }
    choose_device();
    const float priority = 1;
    VkDeviceQueueCreateInfo queue_info{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue_info.queueFamilyIndex = family_;
    queue_info.queueCount = 1;
    queue_info.pQueuePriorities = &priority;
    VkDeviceCreateInfo device_info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    device_info.queueCreateInfoCount = 1;
    device_info.pQueueCreateInfos = &queue_info;
    check(vkCreateDevice(physical_device_, &device_info, nullptr, &device_), "vkCreateDevice");
    vkGetDeviceQueue(device_, family_, 0, &queue_);
}

void Gpu::choose_device() {
    std::uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance_, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(instance_, &count, devices.data()),
          "vkEnumeratePhysicalDevices");
    constexpr VkQueueFlags kBoth = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (const VkPhysicalDevice device : devices) {
        // Says all that a device lacks, for a message; here the next one is tried.
        report_ = take(geodisk::query_device(&vkGetInstanceProcAddr, instance_, device));
        std::uint32_t families = 0;
        vkGetPhysicalDeviceQueueFamilyProperties(device, &families, nullptr);
        std::vector<VkQueueFamilyProperties> properties(families);
        vkGetPhysicalDeviceQueueFamilyProperties(device, &families, properties.data());
        const auto found =
            std::find_if(properties.begin(), properties.end(),
                         [](const auto& family) { return (family.queueFlags & kBoth) == kBoth; });
        if (report_.usable() && found != properties.end()) {
            physical_device_ = device;
            family_ = static_cast<std::uint32_t>(found - properties.begin());
            return;
        }
    }
    throw std::runtime_error("no device can run this");
}

Gpu::~Gpu() {
    vkDestroyDevice(device_, nullptr);
    if (messenger_ != VK_NULL_HANDLE) {
        reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(vkGetInstanceProcAddr(
            instance_, "vkDestroyDebugUtilsMessengerEXT"))(instance_, messenger_, nullptr);
    }
    vkDestroyInstance(instance_, nullptr);
}

std::uint32_t Gpu::memory_type(std::uint32_t allowed, VkMemoryPropertyFlags properties) const {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical_device_, &memory);
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        if ((allowed & 1u << i) != 0 &&
            (memory.memoryTypes[i].propertyFlags & properties) == properties) {
            return i;
        }
    }
    throw std::runtime_error("no memory of the kind needed");
}

geodisk::DeviceRefs Gpu::refs() const {
    geodisk::DeviceRefs refs;
    refs.instance = instance_;
    refs.physical_device = physical_device_;
    refs.device = device_;
    refs.get_instance_proc_addr = &vkGetInstanceProcAddr;
    refs.debug_utils = validate_; // Pipelines get names, and stages labels.
    return refs;
}

Block::Block(const Gpu& gpu, VkDeviceSize bytes, VkBufferUsageFlags usage,
             VkMemoryPropertyFlags properties)
    : gpu_(gpu), size_(bytes) {
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = bytes;
    info.usage = usage;
    check(vkCreateBuffer(gpu.device(), &info, nullptr, &buffer_), "vkCreateBuffer");
    VkMemoryRequirements requirements;
    vkGetBufferMemoryRequirements(gpu.device(), buffer_, &requirements);
    VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    allocate.allocationSize = requirements.size;
    allocate.memoryTypeIndex = gpu.memory_type(requirements.memoryTypeBits, properties);
    check(vkAllocateMemory(gpu.device(), &allocate, nullptr, &memory_), "vkAllocateMemory");
    check(vkBindBufferMemory(gpu.device(), buffer_, memory_, 0), "vkBindBufferMemory");
    if ((properties & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0) {
        void* mapped = nullptr;
        check(vkMapMemory(gpu.device(), memory_, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
        mapped_ = static_cast<std::byte*>(mapped);
    }
}

Block::~Block() {
    vkDestroyBuffer(gpu_.device(), buffer_, nullptr);
    vkFreeMemory(gpu_.device(), memory_, nullptr);
}

geodisk::BufferRange Block::cut(VkDeviceSize bytes) {
    if (used_ + bytes > size_) {
        throw std::runtime_error("the engine's memory is too small");
    }
    const geodisk::BufferRange range{buffer_, used_, bytes};
    used_ += (bytes + kAlignment - 1) / kAlignment * kAlignment;
    return range;
}

Frames::Frames(const Gpu& gpu) : gpu_(gpu) {
    VkCommandPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool_info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool_info.queueFamilyIndex = gpu.family();
    check(vkCreateCommandPool(gpu.device(), &pool_info, nullptr, &pool_), "vkCreateCommandPool");
    VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = pool_;
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = kInFlight;
    check(vkAllocateCommandBuffers(gpu.device(), &info, commands_), "vkAllocateCommandBuffers");
    VkFenceCreateInfo fence_info{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    fence_info.flags = VK_FENCE_CREATE_SIGNALED_BIT;
    for (VkFence& fence : fences_) {
        check(vkCreateFence(gpu.device(), &fence_info, nullptr, &fence), "vkCreateFence");
    }
}

Frames::~Frames() {
    vkWaitForFences(gpu_.device(), kInFlight, fences_, VK_TRUE, UINT64_MAX);
    for (const VkFence fence : fences_) {
        vkDestroyFence(gpu_.device(), fence, nullptr);
    }
    vkDestroyCommandPool(gpu_.device(), pool_, nullptr);
}

VkCommandBuffer Frames::begin() {
    turn_ = (turn_ + 1) % kInFlight;
    check(vkWaitForFences(gpu_.device(), 1, &fences_[turn_], VK_TRUE, UINT64_MAX),
          "vkWaitForFences");
    VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands_[turn_], &info), "vkBeginCommandBuffer");
    return commands_[turn_];
}

void Frames::submit() {
    check(vkEndCommandBuffer(commands_[turn_]), "vkEndCommandBuffer");
    check(vkResetFences(gpu_.device(), 1, &fences_[turn_]), "vkResetFences");
    VkSubmitInfo info{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands_[turn_];
    check(vkQueueSubmit(gpu_.queue(), 1, &info, fences_[turn_]), "vkQueueSubmit");
}

void Frames::wait_for_all() const {
    check(vkWaitForFences(gpu_.device(), kInFlight, fences_, VK_TRUE, UINT64_MAX),
          "vkWaitForFences");
}

void barrier(VkCommandBuffer commands, geodisk::SyncScope from, geodisk::SyncScope to) {
    VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    memory.srcAccessMask = from.access;
    memory.dstAccessMask = to.access;
    vkCmdPipelineBarrier(commands, from.stages, to.stages, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

void copy(VkCommandBuffer commands, const geodisk::BufferRange& from,
          const geodisk::BufferRange& to, VkDeviceSize bytes, VkDeviceSize to_offset) {
    const VkBufferCopy region{from.offset, to.offset + to_offset, bytes};
    vkCmdCopyBuffer(commands, from.buffer, to.buffer, 1, &region);
}

} // namespace engine
