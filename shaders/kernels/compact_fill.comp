#version 450
#extension GL_GOOGLE_include_directive : require
// Draws the chunk's accepted candidates again, to write them out. One invocation per sample.
// reads: alias columns, radii, control   writes: samples   spec: local size, rounding, adaptive

#include "../lib/prelude.glsl"
#include "../lib/candidate.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindSamples, , uvec4, samples);
GEODISK_CONTROL;

void main() {
    uint sample_index = control.settled +
                        gl_WorkGroupID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) +
                        gl_GlobalInvocationID.x;
    if (sample_index >= min(control.accepted, push.sample_capacity)) {
        return;
    }
    uint rank = samples[sample_index].x;
    Candidate c = draw_candidate(rank - push.first_rank);
    samples[sample_index] =
        uvec4(rank, c.face, floatBitsToUint(weight_of(c.weight1)),
              floatBitsToUint(weight_of(c.weight2)));
}
