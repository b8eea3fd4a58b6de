// Submits all frames of what an engine else records into its own.
#pragma once

#include <geodisk/runner.hpp>

#include "engine/run/runner_impl.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {

/// Submits what `frames.record_next()` records with a runner, one frame at a time, until
/// `frames.is_complete`. `progress_now()` is what to tell of.
template <class Frames, class Now>
Result<Done> run_frames(Frames& frames, Runner& runner, const ProgressCallback& progress,
                        const Now& progress_now) {
    Runner::Impl& with = Runner::Impl::of(runner);
    if (with.work) {
        return invalid("a run of the runner is in progress");
    }
    while (!frames.is_complete) {
        Result<bool> recorded = false;
        const auto submitted = with.submitter->run(
            [&](VkCommandBuffer commands) { recorded = frames.record_next(commands, 1); });
        GEODISK_TRY(submitted);
        GEODISK_TRY(recorded);
        if (progress && !progress(progress_now())) {
            return Error{Status::cancelled, "cancelled"};
        }
    }
    return Done{};
}

} // namespace geodisk
