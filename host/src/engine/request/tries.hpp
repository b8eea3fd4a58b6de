// The distances that are tried until a run gives as many samples as wanted.
#pragma once

#include <cstdint>
#include <optional>

#include <geodisk/count_search.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// One distance, or those that a CountSearch tries.
class Tries {
  public:
    /// Begins at a distance. Without a count, it is the only one.
    Tries(double distance, double count, bool is_exact);

    /// Returns the distance to sample at; nothing if all were tried.
    std::optional<double> distance() const { return distance_; }
    std::uint32_t count() const { return tries_; }

    /// Takes the number of samples at distance(). Returns true if no other distance was better.
    ///
    /// Errors: `invalid_argument` if no room for as many samples is left, since ever smaller
    /// distances give no more, or if the search for an exact count has ended without.
    Result<bool> note(std::uint64_t samples);

  private:
    Result<Done> check_room(std::uint64_t samples);

    double wanted_;
    bool is_exact_;
    CountSearch search_;
    std::optional<double> distance_;
    std::uint32_t tries_ = 0;
    std::uint64_t max_ = 0; ///< Maximum of samples so far.
    std::uint64_t latest_ = 0;
    double largest_ = 0; ///< Largest distance that gave as many samples as the latest.
};

} // namespace geodisk
