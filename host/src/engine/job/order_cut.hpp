// The search for the order below which there is an exact number of candidates.
#pragma once

#include <cstdint>

#include <geodisk/export.hpp>

namespace geodisk {

/// Halves, or better, an interval of orders by counts of the candidates below a guess.
class GEODISK_API OrderCut {
  public:
    /// `drawn` candidates have orders below `end`; `wanted` of them, fewer but not none, take part.
    OrderCut(std::uint32_t end, std::uint32_t drawn, std::uint32_t wanted);

    /// Returns true once end() is the answer.
    bool is_found() const { return is_found_; }
    /// Order to count the candidates below, at least 1.
    std::uint32_t guess() const { return guess_; }
    /// Takes the number of candidates below guess().
    void note(std::uint32_t below);

    /// Candidates below it take part: as many as wanted, or more where several share an order.
    std::uint32_t end() const { return high_; }
    /// Number of those candidates.
    std::uint32_t count() const { return high_count_; }

  private:
    void choose();

    std::uint32_t wanted_;
    std::uint32_t low_ = 0, high_;
    std::uint32_t low_count_ = 0, high_count_;
    std::uint32_t guess_ = 0, guesses_ = 0;
    bool is_found_ = false;
};

} // namespace geodisk
