// Device time per stage of a run, by timestamps around the dispatches.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <geodisk/runner.hpp>

#include "vk/dispatch.hpp"

namespace geodisk {

class StageClock {
  public:
    /// `refs` must outlive the clock. `period` is in nanoseconds per tick, `valid_bits` of
    /// the queue family, not 0.
    static Result<StageClock> create(const DeviceRefs& refs, float period,
                                     std::uint32_t valid_bits);
    StageClock(StageClock&& other) noexcept;
    StageClock& operator=(StageClock&&) = delete;
    ~StageClock();

    /// Starts the recording of a submission.
    void begin(VkCommandBuffer commands);
    /// All that was recorded since the last call belongs to `stage`.
    void mark(VkCommandBuffer commands, Stage stage);
    /// Adds up what the submission took, once it is done.
    Result<Done> collect();

    const StageSeconds& seconds() const { return seconds_; }
    void reset() { seconds_ = {}; }
    /// The device may be using the queries for ever: keep them.
    void abandon() noexcept { pool_ = VK_NULL_HANDLE; }

  private:
    StageClock() = default;

    const DeviceRefs* refs_ = nullptr;
    QueryTable vk_;
    VkQueryPool pool_ = VK_NULL_HANDLE;
    double seconds_per_tick_ = 0;
    std::uint64_t mask_ = 0;
    std::vector<Stage> stages_; ///< Of the queries written, but the first.
    StageSeconds seconds_{};
};

} // namespace geodisk
