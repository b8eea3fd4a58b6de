// Report of `geodisk conformance`: to people, to programs, and as lines of golden_sets.txt.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <geodisk/context.hpp>
#include <geodisk/sampler.hpp>

#include "geodisk/conformance/golden_set.hpp"

namespace geodisk::tools {

/// Refers to what it is given, which must outlive it.
class ConformanceReport {
  public:
    ConformanceReport(const DeviceReport& device, const Tuning& tuning,
                      std::span<const GoldenSet> sets, std::span<const FoundSet> found)
        : device_(device), tuning_(tuning), sets_(sets), found_(found) {}

    /// Number of sets that are as they should be.
    std::size_t same() const;

    /// The conformance record: one JSON object and a line break.
    std::string json() const;

    std::string summary() const;

    /// The sets as found.
    std::string lines() const;

  private:
    const DeviceReport& device_;
    const Tuning& tuning_;
    std::span<const GoldenSet> sets_;
    std::span<const FoundSet> found_;
};

} // namespace geodisk::tools
