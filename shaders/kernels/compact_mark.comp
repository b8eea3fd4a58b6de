#version 450
#extension GL_GOOGLE_include_directive : require
// Marks the accepted candidates by rank; the scan turns marks into output places. One invocation
// per candidate.
// reads: places, states   writes: marks, control   spec: local size

#include "../lib/prelude.glsl"

layout(local_size_x_id = 0) in;

GEODISK_WORDS(kBindPlaces, places);
GEODISK_WORDS(kBindStates, states);
GEODISK_BUFFER(kBindMarks, writeonly, uint, marks);
GEODISK_CONTROL;

void main() {
    uint rank = gl_WorkGroupID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) +
                gl_GlobalInvocationID.x;
    if (rank == 0u) {
        atomicAnd(control.overflow, ~kOverflowSamples); // of an earlier try with a smaller buffer
    }
    if (rank >= push.candidates) {
        return;
    }
    uint state = word_at(states, word_at(places, rank)) & kStateMask;
    marks[rank] = state == kAccepted ? 1u : 0u;
}
