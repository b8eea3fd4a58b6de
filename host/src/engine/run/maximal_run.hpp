// A maximal set: the samples of a pool, and those that still fit.
#pragma once

#include "engine/domain/domain_impl.hpp"
#include "engine/run/runner_impl.hpp"
#include "engine/run/task.hpp"

namespace geodisk {

/// Runs all jobs of a maximal set. Runner and job must outlive it.
Task<Result<SampleSet>> run_maximal(Runner::Impl& runner, const MaximalJob& job);

} // namespace geodisk
