// Checkpoints: what all processes have agreed upon, to go on from later.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include <geodisk/export.hpp>
#include <geodisk/status.hpp>

#include "parts/darts.hpp"
#include "parts/exchange.hpp"

namespace geodisk {

/// Samples of the stages that are decided, of all processes.
struct Checkpoint {
    /// First stage that is not decided; kNoStage if all are.
    std::uint32_t first_stage = 0;
    /// Candidates of all processes in the stages before. Of a job that is done, those up to the
    /// last sample.
    std::uint64_t candidates = 0;
    Darts samples; ///< In dart order, without those that were given.
};
inline constexpr std::uint32_t kNoStage = std::numeric_limits<std::uint32_t>::max();

/// Saves a checkpoint. An error ends the work of all processes.
using SaveCheckpoint = std::function<Result<Done>(const Checkpoint& checkpoint)>;

/// Start of a job and the way it is saved, known to the first process alone.
struct Checkpoints {
    const Checkpoint* from = nullptr; ///< Checkpoint to continue from; null to begin.
    SaveCheckpoint save;              ///< Null if it is not saved.
    std::uint32_t stages = 1;         ///< Stages from one checkpoint to the next, at least 1.
};

/// Facts about checkpoints that all processes know.
struct CheckpointTerms {
    bool is_saved = false;         ///< The first process saves them.
    std::uint32_t stages = 1;      ///< Checkpoints::stages.
    std::uint32_t first_stage = 0; ///< Stage where the job continues; 0 to begin.
    std::uint64_t candidates = 0;  ///< Candidates of all processes in the stages before.
    std::uint64_t samples = 0;     ///< Likewise.

    CheckpointTerms() = default;
    /// Those of a job; null for one without checkpoints.
    explicit CheckpointTerms(const Checkpoints* checkpoints);
};

/// Adds samples of all processes, those of the latest stages, to a checkpoint of the first process
/// and saves it. All call it; `save` is null on all but the first. Errors, the same on all
/// processes: those of `save` and of the exchange.
GEODISK_API Result<Done> save_stages(Exchange& exchange, const Darts& own, Checkpoint& all,
                                     bool has_keys, const SaveCheckpoint& save);

/// Saves a checkpoint on the first process, where `save` is not null. All call it. Errors as above.
GEODISK_API Result<Done> save_on_first(Exchange& exchange, const Checkpoint& checkpoint,
                                       const SaveCheckpoint& save);

} // namespace geodisk
