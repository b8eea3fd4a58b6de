// Poisson numbers from random words, with operations that round the same everywhere.
#ifndef GEODISK_POISSON_GLSL
#define GEODISK_POISSON_GLSL

#include "rounding.glsl"

// Probabilities below it end a search.
const float kSmallestProbability = 2.3283064e-10; // 2^-32
// Means below it give none.
const float kSmallestMean = 9.094947e-13; // 2^-40
// Maximum part of a mean that uses the tail, and maximum of its steps.
const float kLargestTailMean = 8.0;
const uint kMaxTailSteps = 64u;

// Returns a number in (0, 1).
float unit_fraction(uint word) {
    precise float low = float(word & 255u) + 0.5;
    precise float whole = float(word >> 8) * 256.0;
    precise float fraction = (whole + low) * 2.3283064e-10;
    return fraction;
}

// The Poisson law of a mean: values that all its numbers share.
struct PoissonLaw {
    uint whole;        // part of the mean, which goes from the mode outwards
    float rest;        // below 8
    float none, any;   // P(N = 0) and P(N >= 1) of the rest
};

PoissonLaw poisson_law(float mean) {
    PoissonLaw law;
    law.whole = mean < kLargestTailMean ? 0u : uint(mean);
    precise float rest = mean - float(law.whole);
    law.rest = rest;
    precise float r = rest * 0.0625;
    // 1 - exp(-r) as a power series.
    precise float t8 = 1.0 - r * 0.125;
    precise float t7 = 1.0 - r * 0.14285715 * t8;
    precise float t6 = 1.0 - r * 0.16666667 * t7;
    precise float t5 = 1.0 - r * 0.2 * t6;
    precise float t4 = 1.0 - r * 0.25 * t5;
    precise float t3 = 1.0 - r * 0.33333334 * t4;
    precise float t2 = 1.0 - r * 0.5 * t3;
    precise float any = r * t2;
    precise float p = 1.0 - any;
    for (uint i = 0u; i < 4u; ++i) {
        precise float square = p * p;
        precise float twice = any * (2.0 - any);
        p = square;
        any = twice;
    }
    law.none = p;
    law.any = any;
    return law;
}

// Returns, for the rest of the mean, how many n have P(N >= n) above the fraction.
uint poisson_tail(PoissonLaw law, uint word) {
    float fraction = unit_fraction(word);
    // P(N = n) and P(N >= n + 1).
    float p = law.none;
    float any = law.any;
    uint n = 0u;
    while (fraction < any && p > kSmallestProbability && n < kMaxTailSteps) {
        ++n;
        precise float times = p * law.rest;
        p = ratio(times, float(n));
        precise float rest = any - p;
        any = rest;
    }
    return n;
}

// Returns a number for an integer mean of at least 8: from the mode outwards, until the fraction is used
// up. Takes about 1.6 times the square root of the mean in steps, at most 13 times.
uint poisson_walk(uint mean, uint word) {
    float rest = unit_fraction(word);
    float c = float(mean);
    // Stirling's series for mean^mean exp(-mean) / mean!
    precise float twelfth = 12.0 * c;
    precise float cube = 360.0 * ((c * c) * c);
    precise float e = ratio(1.0, twelfth) - ratio(1.0, cube);
    precise float full_turn = 6.2831855 * c;
    precise float series = (1.0 - e) + 0.5 * (e * e);
    precise float p = ratio(1.0, root(full_turn)) * series;
    uint above = mean;
    uint below = mean;
    float p_above = p;
    float p_below = p;
    precise float left = rest - p;
    rest = left;
    while (rest >= 0.0 && (p_above > kSmallestProbability ||
                           (below > 0u && p_below > kSmallestProbability))) {
        ++above;
        precise float next_above = p_above * ratio(c, float(above));
        p_above = next_above;
        precise float after_above = rest - p_above;
        rest = after_above;
        if (rest < 0.0) {
            return above;
        }
        if (below > 0u) {
            precise float next_below = p_below * ratio(float(below), c);
            p_below = next_below;
            --below;
            precise float after_below = rest - p_below;
            rest = after_below;
            if (rest < 0.0) {
                return below;
            }
        }
    }
    return mean;
}

// Returns a Poisson number for a mean of at least kSmallestMean.
uint poisson(PoissonLaw law, uint first, uint second) {
    uint count = poisson_tail(law, second);
    return law.whole > 0u ? count + poisson_walk(law.whole, first) : count;
}

#endif
