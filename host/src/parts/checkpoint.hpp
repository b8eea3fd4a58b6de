// Makes checkpoints together.
#pragma once

#include <cstdint>

#include <geodisk/checkpoint.hpp>
#include <geodisk/exchange.hpp>
#include <geodisk/export.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

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
