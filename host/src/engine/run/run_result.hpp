// What a run hands over, from what the device wrote.
#pragma once

#include <span>

#include <geodisk/runner.hpp>

#include "engine/domain/domain_impl.hpp"
#include "records.h"

namespace geodisk {

/// Two words of a record that are one count.
constexpr std::uint64_t wide(std::uint32_t low, std::uint32_t high) {
    return std::uint64_t{high} << 32 | low;
}

/// Fills in what the control record counts.
void take_counts(const gpu::ControlRec& control, RunReport& report);

/// The samples of a domain, or its points.
SampleSet to_set(const Domain::Impl& domain, std::span<const gpu::SampleRec> records,
                 const RunReport& report);

} // namespace geodisk
