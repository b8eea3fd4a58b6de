// LitSamples: the disks of samples as the caller numbers them, as large as their cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <geodisk/cells.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/params.hpp>

#include "engine/cells/lit_cells.hpp"

namespace geodisk {

/// Samples and their disks. If several samples are at one place, only the first has a disk.
struct LitSamples {
    /// Checks samples and computes their disks. `mesh` must outlive the result, and what `params`
    /// refers to. `whole` as for LitCells::light().
    static Task<Result<std::unique_ptr<LitSamples>>>
    make(Runner::Impl& runner, const PreparedMesh& mesh, std::span<const Sample> samples,
         CellParams params, WholeProgress whole = {});

    /// Returns a bound on the error of distances, in mesh units.
    double distance_error() const;

    std::size_t all = 0;                ///< Number of samples as the caller numbers them.
    std::vector<std::uint32_t> numbers; ///< Numbers of samples with a disk. Ascending.
    std::vector<Sample> samples;        ///< Those with a disk.
    CellParams params;
    SampleParams job;
    JobFrame frame{};
    std::unique_ptr<LitCells> lit;
};

} // namespace geodisk
