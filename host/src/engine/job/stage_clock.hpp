// StageClock: device time per stage of a run, from timestamps around the dispatches.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <geodisk/runner.hpp>

#include "vk/dispatch.hpp"

namespace geodisk {

class StageClock {
  public:
    /// Creates a clock. `refs` must outlive it. `period` is nanoseconds per tick, `valid_bits` that
    /// of the queue family, not 0.
    static Result<StageClock> create(const DeviceRefs& refs, float period,
                                     std::uint32_t valid_bits);
    StageClock(StageClock&& other) noexcept;
    StageClock& operator=(StageClock&&) = delete;
    ~StageClock();

    /// Starts the recording of a submission.
    void begin(VkCommandBuffer commands);
    /// Assigns everything recorded since the last call to `stage`.
    void mark(VkCommandBuffer commands, Stage stage);
    /// Adds up the times of the submission, once it is done.
    Result<Done> collect();

    const StageSeconds& seconds() const { return seconds_; }
    void reset() { seconds_ = {}; }
    /// Gives up the queries without destroying them: the device may still be using them.
    void abandon() noexcept { pool_ = VK_NULL_HANDLE; }

  private:
    StageClock() = default;

    const DeviceRefs* refs_ = nullptr;
    QueryTable vk_;
    VkQueryPool pool_ = VK_NULL_HANDLE;
    double seconds_per_tick_ = 0;
    std::uint64_t mask_ = 0;
    std::vector<Stage> stages_; ///< Stage of each query but the first.
    StageSeconds seconds_{};
};

} // namespace geodisk
