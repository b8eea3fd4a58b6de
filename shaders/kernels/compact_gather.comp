#version 450
#extension GL_GOOGLE_include_directive : require
// Writes the accepted candidates in rank order. One invocation per candidate.
// reads: alias columns, places, states, marks   writes: samples, control   spec: local size, rounding

#include "../lib/prelude.glsl"
#include "../lib/candidate.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindPlaces, readonly, uint, places);
GEODISK_BUFFER(kBindMarks, readonly, uint, marks);
GEODISK_BUFFER(kBindStates, readonly, uint, states);
GEODISK_BUFFER(kBindSamples, writeonly, uvec4, samples);
GEODISK_CONTROL;

void main() {
    uint rank = gl_WorkGroupID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) +
                gl_GlobalInvocationID.x;
    if (rank >= push.candidates) {
        return;
    }
    if ((states[places[rank]] & kStateMask) == kAccepted) {
        if (marks[rank] >= push.sample_capacity) {
            atomicOr(control.overflow, kOverflowSamples);
            return;
        }
        Candidate c = draw_candidate(rank);
        samples[marks[rank]] = uvec4(rank, c.face, floatBitsToUint(weight_of(c.weight1)),
                                     floatBitsToUint(weight_of(c.weight2)));
    }
}
