#version 450
#extension GL_GOOGLE_include_directive : require
// Readies the slots that select has filled with ranks, where disks are found by a
// grid in space. One invocation per slot.
// reads: places   writes: states, slots, marks, blockers   spec: local size

#include "../lib/prelude.glsl"
#include "../lib/ready_slot.glsl"

layout(local_size_x_id = 0) in;

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (is_due(slot)) {
        ready_slot(slot, uvec4(rank_of(slot), 0u, 0u, 0u));
    }
}
