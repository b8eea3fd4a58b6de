// Doing the meshes of a batch, several at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "files/output/line_log.hpp"
#include "geodisk/batch/batch_items.hpp"
#include "geodisk/batch/device_pool.hpp"
#include "geodisk/outputs/progress.hpp"

namespace geodisk::tools {

struct BatchTotals {
    std::size_t done = 0, failed = 0;
    std::uint64_t samples = 0;
    std::size_t warned = 0; ///< Meshes with warnings.
    double seconds = 0;
};

/// Does `items` on the devices of `pool`, `jobs` at a time, and appends each to `log` once its
/// samples are in their file. What fails is logged and told on standard error, and the others go
/// on; after the loss of a device a mesh is tried once more. Throws UserError where nothing goes
/// on: on a signal, where the log cannot be written, or a device cannot be opened again.
BatchTotals run_batch(std::span<const BatchItem* const> items, int jobs, DevicePool& pool,
                      LineLog& log, ProgressLine& progress);

} // namespace geodisk::tools
