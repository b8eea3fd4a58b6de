#include "engine/run/record_disks.hpp"

#include <chrono>

#include "engine/run/runner_impl.hpp"

namespace geodisk {
namespace {

constexpr std::chrono::milliseconds kPatience(50);

} // namespace

Result<RunReport> record_disks(Runner& runner, const Domain& domain, DiskRecords& records,
                               const ProgressCallback& progress) {
    if (auto begun = Runner::Impl::of(runner).begin(domain, &records, progress); !begun) {
        return begun.error();
    }
    for (;;) {
        const auto ended = runner.poll(kPatience);
        if (!ended) {
            return ended.error();
        }
        if (*ended) {
            return (*ended)->report;
        }
    }
}

} // namespace geodisk
