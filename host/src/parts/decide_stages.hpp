// The stages of a job, one after the other, decided by all processes.
#pragma once

#include <cstdint>

#include <geodisk/exchange.hpp>
#include <geodisk/status.hpp>

#include "parts/agree.hpp"
#include "parts/checkpoint.hpp"
#include "parts/part.hpp"
#include "parts/part_run.hpp"

namespace geodisk {

/// Report on the stages. It is the same on all processes, except for own candidates.
struct StagesReport {
    /// Candidates that this process decided, without those before the checkpoint it continued from.
    std::uint64_t own_candidates = 0;
    std::uint64_t before = 0;     ///< Candidates of all processes before those drawn last.
    std::uint64_t candidates = 0; ///< Candidates of all processes.
    bool is_stopped = false;      ///< There are as many samples as SampleParams::stop_count.
    AgreementReport agreement;
};

/// Decides the candidates of all stages that take part: all of a pool, or up to an exact number of
/// darts, or until there are enough samples. All processes call it. `reached` is the checkpoint
/// that the job goes on from, on the first process; there it is saved by `save` after some stages,
/// unless they are the last. Errors: those of agree() and save_stages().
Result<StagesReport> decide_stages(Exchange& exchange, Part& part, PartRun& run,
                                   Checkpoint& reached, const SaveCheckpoint& save);

} // namespace geodisk
