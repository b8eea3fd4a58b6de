// Records one command buffer at a time, submits it on the lent queue and waits for it.
#pragma once

#include <chrono>
#include <functional>

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

    /// Records with `record`, submits and waits until the device is done. A submission that does
    /// not end within the stall limit is an error (`device_lost`), after which nothing may be freed
    /// that it uses. After any other error nothing is running.
    Result<Done> run(const std::function<void(VkCommandBuffer)>& record);

    /// An error (`device_lost`) once the device was lost or a submission given up. Nothing is
    /// submitted any more then.
    Result<Done> ready() const;

    /// Whether a submission was given up and may still be running.
    bool abandoned() const noexcept { return abandoned_; }

  private:
    Submitter() = default;
    Error failed(const char* call, VkResult result);
    Result<Done> wait();

    const DeviceRefs* device_ = nullptr;
    const DeviceTable* vk_ = nullptr;
    QueueRef queue_;
    std::chrono::duration<double> stall_limit_{};
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    bool abandoned_ = false;
    bool lost_ = false;
};

} // namespace geodisk
