#version 450
#extension GL_GOOGLE_include_directive : require
// Selects the next batch on a surface in space.
// reads: corners, starts, samples   writes: points, orders, list, control, slots
// spec: slot local size, rounding, dimension

#include "../lib/prelude.glsl"
#include "../lib/space_candidate.glsl"
#include "../lib/grid_select.glsl"
