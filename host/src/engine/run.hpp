// One run, from upload to result.
#pragma once

#include <vector>

#include "engine/run_source.hpp"
#include "engine/runner_impl.hpp"
#include "records.h"

namespace geodisk {

struct RunResult {
    std::vector<gpu::SampleRec> samples; ///< In dart-throwing order.
    RunReport report;
};

/// Of a run on a surface.
SampleSet to_samples(const RunResult& result);

/// Runs until window chains are as short as the guard provides for.
Result<RunResult> run_and_wait(Runner::Impl& runner, const RunSource& source,
                               const ProgressCallback& progress);

} // namespace geodisk
