// One run, from upload to result.
#pragma once

#include "engine/run/runner_impl.hpp"
#include "engine/run/task.hpp"

namespace geodisk {

/// Runs until window chains are as short as the guard provides for. Runner and domain must outlive
/// it. Where it is destroyed before its end, nothing must be running any more.
Task<Result<SampleSet>> run(Runner::Impl& runner, const Domain& domain);

} // namespace geodisk
