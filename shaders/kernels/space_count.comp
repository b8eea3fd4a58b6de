#version 450
#extension GL_GOOGLE_include_directive : require
// How many candidates each face has in each stage, where distances go through space. One invocation per
// face and stage.
// reads: corners   writes: starts (counts)   spec: local size, rounding

#include "../lib/prelude.glsl"
#include "../lib/space_candidate.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindStarts, writeonly, uint, starts);

void main() {
    uint unit = gl_WorkGroupID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) +
                gl_GlobalInvocationID.x;
    if (unit < push.faces * push.stages) {
        uint face = unit / push.stages;
        float area = uintBitsToFloat(row_at(corners, kSpaceRows * face).w);
        precise float mean = push.intensity * area;
        starts[unit] = count_of(face, unit - face * push.stages, mean);
    }
}
