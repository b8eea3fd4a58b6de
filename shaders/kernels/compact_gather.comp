#version 450
#extension GL_GOOGLE_include_directive : require
// Writes the accepted candidates in rank order. One invocation per candidate.
// reads: places, states, marks, points   writes: samples   spec: local size

#include "../lib/prelude.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindPlaces, readonly, uint, places);
GEODISK_BUFFER(kBindStates, readonly, uint, states);
GEODISK_BUFFER(kBindMarks, readonly, uint, marks);
GEODISK_BUFFER(kBindPoints, readonly, uvec4, points);
GEODISK_BUFFER(kBindSamples, writeonly, uvec4, samples);

void main() {
    uint rank = gl_WorkGroupID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) +
                gl_GlobalInvocationID.x;
    if (rank >= push.candidates) {
        return;
    }
    uint place = places[rank];
    if ((states[place] & kStateMask) == kAccepted) {
        uvec4 point = points[place];
        samples[marks[rank]] = uvec4(rank, point.w, point.x, point.y);
    }
}
