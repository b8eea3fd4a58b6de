// Candidates on a surface (paper section 3.3), uniform in each face. Each is a pure function of the
// seed, the key of its face, its stage and its number there, in integers except for one correctly
// rounded root. Stages count from the first of the chunk. Needs key_of(face) and seed_of(face).
#ifndef GEODISK_FACE_CANDIDATE_GLSL
#define GEODISK_FACE_CANDIDATE_GLSL

#include "poisson.glsl"
#include "rng.glsl"
#include "weights.glsl"

struct Candidate {
    uint face;
    uint order;
    uint weight1; // in units of 2^-24
    uint weight2;
};

uint key_of(uint face);
uvec2 seed_of(uint face);

uvec4 random_of(uint face, uint number, uint stage, uint proposal) {
    return philox(seed_of(face), uvec4(key_of(face), number, push.first_stage + stage, proposal));
}

void weigh_evenly(inout Candidate c, uvec4 random) {
    // Odd multiples of 2^-24 are never 0 or 1.
    uint alpha = (random.z >> 9) << 1 | 1u;
    uint beta = (random.w >> 9) << 1 | 1u;
    precise float square = float(alpha) * 5.9604645e-8;
    precise float both_scaled = root(square) * 16777216.0;
    uint both = uint(both_scaled);
    uint high, low;
    umulExtended(both, kOneWeight - beta, high, low);
    c.weight1 = high << 8 | low >> 24;
    c.weight2 = both - c.weight1;
}

Candidate draw_evenly(uint face, uint stage, uint number) {
    uvec4 random = random_of(face, number, stage, 0u);
    uint priority = random.x >> (32u - kPriorityBits);
    Candidate c = Candidate(face, stage << kPriorityBits | priority, 0u, 0u);
    weigh_evenly(c, random);
    return c;
}

uvec3 count_key(uint face) { return uvec3(seed_of(face), key_of(face)); }

// Returns the random words for its count in a stage of the job.
uvec4 count_words(uvec3 key, uint stage) {
    return philox(key.xy, uvec4(key.z, 0u, stage, kCountProposal));
}

#endif
