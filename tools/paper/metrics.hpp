// Samples by the metrics that the paper compares, and how they do by exact distances.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "paper/pool.hpp"

namespace geodisk::paper {

enum class Metric : std::size_t {
    exact,    ///< Geodesic distance.
    straight, ///< Through space.
    curve,    ///< The closed form of Bowers et al. 2010.
};
inline constexpr std::array<Metric, 3> kMetrics{Metric::exact, Metric::straight, Metric::curve};

/// "exact", "straight line" or "closed form".
const char* name_of(Metric metric);

/// The ranks that sequential dart throwing accepts, ascending.
std::vector<std::uint32_t> throw_darts(const PaperMesh& mesh, const Pool& pool, Metric metric);

/// Pairs that are closer than they should be.
struct Violations {
    std::size_t pairs = 0;
    std::size_t samples = 0; ///< In at least one such pair.
};

/// Sums over repetitions.
struct Tally {
    double samples = 0;
    double pairs = 0; ///< Too close.
    double close = 0; ///< Samples in them.

    void add(std::size_t count, const Violations& violations) {
        samples += static_cast<double>(count);
        pairs += static_cast<double>(violations.pairs);
        close += static_cast<double>(violations.samples);
    }
    double close_percent() const { return 100 * close / samples; }
};

/// Compares the exact distances of samples with `min_distance`, to a billionth.
Violations find_violations(const PaperMesh& mesh,
                           const std::vector<ref::FacePoint<double>>& samples, double min_distance);

} // namespace geodisk::paper
