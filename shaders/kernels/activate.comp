#version 450
#extension GL_GOOGLE_include_directive : require
// Readies the slots that select has filled with ranks; those of samples of earlier chunks have no
// place among the candidates. One invocation per slot.
// reads: alias columns, radii, places   writes: states, slots, marks, blockers
// spec: local size, rounding, adaptive

#include "../lib/prelude.glsl"
#include "../lib/candidate.glsl"
#include "../lib/ready_slot.glsl"

layout(local_size_x_id = 0) in;

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (!is_due(slot)) {
        return;
    }
    uint rank = rank_of(slot);
    Candidate c = draw_candidate(rank);
    ready_slot(slot, uvec4(rank, c.face, floatBitsToUint(weight_of(c.weight1)),
                           floatBitsToUint(weight_of(c.weight2))));
}
