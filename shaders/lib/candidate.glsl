// Candidates on a surface: those of face_candidate.glsl, and if radii vary, denser where disks are
// smaller, with correctly rounded quotients and roots.
#ifndef GEODISK_CANDIDATE_GLSL
#define GEODISK_CANDIDATE_GLSL

#include "job.glsl"
#include "face_candidate.glsl"
#include "parts.glsl"
#include "radii.glsl"

layout(constant_id = kSpecKeyed) const bool kKeyed = false;

uint key_of(uint face) {
    return kSeveral || kKeyed ? key_word(face) : face;
}

// Returns the seed of a face. The seed of the job changes those of all surfaces.
uvec2 seed_of(uint face) {
    uvec2 seed = uvec2(job.seed_low, job.seed_high);
    if (kSeveral) {
        uint part = part_of(face);
        seed ^= uvec2(part_word(part, 0u), part_word(part, 1u));
    }
    return seed;
}

float intensity_of(uint face) {
    return kSeveral ? uintBitsToFloat(part_word(part_of(face), 2u)) : push.intensity;
}

// Returns what is added to the orders of a surface's candidates. It keeps their dart order, and candidates
// that several surfaces draw alike apart.
uint lag_of(uint face) { return kSeveral ? part_word(part_of(face), 6u) : 0u; }

// Returns the number of stages in which the face has candidates.
uint stages_of(uint face) { return kSeveral ? part_word(part_of(face), 3u) : kAllStages; }

// If radii vary, candidates are as dense as 1 / r^2, so that every disk holds about the same number.
// Uniform weights u of the corners become u_k / s_k over their sum, which makes points as dense as 1 /
// s^3 in a face. Each is kept with probability s^3 / g^2, where g = 2 r. With s_k = g_k^(2/3) at the
// corners, s is nowhere more than g^(2/3), so the probability is at most 1, and at least 0.059 however
// much g varies. Returns true if the candidate is kept.
bool propose_by_factors(inout Candidate c, float fraction) {
    vec3 spreads = face_spreads(c.face).xyz;
    // 1 / s_k up to a common factor.
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
    precise float threshold = fraction * (g * g);
    precise float cube = spread * spread * spread;
    return threshold < cube;
}

// Returns the share of candidates that gives the share x of the samples that fit:
// src/mesh/candidate_share.hpp.
float candidates_for_share(float x) {
    precise float rest = 1.14 - x;
    precise float slope = 0.06517 + x * (-0.0582 + x * 0.01263);
    precise float above = x * slope;
    precise float below = rest * rest;
    return ratio(above, below);
}

// Returns the density of candidates at a point with this density and packing.
float thinned(float density, float packing) {
    float share = ratio(density, packing);
    precise float result = packing * (share < 1.0 ? candidates_for_share(share) : 1.0);
    return result;
}

// If radii come from a density, uniform points are kept with a probability proportional to the density
// of candidates, a convex function that is largest at a corner.
bool propose_by_density(Candidate c, vec4 radii, float fraction) {
    vec3 densities = face_spreads(c.face).xyz;
    float most = max(thinned(densities.x, -radii.x),
                     max(thinned(densities.y, -radii.y), thinned(densities.z, -radii.z)));
    float weight1 = weight_of(c.weight1);
    float weight2 = weight_of(c.weight2);
    float packing = -interpolated(radii.xyz, weight1, weight2);
    precise float threshold = fraction * most;
    return threshold < thinned(interpolated(densities, weight1, weight2), packing);
}

// Returns a fraction by the bits that the weights do not use.
float fraction_of(uvec4 random) {
    uint bits = (random.z & 511u) << 9 | (random.w & 511u);
    precise float fraction = (float(bits) + 0.5) * 3.814697265625e-6;
    return fraction;
}

// Returns true if the candidate is kept. It has uniform weights, and is moved in its face.
bool propose(inout Candidate c, uvec4 random) {
    float fraction = fraction_of(random);
    vec4 radii = face_radii(c.face);
    return has_packing(radii) ? propose_by_density(c, radii, fraction)
                              : propose_by_factors(c, fraction);
}

// Returns true if the candidate is no dart: its class has fewer candidates there, or none, for its share of the
// samples that fit.
bool is_dropped(Candidate c, uint stage, uint number) {
    if (!kClasses || !has_shares()) {
        return false;
    }
    float share = interpolated(class_shares(c.face, c.order & kClassMask), weight_of(c.weight1),
                               weight_of(c.weight2));
    float kept = share < 1.0 ? candidates_for_share(share) : 1.0;
    return fraction_of(random_of(c.face, number, stage, 0u)) >= kept;
}

Candidate draw_candidate(uint face, uint stage, uint number) {
    Candidate c = draw_evenly(face, stage, number);
    if (kClasses) {
        c.order = with_class(c.order, class_of_random(random_of(face, number, stage, 0u).y));
    }
    if (kAdaptive) {
        bool kept = propose(c, random_of(face, number, stage, 0u));
        for (uint proposal = 1u; proposal < kMaxProposals && !kept; ++proposal) {
            uvec4 random = random_of(face, number, stage, proposal);
            weigh_evenly(c, random);
            kept = propose(c, random);
        }
    }
    c.order += lag_of(face);
    return c;
}

// Returns the expected number of candidates per stage of a face of this area.
float mean_in(uint face, float area) {
    precise float mean = intensity_of(face) * area;
    if (kAdaptive) {
        precise float denser = mean * face_spreads(face).w;
        mean = denser;
    }
    return mean;
}

#endif
