#include "picture/gpu.hpp"

#include <algorithm>
#include <cstring>
#include <string>
#include <thread>

#include "program/failure.hpp"

namespace geodisk::tools::picture {
namespace {

constexpr std::chrono::milliseconds kPause{1};
constexpr VkDeviceSize kStaging = VkDeviceSize{16} << 20;

template <class Function>
Function load(PFN_vkGetInstanceProcAddr get, VkInstance instance, const char* name) {
    const auto function = reinterpret_cast<Function>(get(instance, name));
    if (function == nullptr) {
        throw UserError(ExitCode::no_device, std::string("the Vulkan driver lacks ") + name);
    }
    return function;
}

[[noreturn]] void fail_stalled() {
    throw UserError(ExitCode::internal, "the device stopped responding while drawing");
}

} // namespace

void check(VkResult result, const char* call) {
    if (result == VK_SUCCESS) {
        return;
    }
    const bool memory =
        result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY;
    throw UserError(memory ? ExitCode::out_of_memory : ExitCode::internal,
                    std::string(call) +
                        (memory ? " found too little memory"
                         : result == VK_ERROR_DEVICE_LOST
                             ? " found the device lost"
                             : " failed with VkResult " + std::to_string(result)) +
                        " while drawing");
}

Gpu::Gpu(const DeviceRefs& device, const QueueRef& queue, std::chrono::nanoseconds stall_limit)
    : device_(device.device), queue_(queue), stall_limit_(stall_limit) {
    const auto get = device.get_instance_proc_addr;
    const auto get_device =
        load<PFN_vkGetDeviceProcAddr>(get, device.instance, "vkGetDeviceProcAddr");
#define GEODISK_PICTURE_LOAD(name)                                                                 \
    vk_.name = reinterpret_cast<PFN_##name>(get_device(device_, #name));                           \
    if (vk_.name == nullptr) {                                                                     \
        throw UserError(ExitCode::no_device, "the Vulkan driver lacks " #name);                    \
    }
    GEODISK_PICTURE_DEVICE_FUNCTIONS(GEODISK_PICTURE_LOAD)
#undef GEODISK_PICTURE_LOAD
    VkPhysicalDeviceProperties properties;
    load<PFN_vkGetPhysicalDeviceProperties>(get, device.instance, "vkGetPhysicalDeviceProperties")(
        device.physical_device, &properties);
    limits_ = properties.limits;
    load<PFN_vkGetPhysicalDeviceMemoryProperties>(
        get, device.instance, "vkGetPhysicalDeviceMemoryProperties")(device.physical_device,
                                                                     &memory_);
    VkFormatProperties depth; // Each device has this or the other one.
    load<PFN_vkGetPhysicalDeviceFormatProperties>(
        get, device.instance, "vkGetPhysicalDeviceFormatProperties")(device.physical_device,
                                                                     VK_FORMAT_D32_SFLOAT, &depth);
    if ((depth.optimalTilingFeatures & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT) != 0) {
        depth_format_ = VK_FORMAT_D32_SFLOAT;
    }
    auto info = structure<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    info.queueFamilyIndex = queue.family;
    VkCommandPool pool = VK_NULL_HANDLE;
    check(vk_.vkCreateCommandPool(device_, &info, nullptr, &pool), "vkCreateCommandPool");
    pool_ = {*this, pool};
    auto allocate =
        structure<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocate.commandPool = pool;
    allocate.commandBufferCount = 1;
    check(vk_.vkAllocateCommandBuffers(device_, &allocate, &commands_), "vkAllocateCommandBuffers");
    const auto unsignaled = structure<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    VkFence fence = VK_NULL_HANDLE;
    check(vk_.vkCreateFence(device_, &unsignaled, nullptr, &fence), "vkCreateFence");
    fence_ = {*this, fence};
}

VkDeviceMemory Gpu::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags required,
                             VkMemoryPropertyFlags preferred) const {
    for (const VkMemoryPropertyFlags wanted : {required | preferred, required}) {
        for (std::uint32_t type = 0; type < memory_.memoryTypeCount; ++type) {
            if ((needs.memoryTypeBits >> type & 1) == 0 ||
                (memory_.memoryTypes[type].propertyFlags & wanted) != wanted) {
                continue;
            }
            auto info = structure<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
            info.allocationSize = needs.size;
            info.memoryTypeIndex = type;
            VkDeviceMemory memory = VK_NULL_HANDLE;
            check(vk_.vkAllocateMemory(device_, &info, nullptr, &memory), "vkAllocateMemory");
            return memory;
        }
    }
    throw UserError(ExitCode::no_device, "the device has no memory of a kind that drawing needs");
}

void Gpu::run(const std::function<void(VkCommandBuffer)>& record) const {
    if (is_given_up_) {
        fail_stalled();
    }
    check(vk_.vkResetCommandPool(device_, pool_.get(), 0), "vkResetCommandPool");
    auto begin = structure<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vk_.vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
    record(commands_);
    check(vk_.vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
    const VkFence fence = fence_.get();
    check(vk_.vkResetFences(device_, 1, &fence), "vkResetFences");
    auto submit = structure<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands_;
    if (queue_.lock != nullptr) {
        queue_.lock(queue_.lock_user);
    }
    const VkResult submitted = vk_.vkQueueSubmit(queue_.queue, 1, &submit, fence);
    if (queue_.unlock != nullptr) {
        queue_.unlock(queue_.lock_user);
    }
    check(submitted, "vkQueueSubmit");
    wait(fence);
}

void Gpu::wait(VkFence fence) const {
    const auto deadline = std::chrono::steady_clock::now() + stall_limit_;
    for (;;) {
        const VkResult waited = vk_.vkWaitForFences(
            device_, 1, &fence, VK_TRUE, static_cast<std::uint64_t>(stall_limit_.count()));
        if (waited == VK_SUCCESS || waited == VK_ERROR_DEVICE_LOST) {
            check(waited, "vkWaitForFences");
            return;
        }
        // Without memory to wait with, the work goes on all the same.
        if (waited == VK_TIMEOUT || std::chrono::steady_clock::now() >= deadline) {
            is_given_up_ = true;
            fail_stalled();
        }
        std::this_thread::sleep_for(kPause);
    }
}

Buffer::Buffer(const Gpu& gpu, VkDeviceSize size, VkBufferUsageFlags usage, bool is_mapped)
    : size_(size) {
    auto info = structure<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = size;
    info.usage = usage;
    VkBuffer buffer = VK_NULL_HANDLE;
    check(gpu.vk().vkCreateBuffer(gpu.device(), &info, nullptr, &buffer), "vkCreateBuffer");
    buffer_ = {gpu, buffer};
    VkMemoryRequirements needs;
    gpu.vk().vkGetBufferMemoryRequirements(gpu.device(), buffer, &needs);
    const VkMemoryPropertyFlags visible =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    memory_ = is_mapped
                  ? Memory(gpu, gpu.allocate(needs, visible, VK_MEMORY_PROPERTY_HOST_CACHED_BIT))
                  : Memory(gpu, gpu.allocate(needs, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT));
    check(gpu.vk().vkBindBufferMemory(gpu.device(), buffer, memory_.get(), 0),
          "vkBindBufferMemory");
    if (is_mapped) {
        void* mapped = nullptr;
        check(gpu.vk().vkMapMemory(gpu.device(), memory_.get(), 0, VK_WHOLE_SIZE, 0, &mapped),
              "vkMapMemory");
        mapped_ = static_cast<std::byte*>(mapped);
    }
}

Buffer make_storage(const Gpu& gpu, std::span<const std::byte> bytes) {
    Buffer buffer(gpu, std::max<VkDeviceSize>(bytes.size(), 4),
                  VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, false);
    if (bytes.empty()) {
        return buffer;
    }
    const Buffer staging(gpu, std::min<VkDeviceSize>(bytes.size(), kStaging),
                         VK_BUFFER_USAGE_TRANSFER_SRC_BIT, true);
    for (std::size_t at = 0; at < bytes.size(); at += kStaging) {
        const VkBufferCopy copy{0, at, std::min<VkDeviceSize>(bytes.size() - at, kStaging)};
        std::memcpy(staging.bytes().data(), bytes.data() + at, copy.size);
        gpu.run([&](VkCommandBuffer commands) {
            gpu.vk().vkCmdCopyBuffer(commands, staging.get(), buffer.get(), 1, &copy);
            auto barrier = structure<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
            barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
            barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT;
            gpu.vk().vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                          VK_PIPELINE_STAGE_VERTEX_SHADER_BIT |
                                              VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
                                          0, 1, &barrier, 0, nullptr, 0, nullptr);
        });
    }
    return buffer;
}

Image::Image(const Gpu& gpu, VkFormat format, VkExtent2D size, VkImageUsageFlags usage,
             VkImageAspectFlags aspect) {
    auto info = structure<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {size.width, size.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = usage;
    VkImage image = VK_NULL_HANDLE;
    check(gpu.vk().vkCreateImage(gpu.device(), &info, nullptr, &image), "vkCreateImage");
    image_ = {gpu, image};
    VkMemoryRequirements needs;
    gpu.vk().vkGetImageMemoryRequirements(gpu.device(), image, &needs);
    memory_ = {gpu, gpu.allocate(needs, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)};
    check(gpu.vk().vkBindImageMemory(gpu.device(), image, memory_.get(), 0), "vkBindImageMemory");
    auto view = structure<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    view.image = image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format;
    view.subresourceRange = {aspect, 0, 1, 0, 1};
    VkImageView created = VK_NULL_HANDLE;
    check(gpu.vk().vkCreateImageView(gpu.device(), &view, nullptr, &created), "vkCreateImageView");
    view_ = {gpu, created};
}

} // namespace geodisk::tools::picture
