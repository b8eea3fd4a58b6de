#version 450
#extension GL_GOOGLE_include_directive : require
// Counts the candidates of each face, where distances go through space.
// reads: corners   writes: starts (counts)   spec: local size, rounding

#include "../lib/prelude.glsl"
#include "../lib/space_candidate.glsl"

float mean_count(uint face) {
    float area = uintBitsToFloat(row_at(corners, kSpaceRows * face).w);
    precise float mean = push.intensity * area;
    return mean;
}

void counted(uint face, uint number) {}

#include "../lib/count_units.glsl"
