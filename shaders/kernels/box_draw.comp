#version 450
#extension GL_GOOGLE_include_directive : require
// Draws the candidates in a box (paper section 5.9).
// reads: axes, starts   writes: cells, points, orders   spec: rounding, dimension

#include "../lib/prelude.glsl"
#include "../lib/box_candidate.glsl"
#include "../lib/grid_draw.glsl"
