// Position of a candidate on a surface in the bounding box, in multiples of 2^-32 of its sides: the
// corners of its face in these units, weighted in integers and rounded down.
#ifndef GEODISK_SPACE_CANDIDATE_GLSL
#define GEODISK_SPACE_CANDIDATE_GLSL

#include "job.glsl"
#include "curve.glsl"
#include "face_candidate.glsl"
#include "dimension.glsl"
#include "unit.glsl"

// kSpaceRows per face: a row per corner, then their normals; after the first corner the area, after the
// second the key.
GEODISK_ROWS(kBindFaces, corners);

uint key_of(uint face) { return row_at(corners, kSpaceRows * face + 1u).w; }
uvec2 seed_of(uint face) { return uvec2(job.seed_low, job.seed_high); }
uint stages_of(uint face) { return kAllStages; }

layout(constant_id = kSpecCurved) const bool kCurved = false;

// Adds the product of a weight and a coordinate to a 64-bit sum.
uvec2 plus_product(uvec2 sum, uint weight, uint coordinate) {
    uint high, low, carry;
    umulExtended(weight, coordinate, high, low);
    uint next = uaddCarry(sum.x, low, carry);
    return uvec2(next, sum.y + high + carry);
}

// Returns the unit normal, or zero.
vec3 normal_of(Candidate c) {
    uint row = kSpaceRows * c.face + 3u;
    float weight0 = weight_of(kOneWeight - c.weight1 - c.weight2);
    float weight1 = weight_of(c.weight1);
    float weight2 = weight_of(c.weight2);
    vec3 normal0 = uintBitsToFloat(row_at(corners, row).xyz);
    vec3 normal1 = uintBitsToFloat(row_at(corners, row + 1u).xyz);
    vec3 normal2 = uintBitsToFloat(row_at(corners, row + 2u).xyz);
    precise vec3 sum = weight0 * normal0 + weight1 * normal1 + weight2 * normal2;
    float len = root(product3(sum, sum));
    return vec3(signed_ratio(sum.x, len), signed_ratio(sum.y, len), signed_ratio(sum.z, len));
}

uint words_per_point() { return kCurved ? 6u : 3u; }

uint[kMaxAxes] point_at(Candidate c) {
    uint weight0 = kOneWeight - c.weight1 - c.weight2;
    uint row = kSpaceRows * c.face;
    uvec4 corner0 = row_at(corners, row);
    uvec4 corner1 = row_at(corners, row + 1u);
    uvec4 corner2 = row_at(corners, row + 2u);
    uint point[kMaxAxes] = uint[kMaxAxes](0u, 0u, 0u, 0u, 0u, 0u);
    for (uint i = 0u; i < 3u; ++i) {
        uvec2 sum = plus_product(uvec2(0u), weight0, corner0[i]);
        sum = plus_product(sum, c.weight1, corner1[i]);
        sum = plus_product(sum, c.weight2, corner2[i]);
        point[i] = sum.y << 8 | sum.x >> 24;
    }
    if (kCurved) {
        uvec3 normal = floatBitsToUint(normal_of(c));
        point[3] = normal.x;
        point[4] = normal.y;
        point[5] = normal.z;
    }
    return point;
}

// Draws the candidate with this number in its unit, and the words of its sample.
uint[kMaxAxes] draw_point(Unit unit, uint number, out uvec4 record) {
    Candidate c = draw_evenly(unit.owner, unit.stage, number);
    record = uvec4(c.order, unit.owner, floatBitsToUint(weight_of(c.weight1)),
                   floatBitsToUint(weight_of(c.weight2)));
    return point_at(c);
}

uint[kMaxAxes] point_of(uvec4 record) {
    return point_at(Candidate(record.y, record.x, steps_of(uintBitsToFloat(record.z)),
                              steps_of(uintBitsToFloat(record.w))));
}

#endif
