// A run whose disks record what they light or reach.
#pragma once

#include <geodisk/domain.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/status.hpp>

#include "engine/run/run.hpp"

namespace geodisk {

/// Runs SurfaceDomain::recording() and waits for it. Returns the report of the run. If
/// DiskRecords::wanted exceeds the records, there was no room for all.
Result<RunReport> record_disks(Runner& runner, const Domain& domain, DiskRecords& records,
                               const ProgressCallback& progress);

} // namespace geodisk
