#version 450
#extension GL_GOOGLE_include_directive : require
// Draws the pool in a box (paper section 5.9). One invocation per candidate.
// reads: axes   writes: cell counts; the head of each candidate into places, and its number there
// into marks   spec: local size, dimension

#include "../lib/prelude.glsl"
#include "../lib/box_candidate.glsl"
#include "../lib/grid_draw.glsl"
