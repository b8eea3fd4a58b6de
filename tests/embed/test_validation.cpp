// The validation layer is truly on, with synchronization validation, when it was asked for.
#include <doctest/doctest.h>

#include <algorithm>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include <geodisk/context.hpp>

#include "fake_driver.hpp"
#include "owned/context_access.hpp"
#include "vk/dispatch.hpp"

using namespace geodisk;

namespace {

ContextOptions with_validation() {
    ContextOptions options;
    options.validation = true;
    return options;
}

bool any_contains(const std::vector<std::string>& messages, const std::string& part) {
    return std::any_of(messages.begin(), messages.end(), [&](const std::string& message) {
        return message.find(part) != std::string::npos;
    });
}

VkBufferCreateInfo buffer_info(VkDeviceSize size) {
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = size;
    info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    return info;
}

/// Makes a mistake that the core checks find, whatever the driver thinks of it.
void create_empty_buffer(const Context& context) {
    const DeviceRefs refs = context.device();
    const Result<DeviceTable> vk = load_device_table(refs);
    REQUIRE(vk);
    const VkBufferCreateInfo info = buffer_info(0);
    VkBuffer buffer = VK_NULL_HANDLE;
    if (vk->vkCreateBuffer(refs.device, &info, nullptr, &buffer) == VK_SUCCESS)
        vk->vkDestroyBuffer(refs.device, buffer, nullptr);
}

/// A buffer with memory, and a command buffer in recording.
struct Recording {
    explicit Recording(const Context& context) : device(context.device().device) {
        const Result<DeviceTable> loaded = load_device_table(context.device());
        REQUIRE(loaded);
        vk = *loaded;
        const VkBufferCreateInfo info = buffer_info(256);
        REQUIRE(vk.vkCreateBuffer(device, &info, nullptr, &buffer) == VK_SUCCESS);
        VkMemoryRequirements needs{};
        vk.vkGetBufferMemoryRequirements(device, buffer, &needs);
        VkMemoryAllocateInfo memory_info{};
        memory_info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
        memory_info.allocationSize = needs.size;
        while ((needs.memoryTypeBits >> memory_info.memoryTypeIndex & 1u) == 0)
            ++memory_info.memoryTypeIndex;
        REQUIRE(vk.vkAllocateMemory(device, &memory_info, nullptr, &memory) == VK_SUCCESS);
        REQUIRE(vk.vkBindBufferMemory(device, buffer, memory, 0) == VK_SUCCESS);

        VkCommandPoolCreateInfo pool_info{};
        pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
        pool_info.queueFamilyIndex = context.queue().family;
        REQUIRE(vk.vkCreateCommandPool(device, &pool_info, nullptr, &pool) == VK_SUCCESS);
        VkCommandBufferAllocateInfo allocate_info{};
        allocate_info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        allocate_info.commandPool = pool;
        allocate_info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
        allocate_info.commandBufferCount = 1;
        REQUIRE(vk.vkAllocateCommandBuffers(device, &allocate_info, &commands) == VK_SUCCESS);
        VkCommandBufferBeginInfo begin{};
        begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        REQUIRE(vk.vkBeginCommandBuffer(commands, &begin) == VK_SUCCESS);
    }

    ~Recording() {
        vk.vkEndCommandBuffer(commands);
        vk.vkDestroyCommandPool(device, pool, nullptr);
        vk.vkDestroyBuffer(device, buffer, nullptr);
        vk.vkFreeMemory(device, memory, nullptr);
    }

    void fill() { vk.vkCmdFillBuffer(commands, buffer, 0, VK_WHOLE_SIZE, 7); }

    void barrier() {
        VkMemoryBarrier memory_barrier{};
        memory_barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
        memory_barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
        memory_barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
        vk.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1, &memory_barrier, 0, nullptr,
                                0, nullptr);
    }

    DeviceTable vk;
    VkDevice device;
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
};

} // namespace

TEST_CASE("the validation layer reports a known mistake") {
    std::mutex mutex;
    std::vector<std::string> received;
    ContextOptions options = with_validation();
    options.on_validation_message = [&](std::string_view message) {
        const std::lock_guard lock(mutex);
        received.emplace_back(message);
    };
    const Result<Context> context = Context::create(options);
    REQUIRE(context);
    CHECK(context->validation_message_count() == 0);
    create_empty_buffer(*context);
    CHECK(context->validation_message_count() >= 1);
    const auto messages = context->validation_messages();
    REQUIRE(messages);
    CHECK(any_contains(*messages, "VUID-VkBufferCreateInfo-size-00912"));
    CHECK(received == *messages);
}

TEST_CASE("synchronization validation is on and silent about correct work") {
    const Result<Context> context = Context::create(with_validation());
    REQUIRE(context);
    Recording recording(*context);
    recording.fill();
    recording.barrier();
    recording.fill();
    CHECK(context->validation_message_count() == 0);
    recording.fill();
    CHECK(any_contains(context->validation_messages().value(), "SYNC-HAZARD-WRITE-AFTER-WRITE"));
}

TEST_CASE("the number of validation messages kept is bounded, the count is not") {
    const Result<Context> context = Context::create(with_validation());
    REQUIRE(context);
    for (int i = 0; i < 300; ++i)
        create_empty_buffer(*context);
    CHECK(context->validation_messages()->size() <= 256);
    CHECK(context->validation_message_count() >= context->validation_messages()->size());
}

TEST_CASE("what a message callback throws is dropped") {
    ContextOptions options = with_validation();
    options.on_validation_message = [](std::string_view) { throw std::runtime_error("mine"); };
    const Result<Context> context = Context::create(options);
    REQUIRE(context);
    create_empty_buffer(*context);
    CHECK(context->validation_message_count() >= 1);
}

TEST_CASE("objects left behind are reported when the context ends") {
    std::vector<std::string> received;
    ContextOptions options = with_validation();
    options.on_validation_message = [&](std::string_view message) {
        received.emplace_back(message);
    };
    {
        const Result<Context> context = Context::create(options);
        REQUIRE(context);
        const DeviceRefs refs = context->device();
        const Result<DeviceTable> vk = load_device_table(refs);
        REQUIRE(vk);
        VkFenceCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        VkFence leaked = VK_NULL_HANDLE;
        REQUIRE(vk->vkCreateFence(refs.device, &info, nullptr, &leaked) == VK_SUCCESS);
    }
    // The same rule by two numbers: layers since 2023 use the second.
    CHECK((any_contains(received, "VUID-vkDestroyDevice-device-00378") ||
           any_contains(received, "VUID-vkDestroyDevice-device-05137")));
}

TEST_CASE("validation without the layer is refused") {
    test::FakeDriver driver;
    driver.hide_layers = true;
    const Result<Context> context = ContextAccess::create(driver.loader(), with_validation());
    REQUIRE_FALSE(context);
    CHECK(context.error().status == Status::device_lacks);
    CHECK(context.error().message.find("VK_LAYER_KHRONOS_validation") != std::string::npos);
    CHECK(driver.live_instances() == 0);
}
