// Share of the candidates that a share of the samples needs.
#pragma once

namespace geodisk {

/// Returns the share of a pool's candidates that gives the share x of the samples, both in [0, 1],
/// if all radii are alike. Dart throwing saturates, so half of the samples need only 5 % of the
/// candidates. The formula is a fit to counts with pools of 1 to 20 candidates per sample, and
/// below that to the series of Schaaf and Talbot (1989) for random sequential adsorption. It is
/// accurate to 2 % of the candidates.
///
/// Convex, 0 at 0, and 1 at 1 except for rounding. Uses the same operations as
/// shaders/lib/candidate.glsl, with `quotient(a, b)` = a / b clamped to 1.
template <class Real, class Quotient>
Real candidates_for_share(Real x, Quotient quotient) {
    const Real rest = static_cast<Real>(1.14f) - x;
    const Real slope = static_cast<Real>(0.06517f) +
                       x * (static_cast<Real>(-0.0582f) + x * static_cast<Real>(0.01263f));
    return quotient(x * slope, rest * rest);
}

} // namespace geodisk
