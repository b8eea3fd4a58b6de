#version 450
#extension GL_GOOGLE_include_directive : require
// Draws the candidates on a surface in space again in sorted order. One invocation per place.
// reads: corners, alias columns, points (ranks)   writes: states, points
// spec: local size, rounding, dimension

#include "../lib/prelude.glsl"
#include "../lib/space_candidate.glsl"
#include "../lib/grid_fill.glsl"
