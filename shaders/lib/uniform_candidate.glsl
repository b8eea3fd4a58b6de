// A point of the surface, uniform by area, from four random words (paper section 3.3), in integers
// but for one correctly rounded root.
#ifndef GEODISK_UNIFORM_CANDIDATE_GLSL
#define GEODISK_UNIFORM_CANDIDATE_GLSL

#include "rounding.glsl"
#include "weights.glsl"

GEODISK_PAIRS(kBindAlias, alias_columns);

struct Candidate {
    uint face;
    uint weight1; // in units of 2^-24
    uint weight2;
};

// A face by the alias table, a uniform point in it.
Candidate draw_uniform(uvec4 random) {
    // A 64-bit fraction times the number of faces: the integer part is the column.
    uint high, low, fine, unused;
    umulExtended(random.x, push.faces, high, low);
    umulExtended(random.y, push.faces, fine, unused);
    uint fraction = low + fine;
    uint column = high + (fraction < low ? 1u : 0u);
    uvec2 entry = pair_at(alias_columns, column);
    uint face = fraction < entry.x ? column : entry.y;
    // Odd multiples of 2^-24 keep clear of 0 and 1.
    uint alpha = (random.z >> 9) << 1 | 1u;
    uint beta = (random.w >> 9) << 1 | 1u;
    precise float square = float(alpha) * 5.9604645e-8;
    precise float both_scaled = root(square) * 16777216.0;
    uint both = uint(both_scaled);
    umulExtended(both, kOneWeight - beta, high, low);
    uint second = high << 8 | low >> 24;
    return Candidate(face, second, both - second);
}

#endif
