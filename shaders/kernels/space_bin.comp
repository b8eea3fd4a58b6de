#version 450
#extension GL_GOOGLE_include_directive : require
// Counts the candidates on a surface in space by cell.
// reads: corners, axes, starts   writes: cells   spec: rounding, dimension

#include "../lib/prelude.glsl"
#include "../lib/space_candidate.glsl"
#include "../lib/grid.glsl"
#include "../lib/grid_bin.glsl"
