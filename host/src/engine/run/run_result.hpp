// Converts results of the device to those of a run.
#pragma once

#include <span>

#include <geodisk/runner.hpp>

#include "engine/domain/domain_impl.hpp"
#include "records.h"

namespace geodisk {

/// Returns the 64-bit count of two words.
constexpr std::uint64_t wide(std::uint32_t low, std::uint32_t high) {
    return std::uint64_t{high} << 32 | low;
}

/// Copies the counts of the control record.
void take_counts(const gpu::ControlRec& control, RunReport& report);

/// Returns the samples of a surface or the points of a box.
SampleSet to_set(const Domain::Impl& domain, std::span<const gpu::SampleRec> records,
                 const RunReport& report);

} // namespace geodisk
