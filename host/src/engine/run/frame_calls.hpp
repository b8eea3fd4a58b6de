// FrameCalls: what recording into the frames of an engine has in flight.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/sampler.hpp>
#include <geodisk/status.hpp>

#include "engine/run/frame_growth.hpp"
#include "support/invalid.hpp"

namespace geodisk {

/// Copies, as barriers name them.
inline constexpr SyncScope kCopies{VK_PIPELINE_STAGE_TRANSFER_BIT,
                                   VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT};

/// Checks what the options of all that records frames have; `type` is their name.
template <class Options>
Result<Done> check_frame_options(const char* type, const Options& options) {
    if (options.frames == 0 || options.frames > kMaxFrames) {
        return invalid(std::string(type) + "::frames is " + std::to_string(options.frames) +
                       ", not from 1 to " + std::to_string(kMaxFrames));
    }
    if (options.readers.stages == 0) {
        return invalid(std::string(type) + "::readers has no stage");
    }
    return Done{};
}

/// Counts the calls that record a frame each, and keeps old memory until no frame uses it. The
/// command buffer of `lag` calls ago has completed.
template <class Memory>
class FrameCalls {
  public:
    explicit FrameCalls(std::uint32_t frames) : frames_(frames) {}

    std::uint64_t count() const { return count_; }
    void end_call() { ++count_; }
    /// Returns true if the frame of an earlier call has completed.
    bool has_completed(std::uint64_t call, std::uint32_t lag) const { return count_ >= call + lag; }
    /// Returns the place of what this call copies to the host, or the one of `lag` calls ago.
    std::uint32_t place(std::uint32_t lag = 0) const {
        return static_cast<std::uint32_t>((count_ - lag) % frames_);
    }

    /// Begins with new memory, which is to be uploaded.
    void begin_memory() {
        is_uploaded_ = false;
        is_staged_ = true;
    }
    void note_upload() {
        is_uploaded_ = true;
        upload_ = count_;
    }
    bool is_uploaded() const { return is_uploaded_; }
    /// Returns the call that uploaded the memory.
    std::uint64_t upload() const { return upload_; }
    /// Returns true if the frame that uploads the memory has completed.
    bool is_filled(std::uint32_t lag) const { return is_uploaded_ && has_completed(upload_, lag); }

    /// Keeps memory that frames up to this call use.
    void retire(Memory old) { retired_.push_back({std::move(old), count_}); }
    /// Frees old memory that no frame uses any more. Returns true once the staging of the current
    /// memory is to be freed too.
    bool free_unused(std::uint32_t lag) {
        std::erase_if(retired_, [&](const Retired& old) { return has_completed(old.call, lag); });
        return is_filled(lag) && std::exchange(is_staged_, false);
    }
    /// Calls visit for all old memory.
    template <class Visit>
    void for_retired(const Visit& visit) const {
        for (const Retired& old : retired_) {
            visit(old.memory);
        }
    }

  private:
    struct Retired {
        Memory memory;
        std::uint64_t call; ///< Number of calls when the last frame that uses it was recorded.
    };

    std::uint32_t frames_;
    std::vector<Retired> retired_;
    std::uint64_t count_ = 0;
    std::uint64_t upload_ = 0;
    bool is_uploaded_ = false;
    bool is_staged_ = true; ///< True while the staging of the memory exists.
};

} // namespace geodisk
