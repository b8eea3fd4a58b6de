// A candidate as a pure function of seed and rank (paper section 3.3), in integers but for one
// correctly rounded root.
#ifndef GEODISK_CANDIDATE_GLSL
#define GEODISK_CANDIDATE_GLSL

#include "rng.glsl"
#include "rounding.glsl"
#include "weights.glsl"

GEODISK_PAIRS(kBindAlias, alias_columns);

struct Candidate {
    uint face;
    uint weight1; // in units of 2^-24
    uint weight2;
};

// `rank` counts from the first of the chunk.
Candidate draw_candidate(uint rank) {
    uvec4 random =
        philox(uvec2(push.seed_low, push.seed_high), uvec2(push.first_rank + rank, 0u));
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
    umulExtended(both, 16777216u - beta, high, low);
    uint second = high << 8 | low >> 24;
    return Candidate(face, second, both - second);
}

#endif
