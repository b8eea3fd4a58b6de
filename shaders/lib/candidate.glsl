// A candidate as a pure function of seed and rank (paper section 3.3), in integers but for one
// correctly rounded root, and where radii vary for correctly rounded quotients.
#ifndef GEODISK_CANDIDATE_GLSL
#define GEODISK_CANDIDATE_GLSL

#include "radii.glsl"
#include "rng.glsl"
#include "uniform_candidate.glsl"

// Where radii vary, candidates are as dense as 1 / r^2, so that every disk holds as many. Uniform
// weights u of the corners are turned into u_k / s_k over their sum, which makes points as dense as
// 1 / s^3 in a face; each is kept with probability s^3 / g^2, where g = 2 r. Between corners with s_k =
// g_k^(2/3) s is nowhere more than g^(2/3), so that is no more than 1, and at least 0.059 however much
// g varies. Returns whether this one is kept.
bool propose(inout Candidate c, uvec4 random) {
    vec3 spreads = face_spreads(c.face);
    // 1 / s_k but for a factor.
    precise float inverse0 = spreads.y * spreads.z;
    precise float inverse1 = spreads.x * spreads.z;
    precise float inverse2 = spreads.x * spreads.y;
    precise float share0 = float(kOneWeight - c.weight1 - c.weight2) * inverse0;
    precise float share1 = float(c.weight1) * inverse1;
    precise float share2 = float(c.weight2) * inverse2;
    precise float sum = share0 + share1 + share2;
    c.weight1 = min(steps_of(ratio(share1, sum)), kOneWeight - 1u);
    c.weight2 = min(steps_of(ratio(share2, sum)), kOneWeight - 1u - c.weight1);
    float weight1 = weight_of(c.weight1);
    float weight2 = weight_of(c.weight2);
    float spread = interpolated(spreads, weight1, weight2);
    precise float g = 2.0 * radius_at(face_radii(c.face), weight1, weight2);
    // The bits that the weights left over.
    uint bits = (random.z & 511u) << 9 | (random.w & 511u);
    precise float fraction = (float(bits) + 0.5) * 3.814697265625e-6;
    precise float threshold = fraction * (g * g);
    precise float cube = spread * spread * spread;
    return threshold < cube;
}

// `rank` counts from the first of the chunk.
Candidate draw_candidate(uint rank) {
    uvec2 seed = uvec2(push.seed_low, push.seed_high);
    uint index = push.first_rank + rank;
    uvec4 random = philox(seed, uvec2(index, 0u));
    Candidate c = draw_uniform(random);
    if (kAdaptive) {
        bool kept = propose(c, random);
        for (uint proposal = 1u; proposal < kMostProposals && !kept; ++proposal) {
            random = philox(seed, uvec2(index, proposal));
            c = draw_uniform(random);
            kept = propose(c, random);
        }
    }
    return c;
}

#endif
