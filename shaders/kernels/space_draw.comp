#version 450
#extension GL_GOOGLE_include_directive : require
// Draws the candidates on a surface in space.
// reads: corners, axes, starts   writes: cells, points, orders   spec: rounding, dimension

#include "../lib/prelude.glsl"
#include "../lib/space_candidate.glsl"
#include "../lib/grid.glsl"
#include "../lib/grid_draw.glsl"
