// Ranks: some of the numbers below a count, in order, and the rank of each among them.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace geodisk {

/// Takes a quarter of a byte for each number below the count.
class Ranks {
  public:
    static constexpr std::uint32_t kNone = ~0u;

    Ranks() = default;
    /// The numbers are those of the items of a range, in any order, and maybe more than once.
    template <class Items, class NumberOf = std::identity>
    Ranks(std::size_t count, const Items& items, const NumberOf& number_of = {})
        : words_((count + kBits - 1) / kBits) {
        for (const auto& item : items) {
            const std::uint32_t number = std::invoke(number_of, item);
            words_[number / kBits].bits |= std::uint64_t{1} << number % kBits;
        }
        for (Word& word : words_) {
            word.before = size_;
            size_ += static_cast<std::uint32_t>(std::popcount(word.bits));
        }
    }

    /// Returns how many numbers there are.
    std::uint32_t size() const { return size_; }
    /// Returns the rank of a number below the count, or kNone.
    std::uint32_t of(std::uint32_t number) const {
        const Word& word = words_[number / kBits];
        const std::uint64_t bit = std::uint64_t{1} << number % kBits;
        return (word.bits & bit) != 0
                   ? word.before + static_cast<std::uint32_t>(std::popcount(word.bits & (bit - 1)))
                   : kNone;
    }
    /// Returns the numbers, ascending.
    std::vector<std::uint32_t> numbers() const {
        std::vector<std::uint32_t> all;
        all.reserve(size_);
        for (std::size_t i = 0; i < words_.size(); ++i) {
            for (std::uint64_t bits = words_[i].bits; bits != 0; bits &= bits - 1) {
                all.push_back(static_cast<std::uint32_t>(kBits * i) +
                              static_cast<std::uint32_t>(std::countr_zero(bits)));
            }
        }
        return all;
    }

  private:
    static constexpr std::size_t kBits = 64;
    struct Word {
        std::uint64_t bits = 0;   ///< One for each of so many numbers.
        std::uint32_t before = 0; ///< Numbers before them.
    };

    std::vector<Word> words_;
    std::uint32_t size_ = 0;
};

} // namespace geodisk
