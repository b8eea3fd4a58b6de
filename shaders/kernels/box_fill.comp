#version 450
#extension GL_GOOGLE_include_directive : require
// Draws the candidates in a box again in sorted order. One invocation per place.
// reads: points (ranks)   writes: states, points   spec: local size, dimension

#include "../lib/prelude.glsl"
#include "../lib/box_candidate.glsl"
#include "../lib/grid_fill.glsl"
