#version 450
#extension GL_GOOGLE_include_directive : require
// Sorts the candidates by cell, after the scan turned counts into starts. One invocation per
// candidate.
// reads: alias columns, cells, marks   writes: states, weights, places   spec: local size, rounding

#include "../lib/prelude.glsl"
#include "../lib/candidate.glsl"

layout(local_size_x_id = 0) in;

GEODISK_WORDS(kBindCells, cells);
GEODISK_WORDS(kBindMarks, marks);
GEODISK_BUFFER(kBindPlaces, , uint, places);
GEODISK_BUFFER(kBindStates, writeonly, uint, states);
GEODISK_BUFFER(kBindWeights, writeonly, uint, weights);

void main() {
    uint rank = gl_WorkGroupID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) +
                gl_GlobalInvocationID.x;
    if (rank >= push.candidates) {
        return;
    }
    Candidate c = draw_candidate(rank);
    uint place = word_at(cells, places[rank]) + word_at(marks, rank);
    places[rank] = place;
    states[place] = c.weight1 << kWeightShift | kIdle;
    weights[place] = c.weight2;
}
