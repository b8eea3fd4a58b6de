#version 450
#extension GL_GOOGLE_include_directive : require
// Readies the slots of candidates on a surface in space. One invocation per slot.
// reads: corners, alias columns, places   writes: states, slots, marks, points, blockers
// spec: local size, rounding, dimension, curved

#include "../lib/prelude.glsl"
#include "../lib/space_candidate.glsl"
#include "../lib/grid_activate.glsl"
