#include "kernels/dart_order.hpp"

#include <array>
#include <utility>

namespace geodisk::ref {
namespace {

/// A digit of a priority, lowest first. It is small enough that a cache line of every bucket stays
/// in the cache.
struct Digit {
    std::uint32_t shift, bits;
};
constexpr std::array<Digit, 3> kDigits{{{0, 10}, {10, 9}, {19, 9}}};
static_assert(kDigits.back().shift + kDigits.back().bits == kPriorityBits);
constexpr std::uint32_t kMaxBuckets = 1u << kDigits[0].bits;

std::uint32_t bucket_of(Dart dart, Digit digit) {
    return priority_of(dart) >> digit.shift & ((1u << digit.bits) - 1);
}

} // namespace

std::span<Dart> sort_darts(std::span<Dart> darts, std::span<Dart> scratch) {
    std::array<std::array<std::uint32_t, kMaxBuckets>, kDigits.size()> starts{};
    for (const Dart dart : darts) {
        for (std::size_t i = 0; i < kDigits.size(); ++i) {
            ++starts[i][bucket_of(dart, kDigits[i])];
        }
    }
    scratch = scratch.first(darts.size());
    for (std::size_t i = 0; i < kDigits.size(); ++i) {
        std::uint32_t sum = 0;
        for (std::uint32_t& start : starts[i]) {
            sum += std::exchange(start, sum);
        }
        for (const Dart dart : darts) {
            scratch[starts[i][bucket_of(dart, kDigits[i])]++] = dart;
        }
        std::swap(darts, scratch);
    }
    return darts;
}

} // namespace geodisk::ref
