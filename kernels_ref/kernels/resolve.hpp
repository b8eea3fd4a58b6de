// Twin of shaders/kernels/resolve.comp: decides a batch of active candidates (paper
// section 3.5, CheckStatus).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace geodisk::ref {

/// States of a candidate.
inline constexpr std::uint8_t kIdle = 0;
inline constexpr std::uint8_t kActive = 1;
inline constexpr std::uint8_t kAccepted = 2;
inline constexpr std::uint8_t kRejected = 3;

/// Visits the active ranks upwards: a rank that no accepted one rejected is accepted and rejects
/// all it lists. `ranks` ascend, `conflicts[i]` are the idle and active ranks above ranks[i] in its
/// disk, `states` holds a state per rank and is updated.
void resolve_batch(std::span<const std::uint32_t> ranks,
                   std::span<const std::vector<std::uint32_t>> conflicts,
                   std::span<std::uint8_t> states);

/// Rejects all conflicts of an accepted candidate, or of a sample of an earlier chunk.
void reject_all(std::span<const std::uint32_t> conflicts, std::span<std::uint8_t> states);

} // namespace geodisk::ref
