// RangedRows: rows of the samples on a surface that all processes read in ranges.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/sample.hpp>
#include <geodisk/status.hpp>

#include "files/output/output_file.hpp"
#include "files/samples/row_format.hpp"

namespace geodisk::tools {

struct Process;

/// Each process has a block of the rows, in dart order.
struct RangedRows {
    std::vector<SampleRow> own;

    // Properties of all rows, the same on all processes.

    std::uint64_t count = 0, digest = 0;
    SampleBox box;
    RadiusRange radii;
};

struct RowsCall {
    std::span<const Sample> samples; ///< All samples.
    double min_distance;             ///< Minimum distance of the job.
    bool divides;                    ///< Blocks are equally long; else the first process has all.
};

/// Makes the rows of samples on the surface that was read in ranges. Returns those of the process.
RangedRows& make_ranged_rows(Process& process, const RowsCall* call);

struct WriteCall {
    AtomicFile& file;
    const SampleTarget& target;
    const SampleHeader& header;
};

/// Writes all rows in dart order. Each process writes its own rows to the file, but sends them to
/// the first one if some process does not see the file, or it is a stream. Throws
/// SharedError(bad_output) when all have written.
Done write_ranged_rows(Process& process, const WriteCall* call);

} // namespace geodisk::tools
