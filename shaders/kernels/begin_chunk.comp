#version 450
#extension GL_GOOGLE_include_directive : require
// Prepares the first batch of a chunk, once its candidates are drawn. One invocation.
// reads: starts   writes: control   spec: slot local size

#include "../lib/prelude.glsl"
#include "../lib/units.glsl"

layout(local_size_x = 1) in;

GEODISK_CONTROL;

#include "../lib/schedule.glsl"

void main() { begin_chunk(drawn_count()); }
