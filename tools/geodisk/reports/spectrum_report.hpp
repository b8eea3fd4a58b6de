// Report of the commands on power spectra: to people, to programs and as a table.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/spectrum_rings.hpp"
#include "geodisk/reports/json_type.hpp"

namespace geodisk::tools {

/// The rings of some sets, told in minimum distances.
struct SpectrumReport {
    std::vector<std::string> samples_files;
    double samples = 0; ///< On average.
    double min_distance = 0;
    std::vector<analysis::SpectrumRing> rings;
    /// The anisotropy if no direction is another than the others.
    double expected_anisotropy = 0;

    std::size_t sets() const { return samples_files.size(); }

    /// Lines for people: how many samples, power, anisotropy.
    std::string text() const;
    /// After what the caller tells of the domain.
    void add_to(Json& report) const;
    /// One row per ring.
    std::string csv() const;
};

} // namespace geodisk::tools
