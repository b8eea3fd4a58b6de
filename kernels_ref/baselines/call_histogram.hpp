// CallHistogram: work to resolve conflicts among active candidates, as the paper measures it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace geodisk {

/// Histogram of active candidates by calls of the paper's CheckStatus (section 5.4, Table 1).
///
/// Deciding a candidate takes one call for itself. It then takes the calls of each active conflict
/// of higher priority, from the highest priority down, until one of them is accepted. The figures
/// depend on the number of candidates that are active at a time.
struct CallHistogram {
    /// Number of candidates that take 1, 2, ..., 9 calls, and 10 or more.
    std::array<std::uint64_t, 10> candidates{};
    std::uint64_t calls = 0; ///< Calls of all candidates together.

    /// Returns the number of candidates in all bins.
    std::uint64_t total() const {
        return std::accumulate(candidates.begin(), candidates.end(), std::uint64_t{0});
    }
    /// Returns the share of the candidates in a bin, 0 to 1; 0 if there are no candidates.
    double share(std::size_t bin) const { return ratio(candidates[bin]); }
    /// Returns the mean number of calls per candidate; 0 if there are no candidates.
    double mean() const { return ratio(calls); }

  private:
    double ratio(std::uint64_t part) const {
        return total() == 0 ? 0 : static_cast<double>(part) / static_cast<double>(total());
    }
};

} // namespace geodisk
