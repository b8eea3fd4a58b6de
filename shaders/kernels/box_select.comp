#version 450
#extension GL_GOOGLE_include_directive : require
// Selects the next batch in a box (paper section 5.9).
// reads: axes, starts, samples   writes: points, orders, list, control, slots
// spec: slot local size, rounding, dimension

#include "../lib/prelude.glsl"
#include "../lib/box_candidate.glsl"
#include "../lib/grid_select.glsl"
