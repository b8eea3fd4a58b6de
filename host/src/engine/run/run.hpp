// One run, from upload to result.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/run/runner_impl.hpp"
#include "engine/run/task.hpp"
#include "records.h"

namespace geodisk {

/// Runs until window chains are as short as the guard provides for. Runner and domain must outlive
/// it. Where it is destroyed before its end, nothing must be running any more.
Task<Result<SampleSet>> run(Runner::Impl& runner, const Domain& domain);

/// Records of the disks of a domain, by its Ending.
struct DiskRecords {
    std::vector<gpu::LitRec> lights;
    std::vector<gpu::HitRec> hits;
    std::uint32_t wanted = 0; ///< Number of records there would be with room for all.
};

/// Runs a single job, also the first one of a maximal set. `records` is null if candidates are
/// decided.
Task<Result<SampleSet>> run_job(Runner::Impl& runner, const Domain& domain, DiskRecords* records);

} // namespace geodisk
