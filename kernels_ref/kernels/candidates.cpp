#include "kernels/candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "constants.h"
#include "lib/rng.hpp"
#include "lib/scalar.hpp"

namespace geodisk::ref {
namespace {

constexpr std::uint32_t kOneWeight = 1u << 24;

/// In float and integers whatever Real is: how a candidate is drawn is part of its definition.
struct Draw {
    std::uint32_t face;
    std::uint32_t weight1, weight2; ///< In units of 2^-24.

    template <class Real>
    FacePoint<Real> point() const {
        return {face, static_cast<Real>(weight1) * static_cast<Real>(0x1p-24),
                static_cast<Real>(weight2) * static_cast<Real>(0x1p-24)};
    }
};

Draw draw_uniform(std::span<const AliasColumn> alias, const std::array<std::uint32_t, 4>& random) {
    // A 64-bit fraction times the number of faces: the integer part is the column.
    const std::uint64_t low = std::uint64_t{random[0]} * alias.size();
    const std::uint64_t scaled = low + (std::uint64_t{random[1]} * alias.size() >> 32);
    const auto column = static_cast<std::uint32_t>(scaled >> 32);
    const auto fraction = static_cast<std::uint32_t>(scaled);
    const std::uint32_t face = fraction < alias[column].threshold ? column : alias[column].alias;
    // Odd multiples of 2^-24 keep clear of 0 and 1.
    const std::uint32_t alpha = random[2] >> 9 << 1 | 1;
    const std::uint32_t beta = random[3] >> 9 << 1 | 1;
    const float root = std::sqrt(static_cast<float>(alpha) * 0x1p-24f);
    const auto both = static_cast<std::uint32_t>(root * 0x1p24f);
    const auto second = static_cast<std::uint32_t>(std::uint64_t{both} * (kOneWeight - beta) >> 24);
    return {face, second, both - second};
}

/// Makes points as dense as 1 / s^3 in their face, and tells which to keep for 1 / g^2.
template <class Real>
bool propose(Draw& draw, const FaceRadii<Real>& radii, const std::array<std::uint32_t, 4>& random) {
    const float(&s)[3] = radii.spread;
    const float share0 =
        static_cast<float>(kOneWeight - draw.weight1 - draw.weight2) * (s[1] * s[2]);
    const float share1 = static_cast<float>(draw.weight1) * (s[0] * s[2]);
    const float share2 = static_cast<float>(draw.weight2) * (s[0] * s[1]);
    const float sum = share0 + share1 + share2;
    const auto steps = [sum](float share) {
        return static_cast<std::uint32_t>(ratio(share, sum) * 0x1p24f);
    };
    draw.weight1 = std::min(steps(share1), kOneWeight - 1);
    draw.weight2 = std::min(steps(share2), kOneWeight - 1 - draw.weight1);
    const auto [face, weight1, weight2] = draw.point<float>();
    const auto here = [weight1 = weight1, weight2 = weight2](auto a, auto b, auto c) {
        return (1.0f - weight1 - weight2) * static_cast<float>(a) +
               weight1 * static_cast<float>(b) + weight2 * static_cast<float>(c);
    };
    const float spread = here(s[0], s[1], s[2]);
    const float g = 2.0f * here(radii.radius[0], radii.radius[1], radii.radius[2]);
    const std::uint32_t bits = (random[2] & 511u) << 9 | (random[3] & 511u);
    const float fraction = (static_cast<float>(bits) + 0.5f) * 0x1p-18f;
    return fraction * (g * g) < spread * spread * spread;
}

template <class Points, class Draw>
Points draw_pool(std::uint32_t count, const Draw& draw) {
    Points points(count);
    for (std::uint32_t rank = 0; rank < count; ++rank) {
        points[rank] = draw(rank);
    }
    return points;
}

} // namespace

template <class Real>
FacePoint<Real> draw_candidate(std::span<const AliasColumn> alias, std::uint64_t seed,
                               std::uint32_t rank) {
    return draw_uniform(alias, philox(seed, rank)).template point<Real>();
}

template <class Real>
FacePoint<Real> draw_candidate(const Surface<Real>& surface, std::uint64_t seed,
                               std::uint32_t rank) {
    if (!surface.is_adaptive()) {
        return draw_candidate<Real>(surface.alias, seed, rank);
    }
    Draw draw{};
    for (std::uint32_t proposal = 0; proposal < gpu::kMostProposals; ++proposal) {
        const auto random = philox(seed, rank, proposal);
        draw = draw_uniform(surface.alias, random);
        if (propose(draw, surface.radii[draw.face], random)) {
            break;
        }
    }
    return draw.template point<Real>();
}

template <class Real>
std::vector<FacePoint<Real>> draw_candidates(std::span<const AliasColumn> alias, std::uint64_t seed,
                                             std::uint32_t count, std::uint32_t first) {
    return draw_pool<std::vector<FacePoint<Real>>>(
        count, [&](std::uint32_t i) { return draw_candidate<Real>(alias, seed, first + i); });
}

template <class Real>
std::vector<FacePoint<Real>> draw_candidates(const Surface<Real>& surface, std::uint64_t seed,
                                             std::uint32_t count, std::uint32_t first) {
    return draw_pool<std::vector<FacePoint<Real>>>(
        count, [&](std::uint32_t i) { return draw_candidate(surface, seed, first + i); });
}

#define GEODISK_CANDIDATES_OF(Real)                                                                \
    template FacePoint<Real> draw_candidate(std::span<const AliasColumn>, std::uint64_t,           \
                                            std::uint32_t);                                        \
    template FacePoint<Real> draw_candidate(const Surface<Real>&, std::uint64_t, std::uint32_t);   \
    template std::vector<FacePoint<Real>> draw_candidates(                                         \
        std::span<const AliasColumn>, std::uint64_t, std::uint32_t, std::uint32_t);                \
    template std::vector<FacePoint<Real>> draw_candidates(const Surface<Real>&, std::uint64_t,     \
                                                          std::uint32_t, std::uint32_t);
GEODISK_CANDIDATES_OF(float)
GEODISK_CANDIDATES_OF(double)
#undef GEODISK_CANDIDATES_OF

} // namespace geodisk::ref
