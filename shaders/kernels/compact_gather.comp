#version 450
#extension GL_GOOGLE_include_directive : require
// Writes the accepted candidates in rank order. One invocation per candidate.
// reads: alias columns, places, points, marks   writes: samples   spec: local size, rounding

#include "../lib/prelude.glsl"
#include "../lib/candidate.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindPlaces, readonly, uint, places);
GEODISK_BUFFER(kBindMarks, readonly, uint, marks);
GEODISK_BUFFER(kBindPoints, readonly, uvec2, points);
GEODISK_BUFFER(kBindSamples, writeonly, uvec4, samples);

void main() {
    uint rank = gl_WorkGroupID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) +
                gl_GlobalInvocationID.x;
    if (rank >= push.candidates) {
        return;
    }
    if ((points[places[rank]].x & kStateMask) == kAccepted) {
        Candidate c = draw_candidate(rank);
        samples[marks[rank]] = uvec4(rank, c.face, floatBitsToUint(weight_of(c.weight1)),
                                     floatBitsToUint(weight_of(c.weight2)));
    }
}
