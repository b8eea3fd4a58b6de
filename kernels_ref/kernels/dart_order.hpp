// Dart order of the candidates of a stage.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

namespace geodisk::ref {

inline constexpr std::uint32_t kPriorityBits = 28;
/// Number of stages that order words distinguish.
inline constexpr std::uint32_t kStagesPerWord = 16;

/// Returns the order word of a candidate: the stage, counted from the first of the pool, and the
/// priority.
constexpr std::uint32_t order_word(std::uint32_t stage, std::uint32_t priority) {
    return stage % kStagesPerWord << kPriorityBits | priority;
}

/// The priority of a candidate in the high word, its index in the low word.
using Dart = std::uint64_t;

constexpr Dart make_dart(std::uint32_t priority, std::uint32_t candidate) {
    return Dart{priority} << 32 | candidate;
}
constexpr std::uint32_t priority_of(Dart dart) {
    return static_cast<std::uint32_t>(dart >> 32);
}
constexpr std::uint32_t candidate_of(Dart dart) {
    return static_cast<std::uint32_t>(dart);
}

/// Sorts by priority; equal darts keep their order. `scratch` is at least as large. Returns where
/// the result is, in one of the two.
std::span<Dart> sort_darts(std::span<Dart> darts, std::span<Dart> scratch);

/// Sorts runs of equal priority in sorted darts by `comes_before(a, b)` of the candidates.
template <class ComesBefore>
void settle_ties(std::span<Dart> darts, const ComesBefore& comes_before) {
    for (std::size_t first = 0, end = 0; first < darts.size(); first = end) {
        while (end < darts.size() && priority_of(darts[end]) == priority_of(darts[first])) {
            ++end;
        }
        if (end - first > 1) {
            std::sort(&darts[first], &darts[first] + (end - first), [&](Dart a, Dart b) {
                return comes_before(candidate_of(a), candidate_of(b));
            });
        }
    }
}

} // namespace geodisk::ref
