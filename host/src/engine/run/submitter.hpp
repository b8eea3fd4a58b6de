// Submitter: records one command buffer at a time, submits it on the caller's queue and waits for
// it.
#pragma once

#include <chrono>
#include <coroutine>
#include <functional>
#include <utility>

#include <geodisk/device.hpp>

#include "vk/dispatch.hpp"

namespace geodisk {

class Submitter {
  public:
    /// Creates a submitter. `device` and `vk` must outlive it.
    static Result<Submitter> create(const DeviceRefs& device, const DeviceTable& vk,
                                    const QueueRef& queue,
                                    std::chrono::duration<double> stall_limit);
    Submitter(Submitter&& other) noexcept;
    Submitter& operator=(Submitter&&) = delete;
    ~Submitter();

    /// Records with `record`, submits, and waits until the device is done.
    Result<Done> run(const std::function<void(VkCommandBuffer)>& record);

    /// Records with `record` and submits. After an error nothing is running.
    Result<Done> submit(const std::function<void(VkCommandBuffer)>& record);
    /// Awaits the end of the submission.
    auto ended() {
        struct Awaiter {
            Submitter& own;
            bool await_ready() noexcept { return false; }
            void await_suspend(std::coroutine_handle<> waiting) noexcept { own.waiting_ = waiting; }
            Result<Done> await_resume() { return std::move(own.end_); }
        };
        return Awaiter{*this};
    }
    /// Waits at most this long for the end of the submission, and returns true once it has ended.
    /// It also ends if the device is lost or the stall limit exceeded: whoever awaits it then gets
    /// `device_lost`, and nothing that it uses may be freed.
    bool is_over(std::chrono::milliseconds patience);
    /// Resumes the coroutine that awaits the submission, if there is one.
    void resume() {
        if (const auto waiting = std::exchange(waiting_, nullptr)) {
            waiting.resume();
        }
    }
    bool is_awaited() const noexcept { return waiting_ != nullptr; }
    /// Waits for the end of the submission in flight, which nobody awaits any more. Afterwards
    /// everything that it used may be freed.
    void give_up();
    /// Returns the fence that is signalled at the end of the submission.
    VkFence fence() const noexcept { return fence_; }
    const QueueRef& queue() const noexcept { return queue_; }

    /// Returns `device_lost` after the device was lost or a submission given up. Nothing is
    /// submitted any more then.
    Result<Done> ready() const;

    /// Returns true if a submission was given up and may still be running.
    bool abandoned() const noexcept { return abandoned_; }

  private:
    Submitter() = default;
    Error failed(const char* call, VkResult result);
    void wait();

    const DeviceRefs* device_ = nullptr;
    const DeviceTable* vk_ = nullptr;
    QueueRef queue_;
    std::chrono::duration<double> stall_limit_{};
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    std::coroutine_handle<> waiting_;
    Result<Done> end_ = Done{};              ///< Outcome of the latest submission.
    std::chrono::duration<double> waited_{}; ///< Time waited for it.
    std::chrono::steady_clock::time_point last_look_;
    bool in_flight_ = false;
    bool abandoned_ = false;
    bool lost_ = false;
};

} // namespace geodisk
