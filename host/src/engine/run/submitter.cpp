#include "engine/run/submitter.hpp"

#include <algorithm>
#include <cstdint>
#include <thread>
#include <utility>

#include "support/number_text.hpp"
#include "support/try.hpp"
#include "vk/result.hpp"

namespace geodisk {
namespace {

constexpr std::chrono::milliseconds kSlice(50);

} // namespace

Result<Submitter> Submitter::create(const DeviceRefs& device, const DeviceTable& vk,
                                    const QueueRef& queue,
                                    std::chrono::duration<double> stall_limit) {
    Submitter result;
    result.device_ = &device;
    result.vk_ = &vk;
    result.queue_ = queue;
    result.stall_limit_ = stall_limit;
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = queue.family;
    VkResult status = null_unless_success(
        vk.vkCreateCommandPool(device.device, &pool, device.host_allocator, &result.pool_),
        result.pool_);
    if (status != VK_SUCCESS) {
        return vk_error("vkCreateCommandPool", status);
    }
    VkCommandBufferAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocate.commandPool = result.pool_;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    status = vk.vkAllocateCommandBuffers(device.device, &allocate, &result.commands_);
    if (status != VK_SUCCESS) {
        return vk_error("vkAllocateCommandBuffers", status);
    }
    VkFenceCreateInfo fence{};
    fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    status = null_unless_success(
        vk.vkCreateFence(device.device, &fence, device.host_allocator, &result.fence_),
        result.fence_);
    if (status != VK_SUCCESS) {
        return vk_error("vkCreateFence", status);
    }
    return result;
}

Submitter::Submitter(Submitter&& other) noexcept
    : device_(other.device_), vk_(std::exchange(other.vk_, nullptr)), queue_(other.queue_),
      stall_limit_(other.stall_limit_), pool_(other.pool_), commands_(other.commands_),
      fence_(other.fence_), abandoned_(other.abandoned_), lost_(other.lost_) {}

Submitter::~Submitter() {
    if (vk_ != nullptr && !abandoned_) {
        vk_->vkDestroyFence(device_->device, fence_, device_->host_allocator);
        vk_->vkDestroyCommandPool(device_->device, pool_, device_->host_allocator);
    }
}

Error Submitter::failed(const char* call, VkResult result) {
    lost_ = lost_ || result == VK_ERROR_DEVICE_LOST;
    return vk_error(call, result);
}

Result<Done> Submitter::ready() const {
    if (abandoned_) {
        return Error{Status::device_lost, "the device did not respond to an earlier submission"};
    }
    if (lost_) {
        return Error{Status::device_lost, "the device was lost earlier"};
    }
    return Done{};
}

Result<Done> Submitter::run(const std::function<void(VkCommandBuffer)>& record) {
    GEODISK_TRY(submit(record));
    wait();
    return std::move(end_);
}

Result<Done> Submitter::submit(const std::function<void(VkCommandBuffer)>& record) {
    GEODISK_TRY(ready());
    VkResult status = vk_->vkResetCommandPool(device_->device, pool_, 0);
    if (status != VK_SUCCESS) {
        return failed("vkResetCommandPool", status);
    }
    // Reset before each submission, not after: a fence left signalled by a failed call would look
    // like the end of the next submission.
    status = vk_->vkResetFences(device_->device, 1, &fence_);
    if (status != VK_SUCCESS) {
        return failed("vkResetFences", status);
    }
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    status = vk_->vkBeginCommandBuffer(commands_, &begin);
    if (status != VK_SUCCESS) {
        return failed("vkBeginCommandBuffer", status);
    }
    record(commands_);
    status = vk_->vkEndCommandBuffer(commands_);
    if (status != VK_SUCCESS) {
        return failed("vkEndCommandBuffer", status);
    }
    VkSubmitInfo submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands_;
    if (queue_.lock != nullptr) {
        queue_.lock(queue_.lock_user);
    }
    status = vk_->vkQueueSubmit(queue_.queue, 1, &submit, fence_);
    if (queue_.unlock != nullptr) {
        queue_.unlock(queue_.lock_user);
    }
    if (status != VK_SUCCESS) {
        return failed("vkQueueSubmit", status);
    }
    waited_ = {};
    last_look_ = std::chrono::steady_clock::now();
    end_ = Done{};
    in_flight_ = true;
    return Done{};
}

bool Submitter::is_over(std::chrono::milliseconds patience) {
    const auto nanoseconds = static_cast<std::uint64_t>(std::chrono::nanoseconds(patience).count());
    const VkResult status = vk_->vkWaitForFences(device_->device, 1, &fence_, VK_TRUE, nanoseconds);
    in_flight_ = false;
    if (status == VK_SUCCESS) {
        return true;
    }
    if (status == VK_ERROR_DEVICE_LOST) {
        end_ = failed("vkWaitForFences", status);
        return true;
    }
    // Exhausted memory ends the waiting but not the work, whose memory must not be freed yet.
    if (status != VK_TIMEOUT) {
        std::this_thread::sleep_for(patience);
    }
    // Counted in slices, because the clock continues while the process is stopped.
    const auto now = std::chrono::steady_clock::now();
    using Seconds = std::chrono::duration<double>;
    waited_ +=
        patience.count() > 0 ? Seconds(patience) : std::min<Seconds>(now - last_look_, kSlice);
    last_look_ = now;
    if (waited_ > stall_limit_) {
        abandoned_ = true;
        end_ = Error{Status::device_lost,
                     "the device did not respond for " + number_text(stall_limit_.count()) +
                         " seconds",
                     kNoElement, status};
        return true;
    }
    in_flight_ = true;
    return false;
}

void Submitter::wait() {
    while (!is_over(kSlice)) {
    }
}

void Submitter::give_up() {
    waiting_ = nullptr;
    if (in_flight_) {
        wait();
    }
}

} // namespace geodisk
