// Random numbers in sequence, for methods that do not know in advance how many they draw.
#pragma once

#include <array>
#include <cstdint>

#include "lib/rng.hpp"

namespace geodisk::ref {

/// A stream of 2^34 words, determined by the seed, and different from those of the candidates with
/// the same seed.
class RandomStream {
  public:
    explicit RandomStream(std::uint64_t seed) : seed_(~seed) {}

    std::uint32_t word() {
        if (used_ == block_.size()) {
            block_ = philox(seed_, {index_++, 0, 0, 0});
            used_ = 0;
        }
        return block_[used_++];
    }

    /// Returns a uniform number in [0, 1), a multiple of 2^-53.
    double uniform() {
        const std::uint64_t high = word();
        return static_cast<double>((high << 32 | word()) >> 11) * 0x1p-53;
    }

    /// Returns a uniform number in [0, count), up to a bias of count / 2^32.
    std::uint32_t below(std::uint32_t count) {
        return static_cast<std::uint32_t>(std::uint64_t{word()} * count >> 32);
    }

  private:
    std::uint64_t seed_;
    std::uint32_t index_ = 0;
    std::array<std::uint32_t, 4> block_{};
    std::size_t used_ = 4;
};

} // namespace geodisk::ref
