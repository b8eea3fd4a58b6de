// How hard conflicts among active candidates are to resolve, as the paper measures it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace geodisk {

/// Active candidates by the calls of the paper's CheckStatus that deciding them takes (section 5.4,
/// Table 1): one for the candidate itself, and for every active conflict of higher priority it
/// comes to as many as that one takes, from the highest priority down until one is accepted.
/// Depends on how many candidates are active at a time.
struct CallHistogram {
    /// Of 1, 2, ..., 9 calls, and of 10 or more.
    std::array<std::uint64_t, 10> candidates{};
    std::uint64_t calls = 0; ///< Of all candidates together.

    std::uint64_t total() const {
        return std::accumulate(candidates.begin(), candidates.end(), std::uint64_t{0});
    }
    /// Part of the candidates in a bin; 0 without any.
    double share(std::size_t bin) const { return ratio(candidates[bin]); }
    /// Calls per candidate; 0 without any.
    double mean() const { return ratio(calls); }

  private:
    double ratio(std::uint64_t part) const {
        return total() == 0 ? 0 : static_cast<double>(part) / static_cast<double>(total());
    }
};

} // namespace geodisk
