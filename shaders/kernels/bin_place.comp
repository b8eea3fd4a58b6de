#version 450
#extension GL_GOOGLE_include_directive : require
// Sorts the candidates by cell, after the scan turned counts into starts: tells each its place, and
// each place its rank. One invocation per candidate.
// reads: cells, marks   writes: places, weights (ranks)   spec: local size

#include "../lib/prelude.glsl"

layout(local_size_x_id = 0) in;

GEODISK_WORDS(kBindCells, cells);
GEODISK_WORDS(kBindMarks, marks);
GEODISK_BUFFER(kBindPlaces, , uint, places);
GEODISK_BUFFER(kBindWeights, writeonly, uint, ranks);

void main() {
    uint rank = gl_WorkGroupID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) +
                gl_GlobalInvocationID.x;
    if (rank >= push.candidates) {
        return;
    }
    uint place = word_at(cells, places[rank]) + word_at(marks, rank);
    places[rank] = place;
    ranks[place] = rank;
}
