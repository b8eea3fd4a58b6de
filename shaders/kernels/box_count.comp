#version 450
#extension GL_GOOGLE_include_directive : require
// Counts the candidates of each cell of a box.
// reads: axes   writes: starts (counts)   spec: local size, rounding, dimension

#include "../lib/prelude.glsl"
#include "../lib/box_candidate.glsl"

void counted(uint cell, uint number) {}

#include "../lib/count_units.glsl"
