#version 450
#extension GL_GOOGLE_include_directive : require
// Readies the slots of candidates in a box. One invocation per slot.
// reads: places   writes: states, slots, marks, points, blockers   spec: local size, dimension

#include "../lib/prelude.glsl"
#include "../lib/box_candidate.glsl"
#include "../lib/grid_activate.glsl"
