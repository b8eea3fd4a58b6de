// Samples a tetrahedron in frames of its own with FrameSampler, and reads the samples back from the
// buffer that an engine would draw from. Needs geodisk and the Vulkan loader.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include <geodisk/context.hpp>
#include <geodisk/frame_sampler.hpp>
#include <geodisk/shaders/samples.h>

#include <vulkan/vulkan.h>

namespace {

[[noreturn]] void fail(const char* what, const char* message) {
    std::fprintf(stderr, "%s: %s\n", what, message);
    std::exit(EXIT_FAILURE);
}

template <class T>
T take(geodisk::Result<T> result) {
    if (!result) {
        fail(to_string(result.error().status), result.error().message.c_str());
    }
    return std::move(*result);
}

void check(VkResult result, const char* what) {
    if (result != VK_SUCCESS) {
        fail(what, "failed");
    }
}

// Two frames in flight, each with a command buffer and a fence. The device is one of geodisk's own
// here; an engine has one already.
class Frames {
  public:
    static constexpr std::uint32_t kInFlight = 2;

    explicit Frames(const geodisk::Context& context)
        : device_(context.device().device), queue_(context.queue()) {
        VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
        pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
        pool.queueFamilyIndex = queue_.family;
        check(vkCreateCommandPool(device_, &pool, nullptr, &pool_), "vkCreateCommandPool");
        VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        allocate.commandPool = pool_;
        allocate.commandBufferCount = kInFlight;
        check(vkAllocateCommandBuffers(device_, &allocate, commands_), "vkAllocateCommandBuffers");
        VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
        fence.flags = VK_FENCE_CREATE_SIGNALED_BIT;
        for (VkFence& one : fences_) {
            check(vkCreateFence(device_, &fence, nullptr, &one), "vkCreateFence");
        }
    }
    ~Frames() {
        wait();
        for (const VkFence fence : fences_) {
            vkDestroyFence(device_, fence, nullptr);
        }
        vkDestroyCommandPool(device_, pool_, nullptr);
    }
    Frames(const Frames&) = delete;
    Frames& operator=(const Frames&) = delete;

    // Waits until the frame of two calls ago has ended, then records and submits one.
    template <class Record>
    void next(const Record& record) {
        const std::uint32_t turn = count_++ % kInFlight;
        check(vkWaitForFences(device_, 1, &fences_[turn], VK_TRUE, UINT64_MAX), "vkWaitForFences");
        check(vkResetFences(device_, 1, &fences_[turn]), "vkResetFences");
        VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        check(vkBeginCommandBuffer(commands_[turn], &begin), "vkBeginCommandBuffer");
        record(commands_[turn]);
        check(vkEndCommandBuffer(commands_[turn]), "vkEndCommandBuffer");
        VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
        submit.commandBufferCount = 1;
        submit.pCommandBuffers = &commands_[turn];
        check(vkQueueSubmit(queue_.queue, 1, &submit, fences_[turn]), "vkQueueSubmit");
    }
    void wait() { vkWaitForFences(device_, kInFlight, fences_, VK_TRUE, UINT64_MAX); }

  private:
    VkDevice device_;
    geodisk::QueueRef queue_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_[kInFlight] = {};
    VkFence fences_[kInFlight] = {};
    std::uint32_t count_ = 0;
};

// Returns what the buffer holds, by way of one that the host sees.
std::vector<geodisk::gpu::PlacedRec> read(const geodisk::Context& context, Frames& frames,
                                          const geodisk::FrameSamples& samples) {
    const VkDevice device = context.device().device;
    const VkDeviceSize bytes = samples.ready * sizeof(geodisk::gpu::PlacedRec);
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = bytes;
    info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    VkBuffer buffer = VK_NULL_HANDLE;
    check(vkCreateBuffer(device, &info, nullptr, &buffer), "vkCreateBuffer");
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device, buffer, &needs);
    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(context.device().physical_device, &memory);
    constexpr VkMemoryPropertyFlags kWanted =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    std::uint32_t type = 0;
    while (type < memory.memoryTypeCount &&
           ((needs.memoryTypeBits & 1u << type) == 0 ||
            (memory.memoryTypes[type].propertyFlags & kWanted) != kWanted)) {
        ++type;
    }
    VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    allocate.allocationSize = needs.size;
    allocate.memoryTypeIndex = type;
    VkDeviceMemory granted = VK_NULL_HANDLE;
    check(vkAllocateMemory(device, &allocate, nullptr, &granted), "vkAllocateMemory");
    check(vkBindBufferMemory(device, buffer, granted, 0), "vkBindBufferMemory");
    frames.next([&](VkCommandBuffer commands) {
        const VkBufferCopy region{samples.placed_offset, 0, bytes};
        vkCmdCopyBuffer(commands, samples.buffer, buffer, 1, &region);
    });
    frames.wait();
    void* mapped = nullptr;
    check(vkMapMemory(device, granted, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
    std::vector<geodisk::gpu::PlacedRec> records(samples.ready);
    std::memcpy(records.data(), mapped, bytes);
    vkDestroyBuffer(device, buffer, nullptr);
    vkFreeMemory(device, granted, nullptr);
    return records;
}

} // namespace

int main() {
    const std::vector<double> positions = {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1};
    const std::vector<std::uint32_t> triangles = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
    const geodisk::MeshView view{positions, triangles};
    const auto mesh = take(geodisk::PreparedMesh::prepare(view));
    const geodisk::MeshRequest request{&mesh,
                                       {.params = {.min_distance = 0.2, .seed = 7}, .view = &view}};

    const auto context = take(geodisk::Context::create());
    const auto sampler =
        std::make_shared<const geodisk::Sampler>(take(geodisk::Sampler::create(context.device())));
    geodisk::FrameSamplerOptions options;
    options.frames = Frames::kInFlight;
    auto samples = take(geodisk::FrameSampler::create(sampler, {&request, 1}, options));
    Frames frames(context); // Ends before the samples do.

    while (!samples.samples().is_complete) {
        frames.next([&](VkCommandBuffer commands) {
            take(samples.record(commands));
            // Here an engine draws: vkCmdDrawIndirect(commands, samples.samples().buffer,
            // samples.samples().arguments_offset, 1, 0).
        });
    }

    std::printf("%u samples\n", samples.samples().ready);
    for (const geodisk::gpu::PlacedRec& p : read(context, frames, samples.samples())) {
        std::printf("%g %g %g\n", static_cast<double>(p.x), static_cast<double>(p.y),
                    static_cast<double>(p.z));
    }
}
