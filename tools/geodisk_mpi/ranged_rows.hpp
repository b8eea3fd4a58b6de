// RangedRows: rows of the samples on a surface that all processes read in ranges.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include <geodisk/exchange.hpp>
#include <geodisk/sample.hpp>
#include <geodisk/status.hpp>

#include "files/samples/row_format.hpp"
#include "ranged_parts.hpp"

namespace geodisk::tools {

/// Each process has a block of the rows, in dart order. All processes make the same calls.
class RangedRows {
  public:
    /// Makes the rows of `samples`. The first process has all of them, and the distance of the job;
    /// the others give nothing. Blocks are equally long, or the first process has all if `divides`
    /// is false there. Errors: those of the exchange.
    static Result<RangedRows> make(Exchange& exchange, RangedParts& parts,
                                   std::span<const Sample> samples, double min_distance,
                                   bool divides);

    std::vector<SampleRow>& own() { return own_; }

    // Properties of all rows, the same on all processes.

    std::uint64_t count() const { return count_; }
    std::uint64_t digest() const { return digest_; }
    const SampleBox& box() const { return box_; }
    const RadiusRange& radii() const { return radii_; }

    /// Writes all rows in dart order behind what `file` has, which is null but at the first
    /// process, as is its `path` empty: AtomicFile::share(). Each process writes its own rows
    /// there, but sends them to the first one if some process does not see the file, or it is a
    /// stream. Errors, the same on all: `internal` with the reason why a process cannot write;
    /// those of the exchange. Throws UserError at the first process as AtomicFile does, when all
    /// have written.
    Result<Done> write(Exchange& exchange, const RowFormat& format, AtomicFile* file,
                       const std::filesystem::path& path) const;

  private:
    std::vector<SampleRow> own_;
    std::uint64_t count_ = 0, digest_ = 0;
    SampleBox box_;
    RadiusRange radii_;
};

} // namespace geodisk::tools
