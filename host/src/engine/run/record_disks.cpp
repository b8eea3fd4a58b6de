#include "engine/run/record_disks.hpp"

#include "engine/run/runner_impl.hpp"

namespace geodisk {

Result<RunReport> record_disks(Runner& runner, const Domain& domain, DiskRecords& records,
                               const ProgressCallback& progress) {
    Runner::Impl& impl = Runner::Impl::of(runner);
    const auto ended = impl.complete(run_job(impl, domain, &records), 0, progress);
    return ended ? Result<RunReport>(ended->report) : Result<RunReport>(ended.error());
}

} // namespace geodisk
