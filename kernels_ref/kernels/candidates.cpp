#include "kernels/candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "constants.h"
#include "kernels/poisson.hpp"
#include "lib/rng.hpp"
#include "lib/scalar.hpp"

namespace geodisk::ref {
namespace {

constexpr std::uint32_t kOneWeight = 1u << 24;
/// Takes the place of a candidate's attempt in the counter for the number of candidates of a face.
constexpr std::uint32_t kCountCounter = 0xffffffff;
/// Priorities are the high 28 bits of a word.
constexpr std::uint32_t kPriorityShift = 4;

/// A draw, in float and integers whatever Real is: drawing is part of the definition of a
/// candidate.
struct Draw {
    std::uint32_t face;
    std::uint32_t weight1, weight2; ///< Weights in units of 2^-24.

    template <class Real>
    FacePoint<Real> point() const {
        return {face, static_cast<Real>(weight1) * static_cast<Real>(0x1p-24),
                static_cast<Real>(weight2) * static_cast<Real>(0x1p-24)};
    }
};

Draw draw_uniform(std::uint32_t face, const std::array<std::uint32_t, 4>& random) {
    // Odd multiples of 2^-24 are never 0 or 1.
    const std::uint32_t alpha = random[2] >> 9 << 1 | 1;
    const std::uint32_t beta = random[3] >> 9 << 1 | 1;
    const float root = std::sqrt(static_cast<float>(alpha) * 0x1p-24f);
    const auto both = static_cast<std::uint32_t>(root * 0x1p24f);
    const auto second = static_cast<std::uint32_t>(std::uint64_t{both} * (kOneWeight - beta) >> 24);
    return {face, second, both - second};
}

/// Interpolates linearly at a point of the face.
template <class Value>
float interpolated(const Draw& draw, const Value (&corners)[3]) {
    const auto [face, weight1, weight2] = draw.point<float>();
    return (1.0f - weight1 - weight2) * static_cast<float>(corners[0]) +
           weight1 * static_cast<float>(corners[1]) + weight2 * static_cast<float>(corners[2]);
}

/// Makes points as dense as 1 / s^3 in their face, and decides which to keep for 1 / g^2.
template <class Real>
bool propose_by_factors(Draw& draw, const FaceRadii<Real>& radii, float fraction) {
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
    const float spread = interpolated(draw, s);
    const float g = 2.0f * interpolated(draw, radii.corner);
    return fraction * (g * g) < spread * spread * spread;
}

/// Returns the share of candidates that gives this share of the samples that fit: a nearly full
/// surface takes many more.
float share_of_candidates(float share) {
    const float room = 1.14f - share;
    const float slope = 0.06517f + share * (-0.0582f + share * 0.01263f);
    return ratio(share * slope, room * room);
}

/// Returns the density of candidates at a point with this density and packing.
float thinned(float density, float packing) {
    const float share = ratio(density, packing);
    return packing * (share < 1 ? share_of_candidates(share) : 1.0f);
}

template <class Real>
bool propose_by_density(const Draw& draw, const FaceRadii<Real>& radii, float fraction) {
    float most = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        most = std::max(most, thinned(radii.spread[k], -static_cast<float>(radii.corner[k])));
    }
    const float packing = -interpolated(draw, radii.corner);
    return fraction * most < thinned(interpolated(draw, radii.spread), packing);
}

/// Returns a fraction by the bits that the weights do not use.
float fraction_of(const std::array<std::uint32_t, 4>& random) {
    const std::uint32_t bits = (random[2] & 511u) << 9 | (random[3] & 511u);
    return (static_cast<float>(bits) + 0.5f) * 0x1p-18f;
}

/// Returns true if a candidate of a class is no dart, by the share of the class at its place.
bool is_dropped(std::span<const float> shares, std::size_t first_share, const Draw& draw,
                const std::array<std::uint32_t, 4>& random) {
    if (shares.empty()) {
        return false;
    }
    const float* const at = &shares[first_share];
    const float corners[3] = {at[0], at[1], at[2]};
    const float share = interpolated(draw, corners);
    return share < 1 && fraction_of(random) >= share_of_candidates(share);
}

template <class Real>
bool propose(Draw& draw, const FaceRadii<Real>& radii, const std::array<std::uint32_t, 4>& random) {
    const float fraction = fraction_of(random);
    return radii.has_packing() ? propose_by_density(draw, radii, fraction)
                               : propose_by_factors(draw, radii, fraction);
}

template <class Real>
Draw draw_in_face(const Surface<Real>& surface, std::uint64_t seed,
                  std::array<std::uint32_t, 4> counter, std::uint32_t face,
                  std::array<std::uint32_t, 4> random) {
    Draw draw = draw_uniform(face, random);
    if (!surface.is_adaptive()) {
        return draw;
    }
    while (!propose(draw, surface.radii[face], random) && counter[3] + 1 < gpu::kMaxProposals) {
        ++counter[3];
        random = philox(seed, counter);
        draw = draw_uniform(face, random);
    }
    return draw;
}

std::uint32_t key_of(const SampleParams& params, std::uint32_t face) {
    return params.face_keys.empty() ? face : params.face_keys[face];
}

template <class Real>
float face_area(const Surface<Real>& surface, std::uint32_t face) {
    const Edge<Real>& edge = surface.edges[std::size_t{3} * face];
    const Edge<Real>& previous = surface.edges[std::size_t{3} * face + 2];
    const float apex_y = static_cast<float>(previous.length) * static_cast<float>(edge.sine);
    return 0.5f * (static_cast<float>(edge.length) * apex_y);
}

} // namespace

template <class Real>
std::vector<std::uint32_t> count_candidates(const Surface<Real>& surface,
                                            const SampleParams& params, std::uint32_t stage) {
    const float intensity = surface.frame.intensity(stage);
    std::vector<std::uint32_t> counts(surface.face_count());
    for (std::uint32_t face = 0; face < surface.face_count(); ++face) {
        if (!takes_samples(params, face)) {
            continue;
        }
        float mean = intensity * face_area(surface, face);
        if (params.radii != nullptr) {
            mean = mean * params.radii->densities()[face];
        }
        const auto random = philox(params.seed, {key_of(params, face), 0, stage, kCountCounter});
        counts[face] = poisson(mean, random[0], random[1]);
    }
    return counts;
}

template <class Real>
void draw_candidates(const Surface<Real>& surface, const SampleParams& params, std::uint32_t face,
                     std::uint32_t stage, std::span<FacePoint<Real>> points,
                     std::span<std::uint32_t> priorities) {
    const std::uint32_t key = key_of(params, face);
    for (std::uint32_t k = 0; k < points.size(); ++k) {
        const std::array<std::uint32_t, 4> counter{key, k, stage, 0};
        const auto random = philox(params.seed, counter);
        priorities[k] = random[0] >> kPriorityShift;
        const Draw draw = draw_in_face(surface, params.seed, counter, face, random);
        points[k] = draw.template point<Real>();
        if (surface.has_classes()) { // In the lowest bits; classes of few candidates come early.
            const std::uint32_t own = surface.classes.of(random[1]);
            const std::uint64_t early = priorities[k] * surface.classes.turns[own] >> 31;
            priorities[k] = static_cast<std::uint32_t>(early) / 8 * 8 + own;
            const std::size_t first_share =
                std::size_t{3} * (std::size_t{own} * surface.face_count() + face);
            if (is_dropped(surface.classes.shares, first_share, draw, random)) {
                priorities[k] |= gpu::kNoDart;
            }
        }
    }
}

template std::vector<std::uint32_t> count_candidates(const Surface<float>&, const SampleParams&,
                                                     std::uint32_t);
template void draw_candidates(const Surface<float>&, const SampleParams&, std::uint32_t,
                              std::uint32_t, std::span<FacePoint<float>>, std::span<std::uint32_t>);
template std::vector<std::uint32_t> count_candidates(const Surface<double>&, const SampleParams&,
                                                     std::uint32_t);
template void draw_candidates(const Surface<double>&, const SampleParams&, std::uint32_t,
                              std::uint32_t, std::span<FacePoint<double>>,
                              std::span<std::uint32_t>);
} // namespace geodisk::ref
