// How often the paper's CheckStatus would call itself (section 5.4, Table 1).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace geodisk::ref {

/// Calls of CheckStatus that each active candidate of a batch causes when its thread finds all
/// others still active: its own, and recursively one for each candidate of higher priority it comes
/// to until one is accepted. A call for a candidate that the thread has decided before counts, and
/// returns at once. `above[i]` are the candidates of higher priority in the disk of candidate i, as
/// indices into `above` and in the order they are checked; no candidate may be above itself, be it
/// by way of others.
std::vector<std::uint32_t> count_check_calls(std::span<const std::vector<std::uint32_t>> above);

/// How many active candidates cause 1, 2, ..., 9, and 10 or more calls.
struct CallHistogram {
    std::array<std::uint64_t, 10> candidates{};
    std::uint64_t total = 0; ///< Candidates.
    std::uint64_t calls = 0;

    void add(std::span<const std::uint32_t> calls_each);
    double share(std::size_t column) const {
        return total == 0 ? 0
                          : static_cast<double>(candidates[column]) / static_cast<double>(total);
    }
    double mean() const {
        return total == 0 ? 0 : static_cast<double>(calls) / static_cast<double>(total);
    }
};

} // namespace geodisk::ref
