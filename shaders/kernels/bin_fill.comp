#version 450
#extension GL_GOOGLE_include_directive : require
// Draws the candidates again in sorted order. Of a large pool that is faster than to carry states and
// weights along: only ranks were scattered over memory. One invocation per place.
// reads: alias columns, radii, weights (ranks)   writes: states, weights
// spec: local size, rounding, adaptive

#include "../lib/prelude.glsl"
#include "../lib/candidate.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindStates, writeonly, uint, states);
GEODISK_BUFFER(kBindWeights, , uint, weights);

void main() {
    uint place = gl_WorkGroupID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) +
                 gl_GlobalInvocationID.x;
    if (place >= push.candidates) {
        return;
    }
    Candidate c = draw_candidate(weights[place]);
    states[place] = c.weight1 << kWeightShift | kIdle;
    weights[place] = c.weight2;
}
