// RangedParts: the parts of a process on a surface that all processes read in ranges.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <geodisk/params.hpp>
#include <geodisk/process_report.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/status.hpp>

#include "mpi_exchange.hpp"
#include "parts/ranges/ranged_surface.hpp"
#include "parts/sample_parts.hpp"
#include "ply_range.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// Chooses the number of parts of each process for a mesh of so many faces. `asked` is 0 for a
/// choice by the memory that a part takes.
std::uint32_t parts_of_process(std::uint64_t faces, std::uint32_t processes, std::uint32_t asked);

/// A process with several parts holds the mesh of one at a time, and decides one after another.
/// Each has a thread, which mostly waits. All processes make the same calls.
class RangedParts {
  public:
    /// Ends all processes by what a thread throws, of which others never hear. Does not return.
    using Fails = std::function<void(std::exception_ptr)>;

    /// Reads the ranges of a mesh file, and what a job takes from it. Errors: those of
    /// read_ply_range() and RangedSurface::create().
    static Result<RangedParts> read(MPI_Comm communicator, const MpiExchange::GoesOn& goes_on,
                                    Fails fails, std::uint32_t parts, const Path& path,
                                    const RangeWants& wants);

    /// Returns what all know of the surface.
    const RangedSurface& surface() const { return *lanes_.front().surface; }

    /// As sample_ranges().
    Result<SharedSamples> sample(Runner& runner, const SampleParams& params,
                                 const Checkpoints* checkpoints, const ProgressCallback& progress);

    /// Returns the places of some faces and their radii, without spreads. They are given in
    /// ascending order, each with corners of its own: all at one process, nothing elsewhere.
    Result<FacePlaces> places(std::span<const std::uint32_t> faces, std::uint32_t process);

  private:
    struct Lane {
        std::unique_ptr<MpiExchange> exchange;
        std::optional<RangedSurface> surface;
    };
    explicit RangedParts(Fails fails) : fails_(std::move(fails)) {}
    /// Does work for each part, on a thread of its own. Returns the result of the first one.
    template <class Work>
    auto all(const Work& work);

    Fails fails_;
    std::vector<Lane> lanes_;
};

} // namespace geodisk::tools
