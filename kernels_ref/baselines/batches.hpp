// The paper's schedule (PSDP, section 4.2) for any metric: batches of active candidates, their
// disks, the decisions. It does sequentially what the shaders do, and counts the cost.
#pragma once

#include <cstdint>
#include <vector>

#include "baselines/call_histogram.hpp"
#include "baselines/disk_query.hpp"

namespace geodisk::ref {

struct BatchRun {
    std::vector<std::uint32_t> ranks; ///< Accepted candidates, ascending.
    std::uint64_t disks = 0;          ///< Disks computed, one per active candidate.
    std::uint32_t batches = 0;
};

/// Runs batches. Activates up to `slots` (the paper's T) idle candidates at a time, in rank order:
/// the lower rank has the higher priority. The set does not depend on `slots`. Adds the calls of
/// CheckStatus of all batches to `calls`, unless it is null.
BatchRun run_batches(DiskQuery& disks, std::uint32_t slots, CallHistogram* calls = nullptr);

} // namespace geodisk::ref
