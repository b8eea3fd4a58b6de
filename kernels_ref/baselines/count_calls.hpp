// Counts calls of the paper's CheckStatus (section 5.4, Table 1).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "baselines/call_histogram.hpp"

namespace geodisk::ref {

/// The calls of one candidate are counted up to this number.
inline constexpr std::uint32_t kMaxCalls = 0x3fffffff;

/// Returns the calls of CheckStatus for each candidate of a decided batch: one for itself, and
/// those of every conflict above it, until one of them is accepted. A candidate reached twice
/// counts twice. `above[i]` are the active candidates of lower rank in the disk of candidate i,
/// ascending, as indices into the batch; `accepted[i]` is 1 if it was accepted.
std::vector<std::uint32_t> count_calls(std::span<const std::vector<std::uint32_t>> above,
                                       std::span<const std::uint8_t> accepted);

void add_calls(CallHistogram& histogram, std::span<const std::uint32_t> calls_each);

} // namespace geodisk::ref
