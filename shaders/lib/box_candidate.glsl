// Candidate `rank` in a box as a pure function of seed and rank: a word for each coordinate, a
// multiple of 2^-32 of the side.
#ifndef GEODISK_BOX_CANDIDATE_GLSL
#define GEODISK_BOX_CANDIDATE_GLSL

#include "rng.glsl"
#include "grid.glsl"

uint words_per_point() { return kDimension; }

uint[kMostAxes] draw_point(uint rank) {
    uvec2 key = uvec2(push.seed_low, push.seed_high);
    uvec4 first = philox(key, uvec2(push.first_rank + rank, 0u));
    uvec4 second = kDimension > 4u ? philox(key, uvec2(push.first_rank + rank, 1u)) : uvec4(0u);
    return uint[kMostAxes](first.x, first.y, first.z, first.w, second.x, second.y);
}

#endif
