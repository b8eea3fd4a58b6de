#version 450
#extension GL_GOOGLE_include_directive : require
// How many candidates each cell of a box has in each stage. One invocation per cell and stage.
// reads: axes   writes: starts (counts)   spec: local size, rounding, dimension

#include "../lib/prelude.glsl"
#include "../lib/box_candidate.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindStarts, writeonly, uint, starts);

void main() {
    uint unit = gl_WorkGroupID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) +
                gl_GlobalInvocationID.x;
    if (unit < push.faces * push.stages) {
        uint cell = unit / push.stages;
        starts[unit] = count_in_cell(cell, unit - cell * push.stages);
    }
}
