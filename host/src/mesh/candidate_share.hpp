// How many candidates a share of the samples takes.
#pragma once

namespace geodisk {

/// The share of a pool's candidates that gives the share x of the samples, both in [0, 1], where
/// all radii are alike. Dart throwing saturates, so that half of the samples take 5 % of the
/// candidates. A fit to the counts of pools of 1 to 20 candidates per sample, and below to the
/// series of Schaaf and Talbot (1989) for random sequential adsorption; to 2 % of the candidates.
///
/// Convex, 0 at 0, and up to rounding 1 at 1. The same operations as in shaders/lib/candidate.glsl,
/// with `quotient(a, b)` = a / b clamped to 1.
template <class Real, class Quotient>
Real candidates_for_share(Real x, Quotient quotient) {
    const Real rest = static_cast<Real>(1.14f) - x;
    const Real slope = static_cast<Real>(0.06517f) +
                       x * (static_cast<Real>(-0.0582f) + x * static_cast<Real>(0.01263f));
    return quotient(x * slope, rest * rest);
}

} // namespace geodisk
