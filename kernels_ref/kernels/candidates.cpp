#include "kernels/candidates.hpp"

#include <cmath>

#include "lib/rng.hpp"

namespace geodisk::ref {

template <class Real>
FacePoint<Real> draw_candidate(std::span<const AliasColumn> alias, std::uint64_t seed,
                               std::uint32_t rank) {
    const auto random = philox(seed, rank);
    // A 64-bit fraction times the number of faces: the integer part is the column.
    const std::uint64_t low = std::uint64_t{random[0]} * alias.size();
    const std::uint64_t scaled = low + (std::uint64_t{random[1]} * alias.size() >> 32);
    const auto column = static_cast<std::uint32_t>(scaled >> 32);
    const auto fraction = static_cast<std::uint32_t>(scaled);
    const std::uint32_t face = fraction < alias[column].threshold ? column : alias[column].alias;
    // Odd multiples of 2^-24 keep clear of 0 and 1.
    const std::uint32_t alpha = random[2] >> 9 << 1 | 1;
    const std::uint32_t beta = random[3] >> 9 << 1 | 1;
    // In float whatever Real is: the map is part of the candidate's definition.
    const float root = std::sqrt(static_cast<float>(alpha) * 0x1p-24f);
    const auto both = static_cast<std::uint32_t>(root * 0x1p24f);
    const auto second =
        static_cast<std::uint32_t>(std::uint64_t{both} * ((1u << 24) - beta) >> 24);
    return {face, static_cast<Real>(second) * static_cast<Real>(0x1p-24),
            static_cast<Real>(both - second) * static_cast<Real>(0x1p-24)};
}

template <class Real>
std::vector<FacePoint<Real>> draw_candidates(std::span<const AliasColumn> alias, std::uint64_t seed,
                                             std::uint32_t count, std::uint32_t first) {
    std::vector<FacePoint<Real>> points(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        points[i] = draw_candidate<Real>(alias, seed, first + i);
    }
    return points;
}

template FacePoint<float> draw_candidate(std::span<const AliasColumn>, std::uint64_t,
                                         std::uint32_t);
template FacePoint<double> draw_candidate(std::span<const AliasColumn>, std::uint64_t,
                                          std::uint32_t);
template std::vector<FacePoint<float>> draw_candidates(std::span<const AliasColumn>, std::uint64_t,
                                                       std::uint32_t, std::uint32_t);
template std::vector<FacePoint<double>> draw_candidates(std::span<const AliasColumn>, std::uint64_t,
                                                        std::uint32_t, std::uint32_t);

} // namespace geodisk::ref
