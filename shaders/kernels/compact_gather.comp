#version 450
#extension GL_GOOGLE_include_directive : require
// Leaves the rank of every accepted candidate at its output place. One invocation per candidate.
// reads: places, states, marks   writes: samples, control   spec: local size

#include "../lib/prelude.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindPlaces, readonly, uint, places);
GEODISK_BUFFER(kBindStates, readonly, uint, states);
GEODISK_BUFFER(kBindMarks, readonly, uint, marks);
GEODISK_BUFFER(kBindSamples, writeonly, uvec4, samples);
GEODISK_CONTROL;

void main() {
    uint rank = gl_WorkGroupID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) +
                gl_GlobalInvocationID.x;
    if (rank >= push.candidates || (states[places[rank]] & kStateMask) != kAccepted) {
        return;
    }
    if (marks[rank] >= push.sample_capacity) {
        atomicOr(control.overflow, kOverflowSamples);
    } else {
        samples[marks[rank]].x = rank;
    }
}
