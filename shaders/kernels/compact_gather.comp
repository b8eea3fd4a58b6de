#version 450
#extension GL_GOOGLE_include_directive : require
// Leaves the rank of every accepted candidate at its output place, behind the samples of earlier
// chunks. After the scan an accepted one is where the next word is larger. One invocation per
// candidate.
// reads: marks   writes: samples, control   spec: local size

#include "../lib/prelude.glsl"

layout(local_size_x_id = 0) in;

GEODISK_WORDS(kBindMarks, marks);
GEODISK_BUFFER(kBindSamples, writeonly, uvec4, samples);
GEODISK_CONTROL;

void main() {
    uint rank = gl_WorkGroupID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) +
                gl_GlobalInvocationID.x;
    if (rank >= push.candidates) {
        return;
    }
    uint place = word_at(marks, rank);
    uint next = rank + 1u < push.candidates ? word_at(marks, rank + 1u)
                                            : control.accepted - control.settled;
    if (next == place) {
        return;
    }
    uint sample_index = control.settled + place;
    if (sample_index >= push.sample_capacity) {
        atomicOr(control.overflow, kOverflowSamples);
    } else {
        samples[sample_index].x = push.first_rank + rank;
    }
}
