#version 450
#extension GL_GOOGLE_include_directive : require
// Finds the idle candidates among the next ranks, as bits, for select. One invocation per 32 ranks;
// how many, select foresees in the round before.
// reads: places, states, control   writes: sums

#include "../lib/prelude.glsl"

layout(local_size_x = kFindLanes) in;

GEODISK_WORDS(kBindStates, states);
GEODISK_WORDS(kBindPlaces, places);
GEODISK_BUFFER(kBindSums, writeonly, uint, idle);
GEODISK_CONTROL;

void main() {
    if (control.undecided > 0u || control.overflow != 0u || control.done != 0u) {
        return;
    }
    uint word = gl_GlobalInvocationID.x;
    uint begin = min(control.next_rank + 32u * word, push.candidates);
    uint end = min(begin + 32u, push.candidates);
    uint bits = 0u;
    for (uint rank = begin; rank < end; ++rank) {
        uint state = word_at(states, word_at(places, rank)) & kStateMask;
        bits |= (state == kIdle ? 1u : 0u) << (rank - begin);
    }
    idle[word] = bits;
}
