// Process: what a process of a session keeps from one operation to the next.
#pragma once

#include <optional>

#include <geodisk/mpi.hpp>

#include "geodisk/device_run.hpp"
#include "geodisk/options/sample_options.hpp"
#include "messages.hpp"
#include "ranged_rows.hpp"

namespace geodisk::tools {

struct Process {
    Processes all;
    Messages messages{all.exchange()};
    /// Job by the arguments, on all but the first process; null if they are none of a job.
    const SampleJob* job = nullptr;
    std::optional<RunDevice> device{};      ///< Device of all but the first process.
    std::optional<SharedSurface> surface{}; ///< Surface that was read in ranges.
    RangedRows rows{};                      ///< Rows of the samples on it.
};

} // namespace geodisk::tools
