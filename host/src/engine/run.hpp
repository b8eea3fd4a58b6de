// One run, from upload to result.
#pragma once

#include "engine/runner_impl.hpp"

namespace geodisk {

/// Runs until window chains are as short as the guard provides for.
Result<SampleSet> run_and_wait(Runner::Impl& runner, const Domain& domain,
                               const ProgressCallback& progress);

} // namespace geodisk
