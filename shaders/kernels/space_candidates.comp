#version 450
#extension GL_GOOGLE_include_directive : require
// Draws the pool on a surface in space, for straight-line distances. One invocation per candidate.
// reads: corners, axes, alias columns   writes: cell counts; the head of each candidate into places,
// and its number there into marks   spec: local size, rounding, dimension

#include "../lib/prelude.glsl"
#include "../lib/space_candidate.glsl"
#include "../lib/grid_draw.glsl"
