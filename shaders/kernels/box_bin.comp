#version 450
#extension GL_GOOGLE_include_directive : require
// Counts the candidates in a box (paper section 5.9) by cell.
// reads: axes, starts   writes: cells   spec: rounding, dimension

#include "../lib/prelude.glsl"
#include "../lib/box_candidate.glsl"
#include "../lib/grid_bin.glsl"
