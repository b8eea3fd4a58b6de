// Records one command buffer at a time, submits it on the lent queue and waits for it.
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
    /// `device` and `vk` must outlive the submitter.
    static Result<Submitter> create(const DeviceRefs& device, const DeviceTable& vk,
                                    const QueueRef& queue,
                                    std::chrono::duration<double> stall_limit);
    Submitter(Submitter&& other) noexcept;
    Submitter& operator=(Submitter&&) = delete;
    ~Submitter();

    /// Records with `record`, submits and waits until the device is done, as the two below.
    Result<Done> run(const std::function<void(VkCommandBuffer)>& record);

    /// Records with `record` and submits. After an error nothing is running.
    Result<Done> submit(const std::function<void(VkCommandBuffer)>& record);
    /// Awaits the end of what was submitted, as is_over() finds it.
    auto ended() {
        struct Awaiter {
            Submitter& own;
            bool await_ready() noexcept { return false; }
            void await_suspend(std::coroutine_handle<> waiting) noexcept { own.waiting_ = waiting; }
            Result<Done> await_resume() { return std::move(own.end_); }
        };
        return Awaiter{*this};
    }
    /// Waits so long for the end of what was submitted. Over it is as well where the device was
    /// lost, and where that took longer than the stall limit: an error (`device_lost`) to whoever
    /// awaits it, after which nothing may be freed that it uses.
    bool is_over(std::chrono::milliseconds patience);
    /// Goes on with whoever awaits that, if somebody does.
    void resume() {
        if (const auto waiting = std::exchange(waiting_, nullptr)) {
            waiting.resume();
        }
    }
    bool is_awaited() const noexcept { return waiting_ != nullptr; }
    /// Nobody awaits it any more: waits for the end of what is in flight, so that all that it uses
    /// may be freed.
    void give_up();
    /// Signalled at the end of what was submitted.
    VkFence fence() const noexcept { return fence_; }

    /// An error (`device_lost`) once the device was lost or a submission given up. Nothing is
    /// submitted any more then.
    Result<Done> ready() const;

    /// Whether a submission was given up and may still be running.
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
    Result<Done> end_ = Done{};              ///< Of what was submitted last.
    std::chrono::duration<double> waited_{}; ///< For that.
    std::chrono::steady_clock::time_point last_look_;
    bool in_flight_ = false;
    bool abandoned_ = false;
    bool lost_ = false;
};

} // namespace geodisk
